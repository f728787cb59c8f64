#include "core/error.h"

#include <utility>

namespace wishbone {

namespace {

std::string told(const Diagnostic& d, const char* severity) {
  std::string s = d.where.empty() ? std::string() : d.where + ": ";
  s += severity + d.what;
  if (!d.value.empty()) s += " (got " + d.value + ")";
  if (!d.remedy.empty()) s += "\n  " + d.remedy;
  return s;
}

}  // namespace

std::string Diagnostic::text() const {
  return told(*this, "error: ");
}

std::string Diagnostic::warning() const {
  return told(*this, "warning: ");
}

Error::Error(Diagnostic diagnostic)
    : std::runtime_error(diagnostic.text()), diagnostic_(std::move(diagnostic)) {}

}  // namespace wishbone

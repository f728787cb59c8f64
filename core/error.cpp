#include "core/error.h"

#include <utility>

namespace wishbone {

std::string Diagnostic::text() const {
  std::string s = where.empty() ? std::string() : where + ": ";
  s += "error: " + what;
  if (!value.empty()) s += " (got " + value + ")";
  if (!remedy.empty()) s += "\n  " + remedy;
  return s;
}

Error::Error(Diagnostic diagnostic)
    : std::runtime_error(diagnostic.text()), diagnostic_(std::move(diagnostic)) {}

}  // namespace wishbone

#include "app/junit.h"

#include <fmt/core.h>

#include <algorithm>

#include "app/markup.h"

namespace wishbone {

namespace {

/// Text of an XML attribute; control characters, which XML forbids, become spaces.
std::string escaped(const std::string& text) {
  std::string out = escape_markup(text);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return out;
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<Verdict>& verdicts) {
  const auto failures =
      std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.passed; });
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  xml += fmt::format(
      "<testsuites tests=\"{0}\" failures=\"{1}\">\n<testsuite name=\"{2}\" tests=\"{0}\" failures=\"{1}\" "
      "errors=\"0\" skipped=\"0\">\n",
      verdicts.size(), failures, escaped(suite));
  for (const Verdict& verdict : verdicts) {
    xml += fmt::format("<testcase classname=\"{}\" name=\"{}\"", escaped(suite), escaped(verdict.signal));
    xml += verdict.passed
               ? "/>\n"
               : fmt::format(">\n<failure message=\"{}\"/>\n</testcase>\n", escaped(verdict.message));
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace wishbone

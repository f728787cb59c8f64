#include "app/page.h"

namespace wishbone {

std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& places) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t open = page.find("{{", at);
    out += page.substr(at, open - at);
    if (open == std::string_view::npos) return out;
    const std::size_t close = page.find("}}", open);
    out += places.find(page.substr(open + 2, close - open - 2))->second;
    at = close + 2;
  }
}

}  // namespace wishbone

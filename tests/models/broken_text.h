#pragma once

#include <ostream>
#include <string_view>

namespace wishbone {

/// A good file with one text replaced, and the whole message that it must give.
struct Broken {
  const char* name;
  std::string_view text;
  std::string_view replacement;
  const char* message;
  friend std::ostream& operator<<(std::ostream& out, const Broken& broken) { return out << broken.name; }
};

}  // namespace wishbone

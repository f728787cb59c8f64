#pragma once

#include <memory>
#include <string>

namespace wishbone {

/// The place in a text file that something was read from.
struct Source {
  std::shared_ptr<const std::string> file;  ///< as the user named it
  int line = 0;      ///< from 1; 0 when the text did not come from a file (a command line)
  int column = 0;    ///< from 1
  std::string path;  ///< keys that lead there: `bodies.chassis.mass`, `steps[1]` (from 1)

  /// "file:line:column: path", without the parts that are not known.
  std::string text() const {
    std::string s = file ? *file : std::string();
    if (line > 0) s.append(":").append(std::to_string(line)).append(":").append(std::to_string(column));
    if (!path.empty()) s.append(s.empty() ? "" : ": ").append(path);
    return s;
  }
};

}  // namespace wishbone

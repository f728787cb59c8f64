#include "app/text_file.h"

#include <fstream>

#include "core/error.h"

namespace wishbone {

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw NumericsError({path, "cannot write the file", "", "check that the folder exists and has room"});
}

}  // namespace wishbone

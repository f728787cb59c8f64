#pragma once

#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include "temporary_folder.h"

namespace wishbone {

/// True when an XML parser that is not ours accepts the text.
inline bool is_well_formed_xml(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text.xml", std::ios::binary) << text;
  const std::string python = "python3 -c \"import sys, xml.etree.ElementTree as E; E.parse(sys.argv[1])\" ";
  return std::system((python + (folder / "text.xml")).c_str()) == 0;
}

/// True when a number that is not one was written as text.
inline bool shows_nan(const std::string& text) {
  return std::regex_search(text, std::regex("\\b(nan|inf)\\b", std::regex::icase));
}

inline std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size()))
    ++count;
  return count;
}

}  // namespace wishbone

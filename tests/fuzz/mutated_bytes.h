#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

namespace wishbone::fuzz {

/// One to eight random edits, mostly few: bits, bytes, characters that mean something to readers, integers at the ends of their
/// range, pieces and lines removed, doubled or moved, the end cut off.
inline std::string mutated(std::string bytes, std::mt19937_64& random) {
  constexpr std::string_view kTelling = "0123456789-+.eEDN,;:#%*&!|>'\"@`=~?[]{}()<>/\\ \n\r\t\x80\xff\x00";
  constexpr std::array<std::uint64_t, 10> kEnds{0,      1,          0x7f,       0xff,       0x7fff,
                                                0xffff, 0x7fffffff, 0xffffffff, 1ull << 40, ~0ull};
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  std::size_t edits = 1;
  while (edits < 8 && random() % 2 == 0) ++edits;
  for (; edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = below(bytes.size());
    const std::size_t line = bytes.rfind('\n', at) + 1;  // npos + 1 == 0
    const std::size_t length =
        std::min(bytes.find('\n', at), bytes.size() - 1) + 1 - std::min(line, bytes.size() - 1);
    switch (random() % 12) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes[at] = kTelling[below(kTelling.size())];
        break;
      case 3:
        bytes.insert(at, 1 + below(3), kTelling[below(kTelling.size())]);
        break;
      case 4: {
        const std::uint64_t value = kEnds[below(kEnds.size())];
        std::memcpy(bytes.data() + at, &value,
                    std::min<std::size_t>(bytes.size() - at, std::size_t{1} << below(4)));
        break;
      }
      case 5:
        bytes[at] = static_cast<char>(bytes[at] + static_cast<char>(random() % 5) - 2);
        break;
      case 6:
        bytes.erase(at, 1 + below(20));
        break;
      case 7:
        if (random() % 4 == 0) bytes.resize(at);
        break;
      case 8:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(60)));
        break;
      case 9: {  // in place: what follows keeps its address
        const std::size_t from = below(bytes.size());
        const std::size_t count = std::min({below(60), bytes.size() - at, bytes.size() - from});
        bytes.replace(at, count, std::string(bytes, from, count));
        break;
      }
      case 10:
        if (line < bytes.size()) bytes.erase(line, length);
        break;
      default:
        if (line < bytes.size())
          bytes.insert(below(bytes.size()), bytes.substr(line, std::min<std::size_t>(length, 2000)));
        break;
    }
  }
  return bytes;
}

}  // namespace wishbone::fuzz

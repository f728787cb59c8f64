#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>

#include "core/error.h"
#include "identification/formats/uff/uff_modal_data.h"
#include "identification/formats/uff/uff_reader.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr std::size_t kMostBytes = 6000;  // of a fixture: long ones say nothing more

/// The fixture up to `kMostBytes`, and its end.
std::string text_of(const std::filesystem::path& file) {
  std::ostringstream stream;
  stream << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string text = stream.str();
  if (text.size() <= kMostBytes) return text;
  const std::size_t cut = text.find('\n', kMostBytes) + 1;
  return text.substr(0, cut) + "    -1\n";
}

/// Bytes changed or removed, the end cut off, lines taken out, doubled or moved.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  constexpr std::string_view kTelling = "0123456789-+.EDe \n\rN\x80\x00";
  for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size());
    const std::size_t line = text.rfind('\n', at) + 1;  // npos + 1 == 0
    const std::size_t length = std::min(text.find('\n', at), text.size() - 1) + 1 - line;
    switch (random() % 8) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:
        text[at] = kTelling[below(kTelling.size())];
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.erase(line, length);
        break;
      case 5:
        text.insert(line, text.substr(line, length));
        break;
      case 6:
        text.insert(below(text.size()), text.substr(line, length));
        break;
      default:
        text.erase(at, 1 + below(20));
        break;
    }
  }
  return text;
}

TEST(UffReader, EitherReadsOrRefusesWhateverItIsGiven) {
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WISHBONE_TEST_DATA "/uff")) {
    if (entry.path().extension() != ".uff") continue;
    const std::string text = text_of(entry.path());
    for (unsigned seed = 1; seed <= 5000; ++seed) {
      std::mt19937 random(seed);
      std::istringstream stream(mutated(text, random));
      try {
        read_uff(stream, "file.unv");
        ++read;
      } catch (const InputError& e) {
        ++refused;
        EXPECT_NE(e.diagnostic().where.find(" (byte "), std::string::npos)
            << entry.path() << " seed " << seed << ": " << e.what();
      }  // anything else fails the test
    }
  }
  EXPECT_GT(read, 1000);  // the edits are mild enough to get behind the first lines
  EXPECT_GT(refused, 1000);
}

TEST(UffModalData, EitherReadsOrRefusesWhateverItIsGiven) {
  const TextFiles files;
  ModalData data;
  data.title = "seed";
  data.node_ids = {1, 2, 3};
  data.node_position = Matrix3X::Random(3, 3);
  data.freedoms = all_freedoms(data.node_ids);
  data.omega = Vector3(10, 20, 30);
  data.damping_ratio = Vector3(0.01, 0.02, 0);
  data.modal_mass = Vector3(1, 2, 3);
  data.shapes = MatrixX::Random(9, 3);
  data.lines = {{1, 2}, {2, 3}};
  write_uff_modal_data(files / "seed.unv", data);
  const std::string text = text_of(files / "seed.unv");
  int read = 0, refused = 0;
  for (unsigned seed = 1; seed <= 10000; ++seed) {
    std::mt19937 random(seed);
    std::istringstream stream(mutated(text, random));
    try {
      uff_modal_data(read_uff(stream, "file.unv"), "file.unv").validate();
      ++read;
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostic().where.empty()) << "seed " << seed << ": " << e.what();
    }
  }
  EXPECT_GT(read, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace wishbone

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "core/error.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A few random edits: bytes changed, removed, doubled, or a piece copied elsewhere.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  constexpr std::string_view kTelling = "[]{}:,-#&*!|>'\"%@`=\n \t.e0123456789~?<\x80\x00";
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size());
    switch (random() % 5) {
      case 0:
        text[at] = kTelling[below(kTelling.size())];
        break;
      case 1:
        text.erase(at, 1 + below(20));
        break;
      case 2:
        text.insert(at, 1 + below(3), kTelling[below(kTelling.size())]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(60)));
        break;
      default:
        text[at] = static_cast<char>(random());
        break;
    }
  }
  return text;
}

TEST(SceneLoader, EitherLoadsOrRefusesWhateverItIsGiven) {
  const TextFiles files;
  files.write("vehicle/car.yaml", text_of(WISHBONE_SCENES "/vehicle/car.yaml"));
  const std::string steer = text_of(WISHBONE_SCENES "/impulse_steer.yaml");
  const std::string whole = load_scene(files.write("scene.yaml", steer)).text;
  int loaded = 0, refused = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    std::mt19937 random(seed);
    const auto file = files.write("scene.yaml", mutated(seed % 2 == 0 ? steer : whole, random));
    try {
      load_scene(file);
      ++loaded;
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostic().where.empty()) << "seed " << seed << ": " << e.what();
    }  // anything else fails the test
  }
  EXPECT_GT(loaded, 100);  // the edits are mild enough to reach the readers
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace wishbone

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "core/error.h"
#include "models/scene_loader.h"
#include "mutated_text.h"
#include "text_files.h"

namespace wishbone {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

constexpr Mutation kMutation{"[]{}:,-#&*!|>'\"%@`=\n \t.e0123456789~?<\x80\x00", 4, 20, 60};

TEST(SceneLoader, EitherLoadsOrRefusesWhateverItIsGiven) {
  const TextFiles files;
  files.write("vehicle/car.yaml", text_of(WISHBONE_SCENES "/vehicle/car.yaml"));
  const std::string steer = text_of(WISHBONE_SCENES "/impulse_steer.yaml");
  const std::string whole = load_scene(files.write("scene.yaml", steer)).text;
  int loaded = 0, refused = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    std::mt19937 random(seed);
    const auto file = files.write("scene.yaml", mutated(seed % 2 == 0 ? steer : whole, kMutation, random));
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

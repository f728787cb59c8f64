// A mesh that is too coarse for the lowest modes of its body is doubted when the scene is compiled, and no other.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A bar of 1 m x 30 x 30 mm whose block is cut as said.
Warnings warnings_of(std::string_view block,
                     std::string_view material = "{young: 210 GPa, poisson: 0.3, density: 7850}") {
  const TextFiles files;
  Warnings warnings = compile(load_scene(files.write("scene.yaml", fmt::format(R"(wishbone: 1
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    flexible:
      block: {{size: [1 m, 30 mm, 30 mm], {}}}
      material: {}
      modes: 2
analysis: {{duration: 1 s}}
)",
                                                                               block, material))))
                          .warnings;
  std::erase_if(warnings, [](const Diagnostic& w) { return w.what.find("too coarse") == std::string::npos; });
  return warnings;
}

TEST(CoarseMesh, ElementsThatLockAreTold) {
  const Warnings warnings = warnings_of("elements: [10, 1, 1], element: mean_dilatation");
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].where, "beam");
  EXPECT_THAT(warnings[0].value, HasSubstr(": 334 Hz"));
  EXPECT_THAT(warnings[0].remedy, HasSubstr("element: incompatible_modes"));
  // the remedy, followed
  EXPECT_THAT(warnings_of("elements: [10, 1, 1], element: incompatible_modes"), IsEmpty());
}

TEST(CoarseMesh, ElementsThatYieldAreTold) {
  EXPECT_THAT(warnings_of("elements: [90, 1, 1], element: mean_dilatation"), SizeIs(1));
  EXPECT_THAT(warnings_of("elements: [90, 1, 1]"), IsEmpty());
}

TEST(CoarseMesh, TooFewElementsAreTold) {
  for (const char* block : {"elements: [1, 1, 1]", "elements: [2, 1, 1]",
                            "elements: [2, 1, 1], element: quadratic", "elements: [2, 4, 4]"})
    EXPECT_THAT(warnings_of(block), SizeIs(1)) << block;
  for (const char* block :
       {"elements: [4, 1, 1]", "elements: [4, 1, 1], element: quadratic", "elements: [20, 2, 2]"})
    EXPECT_THAT(warnings_of(block), IsEmpty()) << block;
}

TEST(CoarseMesh, NoSceneOfTheRepositoryIsDoubted) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WISHBONE_SCENES)) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "vehicle") continue;
    for (const Diagnostic& warning : compile(load_scene(entry.path())).warnings)
      EXPECT_THAT(warning.what, testing::Not(HasSubstr("too coarse"))) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5);
}

}  // namespace
}  // namespace wishbone

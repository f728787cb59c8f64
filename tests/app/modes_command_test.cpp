// `wishbone modes`: modes of a flexible body found once, stored, and read by another scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/call.h"
#include "models/compile.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::string_view kModel = R"({
      block: {size: [1, 0.1, 0.05], elements: [3, 1, 1]},
      material: {young: 20 MPa, poisson: 0.3, density: 1000},
      modes: automatic, below: 40 Hz, damping: 2 %})";

std::string scene_with(std::string_view flexible) {
  return R"(wishbone: 1
bodies:
  beam:
    form: modal
    position: [0.5, 0, 0]
    flexible: )" +
         std::string(flexible) + R"(
  stone: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0.1]}
joints:
  hold: {type: spherical, bodies: [ground, {body: beam, node: 1}]}
springs:
  coil: {from: {body: beam, node: 16}, to: {body: stone}, stiffness: 2 kN/m, damping: 5, free_length: 0.5 m}
analysis: {duration: 1}
output: {interval: 1}
)";
}

class ModesCommand : public testing::Test {
 protected:
  TextFiles files_;
  std::string scene_ = files_.write("beam.yaml", scene_with(kModel));
  std::string out_ = files_ / "beam.h5";
};

TEST_F(ModesCommand, AStoredBodyIsTheBodyThatWasReduced) {
  const Answer answer = call("modes " + scene_ + " beam -o " + out_);
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(
      answer.text,
      AllOf(HasSubstr("modes of beam: automatic: the normal modes below 40 Hz and attachment modes of 2 "
                      "interfaces"),
            HasSubstr("attachment"), HasSubstr("beam.h5: 16 nodes, ")));
  const auto shapes_in = [](const std::string& scene) {
    return compile(load_scene(scene)).system.flexible.at(0).modal.set();
  };
  const ShapeSet found = shapes_in(scene_);
  const ShapeSet read =
      shapes_in(files_.write("stored.yaml", scene_with("{modes: {measured: {file: beam.h5}}}")));
  ASSERT_EQ(read.shape_count(), found.shape_count());
  EXPECT_LE((read.shapes - found.shapes).norm(), 1e-12 * found.shapes.norm());
  EXPECT_LE((read.stiffness - found.stiffness).norm(), 1e-12 * found.stiffness.norm());
  EXPECT_LE((read.damping - found.damping).norm(), 1e-12 * found.damping.norm());
  EXPECT_EQ(read.node_mass, found.node_mass);
}

TEST_F(ModesCommand, NamesTheFlexibleBodiesWhereTheNameIsNotOne) {
  const Answer answer = call("modes " + scene_ + " bean -o " + out_);
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("no flexible body of the scene has this name (got 'bean')"),
                                 HasSubstr("did you mean 'beam'?")));
  EXPECT_EQ(call("modes " + scene_ + " stone -o " + out_).code, 2);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ModesCommand, DoesNotOverwriteWhatItReads) {
  EXPECT_EQ(call("modes " + scene_ + " beam -o " + out_).code, 0);
  const std::string stored = files_.write("stored.yaml", scene_with("{modes: {measured: {file: beam.h5}}}"));
  EXPECT_EQ(call("modes " + stored + " beam -o " + out_).code, 2);
  EXPECT_EQ(call("modes " + stored + " beam -o " + (files_ / "again.h5").string()).code, 0);
}

}  // namespace
}  // namespace wishbone

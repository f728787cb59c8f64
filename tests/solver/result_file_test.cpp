#include "solver/result_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ResultFile, TellsSignalsAndMetaAsRecorded) {
  const TemporaryFolder folder;
  {
    Recorder recorder(folder / "a.h5",
                      {{"/b", {3}, "m/s", "world", "velocity", {}}, {"/a", {}, "1", "", "", {}}});
    recorder.append(0, std::vector<double>{1, 2, 3, 4});
    recorder.set_meta("version", "0.1.0");
    recorder.set_meta("steps", 12.0);
    recorder.set_run_meta("host", "somewhere");
    recorder.close(Outcome::kComplete);
  }
  const ResultFile file(folder / "a.h5");
  ASSERT_EQ(file.signals().size(), 2u);
  EXPECT_EQ(file.signals()[0].path, "/a");
  ASSERT_NE(file.find("/b"), nullptr);
  EXPECT_THAT(file.find("/b")->shape, ElementsAre(3));
  EXPECT_EQ(file.find("/b")->units, "m/s");
  EXPECT_EQ(file.find("/b")->frame, "world");
  EXPECT_EQ(file.find("/b")->about, "velocity");
  EXPECT_EQ(file.find("/c"), nullptr);
  EXPECT_EQ(file.read("/b"), Eigen::RowVector3d(1, 2, 3));
  EXPECT_THROW(file.read("/c"), InputError);
  EXPECT_EQ(std::get<std::string>(file.meta().at("version")), "0.1.0");
  EXPECT_EQ(std::get<double>(file.meta().at("steps")), 12);
  EXPECT_EQ(std::get<std::string>(file.run_meta().at("host")), "somewhere");
}

TEST(ResultFile, FilesWithoutTimeAreRefused) {
  const TemporaryFolder folder;
  {
    hdf5::File file = hdf5::File::create(folder / "modes.h5");
    file.write("/frequencies", {2}, std::vector<double>{1, 2});
    file.close();
  }
  EXPECT_THROW(ResultFile(folder / "modes.h5"), InputError);
}

/// What becomes of a file in which `write` put /time and the like.
std::string refusal_of(const std::function<void(hdf5::File&)>& write) {
  const TemporaryFolder folder;
  {
    hdf5::File file = hdf5::File::create(folder / "a.h5");
    write(file);
    file.close();
  }
  try {
    const ResultFile file(folder / "a.h5");
  } catch (const InputError& e) {
    return e.what();
  }
  return "it was read";
}

TEST(ResultFile, TimesMustBeOneNumberForEachRow) {
  const std::vector<double> six(6, 0);
  EXPECT_THAT(refusal_of([&](hdf5::File& file) {
                file.write("/time", {}, {six.data(), 1});
              }),
              HasSubstr("a.h5:/time: error: the times of a result are one number for each row (got [])"));
  EXPECT_THAT(refusal_of([&](hdf5::File& file) {
                file.write("/time", {3, 2}, six);
              }),
              HasSubstr("(got [3, 2])"));
  EXPECT_THAT(refusal_of([&](hdf5::File& file) { file.create_group("/time"); }),
              HasSubstr("no such dataset"));
  EXPECT_EQ(refusal_of([&](hdf5::File& file) { file.write("/time", {6}, six); }), "it was read");
}

TEST(ResultFile, NumberOfGoodRowsMustBeOne) {
  const std::vector<double> six(6, 0);
  for (const double rows : {-1.0, std::nan("")})
    EXPECT_THAT(refusal_of([&](hdf5::File& file) {
                  file.write("/time", {6}, six);
                  file.write("/meta/rows", {}, {&rows, 1});
                }),
                HasSubstr("a.h5:/meta/rows: error: this must be the number of good rows"))
        << rows;
  EXPECT_THAT(refusal_of([&](hdf5::File& file) {
                file.write("/time", {6}, six);
                file.write("/meta/rows", {0}, {});
              }),
              HasSubstr("the number of good rows"));
  const double huge = 1e300;
  EXPECT_EQ(refusal_of([&](hdf5::File& file) {
              file.write("/time", {6}, six);
              file.write("/meta/rows", {}, {&huge, 1});
            }),
            "it was read");
}

TEST(ComponentNames, FollowTheShapeTheNodesAndTheRows) {
  EXPECT_THAT(component_names({"/a", {}, "m", "", "", {}}), ElementsAre(""));
  EXPECT_THAT(component_names({"/a", {3}, "m", "world", "", {}}), ElementsAre("x", "y", "z"));
  EXPECT_THAT(component_names({"/a", {4}, "1", "world", "", {}}), ElementsAre("w", "x", "y", "z"));
  EXPECT_THAT(component_names({"/a", {3}, "m", "", "modal coordinates", {}}), ElementsAre("1", "2", "3"));
  EXPECT_THAT(component_names({"/a", {2}, "Pa", "", "stress", {{"rows", {"gauge 3", "7"}}}}),
              ElementsAre("gauge 3", "7"));
  EXPECT_THAT(component_names({"/a", {2, 3}, "m", "chassis", "", {{"nodes", {"19", "20"}}}}),
              ElementsAre("node 19 x", "node 19 y", "node 19 z", "node 20 x", "node 20 y", "node 20 z"));
  EXPECT_THAT(component_names({"/a", {1, 3}, "m", "chassis", "", {}}), ElementsAre("1 x", "1 y", "1 z"));
}

}  // namespace
}  // namespace wishbone

#include "identification/formats/mode_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "core/error.h"
#include "identification/formats/modal_data_example.h"
#include "temporary_folder.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string bytes(const std::string& path) {
  return (std::ostringstream() << std::ifstream(path, std::ios::binary).rdbuf()).str();
}

TEST(ModeFile, GivesBackWhatWasWrittenToTheLastBit) {
  const TemporaryFolder folder;
  const ModalData data = modal_data_example();
  write_mode_file(folder / "a.h5", data);
  expect_same(read_mode_file(folder / "a.h5"), data);
}

TEST(ModeFile, OfAFreeStructureWithoutMassesLinesOrModesComesBackToo) {
  const TemporaryFolder folder;
  ModalData data;
  data.node_ids = {1};
  data.node_position = Matrix3X::Zero(3, 1);
  data.shapes = MatrixX(0, 0);
  write_mode_file(folder / "a.h5", data);
  const ModalData read = read_mode_file(folder / "a.h5");
  expect_same(read, data);
  EXPECT_FALSE(read.has_masses());
  EXPECT_TRUE(read.support.empty());
}

TEST(ModeFile, OfEqualDataHasEqualBytes) {
  const TemporaryFolder folder;
  write_mode_file(folder / "a.h5", modal_data_example());
  write_mode_file(folder / "b.h5", modal_data_example());
  EXPECT_EQ(bytes(folder / "a.h5"), bytes(folder / "b.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.partial"));
}

TEST(ModeFile, DescribesItselfToOtherPrograms) {
  const TemporaryFolder folder;
  const ModalData data = modal_data_example();
  write_mode_file(folder / "a.h5", data);
  const hdf5::FileReader file(folder / "a.h5");
  for (const std::string& path : file.dataset_paths()) {
    EXPECT_NE(file.open_dataset(path).text_attribute("units"), "") << path;
    EXPECT_NE(file.open_dataset(path).text_attribute("about"), "") << path;
  }
  EXPECT_EQ(file.open_dataset("/nodes/position").text_attribute("units"), "m");
  EXPECT_EQ(file.open_dataset("/nodes/position").text_attribute("frame"), "body");
  EXPECT_EQ(file.read_matrix("/nodes/position").row(2), data.node_position.col(2).transpose());
  EXPECT_DOUBLE_EQ(file.read_matrix("/modes/frequency")(0), 1.177);
  EXPECT_EQ(file.read_matrix("/modes/shapes"), data.shapes);
  EXPECT_EQ(file.read_matrix("/support/springs").row(0), (Eigen::RowVector<double, 5>(17, 1, 0, 0, 47e3)));
  const hdf5::GroupReader meta = file.open_group("/meta");
  EXPECT_EQ(meta.text_attribute("kind"), "mode set");
  EXPECT_EQ(meta.text_attribute("title"), data.title);
  EXPECT_EQ(meta.text_attribute("support"), "2 springs, 1 joint, 2 masses");
}

TEST(ModeFile, LetsOthersAddGroups) {
  const TemporaryFolder folder;
  const ModalData data = modal_data_example();
  {
    hdf5::File file = hdf5::File::create(folder / "a.h5");
    write_mode_file(file, data);
    hdf5::Group input = file.create_group("/input");
    write_mode_file(input, data.with_modes({1}));
    file.close();
  }
  expect_same(read_mode_file(folder / "a.h5"), data);
  expect_same(read_mode_file(hdf5::FileReader(folder / "a.h5").open_group("/input")), data.with_modes({1}));
}

TEST(ModeFile, RefusesToWriteWhatIsNotValid) {
  const TemporaryFolder folder;
  ModalData data = modal_data_example();
  write_mode_file(folder / "a.h5", data);
  const std::string before = bytes(folder / "a.h5");
  data.omega[1] = -1;
  EXPECT_THROW(write_mode_file(folder / "a.h5", data), InputError);
  EXPECT_EQ(bytes(folder / "a.h5"), before);
  EXPECT_THROW(write_mode_file(folder / "absent/a.h5", modal_data_example()), NumericsError);
}

struct Damage {
  std::string name;
  std::function<void(hdf5::Group&)> write;  ///< instead of a whole mode file
  std::string place, message;
  friend std::ostream& operator<<(std::ostream& out, const Damage& damage) { return out << damage.name; }
};

/// Everything of a small mode file but what begins with `left_out`, to be written in another way.
void write_without(hdf5::Group& file, const std::string& left_out) {
  const auto write = [&](const std::string& path, const hdf5::Shape& shape,
                         const std::vector<double>& values) {
    if (!path.starts_with(left_out)) file.write(path, shape, values);
  };
  write("/nodes/id", {2}, {1, 2});
  write("/nodes/position", {2, 3}, {0, 0, 0, 1, 0, 0});
  write("/modes/angular_frequency", {1}, {10});
  write("/modes/damping_ratio", {1}, {0});
  write("/modes/modal_mass", {1}, {1});
  write("/modes/freedom_node", {2}, {1, 2});
  write("/modes/freedom_axis", {2}, {2, 2});
  write("/modes/shapes", {2, 1}, {1, -1});
  if (left_out == "/meta") return;
  hdf5::Group meta = file.create_group("/meta");
  meta.set_attribute("kind", "mode set");
  meta.set_attribute("layout", 1.0);
}

/// A mode file in which one dataset is replaced.
Damage replaced(std::string name, const std::string& path, const hdf5::Shape& shape,
                std::vector<double> values, std::string message) {
  return {std::move(name),
          [=](hdf5::Group& file) {
            write_without(file, path);
            file.write(path, shape, values);
          },
          path, std::move(message)};
}

Damage missing(const std::string& path) {
  return {"Missing " + path, [=](hdf5::Group& file) { write_without(file, path); }, path, "no such dataset"};
}

class DamagedModeFile : public testing::TestWithParam<Damage> {};

TEST_P(DamagedModeFile, IsRefusedNamingFileAndDataset) {
  const TemporaryFolder folder;
  {
    hdf5::File file = hdf5::File::create(folder / "a.h5");
    GetParam().write(file);
    file.close();
  }
  EXPECT_THAT(
      message_of<InputError>([&] { read_mode_file(folder / "a.h5"); }),
      AllOf(HasSubstr(folder / "a.h5:" + GetParam().place + ": error: "), HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Table, DamagedModeFile,
    testing::Values(
        missing("/nodes/id"), missing("/nodes/position"), missing("/modes/angular_frequency"),
        missing("/modes/damping_ratio"), missing("/modes/modal_mass"), missing("/modes/freedom_node"),
        missing("/modes/freedom_axis"), missing("/modes/shapes"),
        replaced("TwoColumnsOfPositions", "/nodes/position", {2, 2}, {0, 0, 1, 1},
                 "[2, 2])\n  [2, 3] is wanted"),
        replaced("TooFewPositions", "/nodes/position", {1, 3}, {0, 0, 0}, "wrong shape"),
        replaced("TransposedShapes", "/modes/shapes", {1, 2}, {1, -1}, "[1, 2])\n  [2, 1] is wanted"),
        replaced("ScalarIds", "/nodes/id", {}, {1}, "wrong shape"),
        replaced("CubeOfShapes", "/modes/shapes", {2, 1, 1}, {1, -1}, "wrong shape"),
        replaced("FractionalId", "/nodes/id", {2}, {1, 2.5}, "must be an integer (got 2.5)"),
        replaced("NoNumberForAnId", "/nodes/id", {2}, {1, std::nan("")}, "must be an integer"),
        replaced("HugeId", "/nodes/id", {2}, {1, 1e300}, "must be an integer"),
        replaced("FractionalAxis", "/modes/freedom_axis", {2}, {0.5, 1}, "must be an integer"),
        replaced("OneAxisTooFew", "/modes/freedom_axis", {1}, {0}, "wrong shape"),
        replaced("NarrowSprings", "/support/springs", {1, 4}, {1, 1, 0, 0}, "[any, 5] is wanted"),
        replaced("FractionalNodeOfASpring", "/support/springs", {1, 5}, {1.5, 1, 0, 0, 9},
                 "must be an integer"),
        replaced("FractionalLine", "/lines", {1, 2}, {1, 1.5}, "must be an integer"),
        Damage{"NoMeta", [](hdf5::Group& file) { write_without(file, "/meta"); }, "/", "not a mode file"},
        Damage{"OtherKind",
               [](hdf5::Group& file) {
                 write_without(file, "-");
                 file.open_group("/meta").set_attribute("kind", "road");
               },
               "/", "not a mode file"},
        Damage{"LaterLayout",
               [](hdf5::Group& file) {
                 write_without(file, "-");
                 file.open_group("/meta").set_attribute("layout", 2.0);
               },
               "/meta", "layout of mode files is not known (got layout 2)"},
        Damage{"GroupForADataset",
               [](hdf5::Group& file) {
                 write_without(file, "/modes/shapes");
                 file.create_group("/modes/shapes");
               },
               "/modes/shapes", "no such dataset"},
        // values are checked as a whole
        Damage{"NegativeFrequency",
               [](hdf5::Group& file) {
                 write_without(file, "/modes/angular_frequency");
                 file.write("/modes/angular_frequency", {1}, std::vector<double>{-1});
               },
               "/", "the frequency of mode 1 must be positive"},
        Damage{"UnknownNode",
               [](hdf5::Group& file) {
                 write_without(file, "/modes/freedom_node");
                 file.write("/modes/freedom_node", {2}, std::vector<double>{1, 7});
               },
               "/", "a freedom names a node that has no position"}));

TEST(ModeFile, ThatClaimsMoreNumbersThanItCanHoldIsRefused) {
  const TemporaryFolder folder;
  {
    hdf5::File file = hdf5::File::create(folder / "a.h5");
    write_without(file, "/nodes/id");
    const hsize_t length = hsize_t{1} << 40;  // never written: takes no room in the file
    const hdf5::Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
    const hdf5::Handle dataset(H5Dcreate2(file.id(), "/nodes/id", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT,
                                          H5P_DEFAULT, H5P_DEFAULT),
                               H5Dclose);
    file.close();
  }
  EXPECT_THAT(message_of<InputError>([&] { read_mode_file(folder / "a.h5"); }),
              HasSubstr("/nodes/id: error: the dataset claims more numbers than its file can hold"));
}

TEST(ModeFile, ThatIsCutShortOrNoHdf5IsRefused) {
  const TemporaryFolder folder;
  write_mode_file(folder / "a.h5", modal_data_example());
  const std::string whole = bytes(folder / "a.h5");
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(folder / "b.h5", std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(read_mode_file(folder / "b.h5"), InputError) << length;
  }
  EXPECT_THROW(read_mode_file(folder / "absent.h5"), InputError);
}

}  // namespace
}  // namespace wishbone

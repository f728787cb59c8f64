#include "core/hdf5_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "temporary_folder.h"

namespace wishbone::hdf5 {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::ostringstream() << file.rdbuf()).str();
}

template <class E, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const E& e) {
    return e.what();
  }
  return "no such exception";
}

TEST(Hdf5, MatricesComeBackAsTheyWere) {
  const TemporaryFolder folder;
  MatrixX M(2, 3);
  M << 1, 2, 3, 4, 5, 1.0 / 3;
  {
    File file = File::create(folder / "a.h5");
    file.write("/modal/mass", M);
    file.write("/modal/vector", {3}, std::vector<double>{7, 8, 9});
    file.write("/scalar", {}, std::vector<double>{-1.5});
    file.close();
  }
  const FileReader file(folder / "a.h5");
  EXPECT_EQ(file.read_matrix("/modal/mass"), M);
  EXPECT_EQ(file.read_matrix("/modal/vector"), Vector3(7, 8, 9));
  EXPECT_EQ(file.read_matrix("/scalar")(0, 0), -1.5);
  EXPECT_THAT(file.open_dataset("/modal/mass").shape(), ElementsAre(2, 3));
  EXPECT_THAT(file.members(), ElementsAre("modal", "scalar"));
  EXPECT_THAT(file.dataset_paths(), ElementsAre("/modal/mass", "/modal/vector", "/scalar"));
}

TEST(Hdf5, AttributesComeBackWithTheirType) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    Group group = file.create_group("/a/b");
    group.set_attribute("number", 0.1);
    group.set_attribute("text", "first line\nsecond: 5 µm");
    group.set_attribute("empty", "");
    group.set_attribute("nodes", std::vector<std::string>{"19", "20"});
    group.set_attribute("no nodes", std::vector<std::string>{});
    group.set_attribute("number", 0.2);
    file.close();
  }
  const FileReader file(folder / "a.h5");
  const GroupReader group = file.open_group("/a/b");
  EXPECT_EQ(std::get<double>(group.attribute("number")), 0.2);
  EXPECT_EQ(group.text_attribute("text"), "first line\nsecond: 5 µm");
  EXPECT_EQ(group.text_attribute("empty"), "");
  EXPECT_EQ(group.text_attribute("number"), "");
  EXPECT_EQ(group.text_attribute("absent"), "");
  EXPECT_THAT(std::get<std::vector<std::string>>(group.attribute("nodes")), ElementsAre("19", "20"));
  EXPECT_TRUE(std::get<std::vector<std::string>>(group.attribute("no nodes")).empty());
  EXPECT_EQ(group.attributes().size(), 5u);
}

TEST(Hdf5, SeriesGrowByWholeRows) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    Dataset series = file.create_series("/deep/series", {2, 3}, {.chunk_rows = 4});
    std::vector<double> rows(5 * 6);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<double>(i);
    series.append(rows);
    series.append({rows.data(), 6});
    file.close();
  }
  const DatasetReader series = FileReader(folder / "a.h5").open_dataset("/deep/series");
  EXPECT_THAT(series.shape(), ElementsAre(6, 2, 3));
  const std::vector<double> values = series.read();
  EXPECT_EQ(values[29], 29);
  EXPECT_EQ(values[30], 0);
  EXPECT_EQ(values[35], 5);
}

TEST(Hdf5, EqualInputGivesEqualBytes) {
  const TemporaryFolder folder;
  for (const char* name : {"a.h5", "b.h5"}) {
    File file = File::create(folder / name);
    Dataset series = file.create_series("/group/series", {});
    series.set_attribute("units", "m");
    series.append(std::vector<double>{1, 2, 3});
    file.write("/matrix", MatrixX::Identity(4, 4));
    file.close();
    if (name[0] == 'a') usleep(1'100'000);  // time stamps count seconds
  }
  EXPECT_EQ(bytes(folder / "a.h5"), bytes(folder / "b.h5"));
}

TEST(Hdf5, TextsThatAreNotUtf8CountAsLatin1) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    file.set_attribute("units", "m/s\xB2");
    file.create_group("h\xFClle").set_attribute("names", std::vector<std::string>{"\xE4", "ok"});
    file.write("h\xFClle/x", MatrixX::Ones(1, 1));
    file.close();
  }
  const FileReader file(folder / "a.h5");
  EXPECT_EQ(file.text_attribute("units"), "m/s\u00B2");
  EXPECT_THAT(std::get<std::vector<std::string>>(file.open_group("h\u00FClle").attribute("names")),
              ElementsAre("\u00E4", "ok"));
  EXPECT_EQ(file.read_matrix("h\u00FClle/x")(0), 1);
}

/// Every byte of a small file in turn takes other values: the reader must read or refuse, whatever the library does.
TEST(Hdf5, FilesWithAnyByteBrokenAreReadOrRefused) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    file.create_series("/x", {2}).append(std::vector<double>{1, 2, 3, 4});
    file.set_attribute("text", "x");
    file.close();
  }
  const std::string whole = bytes(folder / "a.h5");
  int read = 0, refused = 0;
  for (std::size_t at = 0; at < std::min<std::size_t>(whole.size(), 3000); at += 3) {
    std::string broken = whole;
    broken[at] = static_cast<char>(at % 2 == 0 ? ~broken[at] : 0xff);
    std::ofstream(folder / "b.h5", std::ios::binary) << broken;
    try {
      const FileReader file(folder / "b.h5");
      for (const std::string& path : file.dataset_paths()) file.open_dataset(path).read();
      ++read;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("b.h5")) << "byte " << at;
      ++refused;
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 30);
}

TEST(Hdf5, DatasetsThatClaimMoreThanTheFileCanHoldAreRefused) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    file.create_series("/x", {1000, 1000});
    file.close();
  }
  const FileReader file(folder / "a.h5");
  EXPECT_THAT(message_of<InputError>([&] { file.open_dataset("/x").read_rows(1000); }),
              HasSubstr("a.h5:/x: error: the dataset claims more numbers than its file can hold"));
}

TEST(Hdf5, PipesAreRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.h5").c_str(), 0600), 0);
  EXPECT_THROW(FileReader(folder / "a.h5"), InputError);
}

TEST(Hdf5, MissingFilesAreNamed) {
  EXPECT_THAT(message_of<InputError>([] { FileReader("/nowhere/a.h5"); }),
              AllOf(HasSubstr("/nowhere/a.h5"), HasSubstr("no such file")));
}

TEST(Hdf5, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.yaml") << "scene: 1\n";
  EXPECT_THAT(message_of<InputError>([&] { FileReader(folder / "scene.yaml"); }),
              AllOf(HasSubstr("scene.yaml"), HasSubstr("not an HDF5 file")));
  EXPECT_THAT(message_of<InputError>([&] { FileReader(folder / ""); }), HasSubstr("directory"));
}

TEST(Hdf5, FilesCutShortAreRefused) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    file.write("/matrix", MatrixX::Identity(40, 40));
    file.close();
  }
  std::filesystem::resize_file(folder / "a.h5", 2000);
  EXPECT_THAT(message_of<InputError>([&] { FileReader(folder / "a.h5"); }), HasSubstr("truncated"));
}

TEST(Hdf5, MissingDatasetsAreNamedWithWhatExists) {
  const TemporaryFolder folder;
  {
    File file = File::create(folder / "a.h5");
    file.write("/bodies/chassis/position", MatrixX::Zero(2, 3));
    file.write("/bodies/chassis/velocity", MatrixX::Zero(2, 3));
    file.close();
  }
  const FileReader file(folder / "a.h5");
  EXPECT_THAT(message_of<InputError>([&] { file.open_dataset("/bodies/chassis/positon"); }),
              AllOf(HasSubstr("a.h5:/bodies/chassis/positon"), HasSubstr("no such dataset"),
                    HasSubstr("/bodies/chassis has: position, velocity")));
  EXPECT_THAT(message_of<InputError>([&] { file.open_dataset("/tires/left/force"); }),
              HasSubstr("/ has: bodies"));
  EXPECT_THAT(message_of<InputError>([&] { file.open_group("/bodies").open_dataset("hub/position"); }),
              HasSubstr("/bodies has: chassis"));
  EXPECT_THAT(message_of<InputError>([&] { file.open_group("/bodies/chassis/position"); }),
              HasSubstr("no such group"));
}

TEST(Hdf5, FailuresToWriteCarryTheCause) {
  EXPECT_THAT(message_of<NumericsError>([] { File::create("/nowhere/a.h5"); }),
              AllOf(HasSubstr("/nowhere/a.h5"), HasSubstr("no such file or directory")));
  const TemporaryFolder folder;
  File file = File::create(folder / "a.h5");
  file.write("/x", MatrixX::Zero(1, 1));
  EXPECT_THAT(message_of<NumericsError>([&] { file.write("/x", MatrixX::Zero(1, 1)); }),
              AllOf(HasSubstr("a.h5:/x"), HasSubstr("name already exists")));
}

TEST(Hdf5, ShapesMustMatchTheValues) {
  const TemporaryFolder folder;
  File file = File::create(folder / "a.h5");
  EXPECT_THROW(file.write("/x", {2, 2}, std::vector<double>{1, 2, 3}), InputError);
}

}  // namespace
}  // namespace wishbone::hdf5

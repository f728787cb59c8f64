#include "identification/formats/modal_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/formats/modal_data_example.h"
#include "temporary_folder.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ModalFile, HasTheFormatOfItsExtension) {
  const TemporaryFolder folder;
  const ModalData data = modal_data_example();
  for (const std::string name : {"a.h5", "a.hdf5", "A.H5"}) {
    write_modal_data(folder / name, data);
    expect_same(read_modal_data(folder / name), data);
    EXPECT_THAT(modal_data_files(name), ElementsAre(name));
  }
  for (const std::string name : {"a.csv", "b.CSV"}) {
    write_modal_data(folder / name, data);
    expect_same_tables(read_modal_data(folder / name), data);
  }
  ModalData mild = data;  // of 6 digits and two of exponent
  mild.shapes << 1, 2, 3, 4, 5, 6, 7, 8;
  for (const std::string name : {"a.unv", "a.uff"}) {
    write_modal_data(folder / name, mild);
    EXPECT_EQ(read_modal_data(folder / name).mode_count(), 2);
  }
  EXPECT_THAT(modal_data_files("a.csv"), ElementsAre("a_nodes.csv", "a_frequencies.csv", "a_shapes.csv"));
}

TEST(ModalFile, TellsWhatItsFormatHasNoPlaceFor) {
  const ModalData data = modal_data_example();
  EXPECT_THAT(lost_in_modal_data("a.h5", data), IsEmpty());
  EXPECT_THAT(lost_in_modal_data("a.csv", data),
              ElementsAre("title", "support (2 springs, 1 joint, 2 masses)", "lines", "provenance"));
  EXPECT_THAT(lost_in_modal_data("a.csv", {}), IsEmpty());
  EXPECT_THAT(lost_in_modal_data("a.unv", data),
              ElementsAre("digits of the modes beyond the sixth", "nodal masses",
                          "support (2 springs, 1 joint, 2 masses)", "provenance"));
}

TEST(ModalFile, OfAnotherExtensionIsRefused) {
  for (const std::string name : {"a", "a.txt", "h5", ".h5"}) {
    EXPECT_EQ(modal_format(name), std::nullopt) << name;
    EXPECT_THAT(message_of<InputError>([&] { read_modal_data(name); }),
                AllOf(HasSubstr(name + ": error: no format of modal data"), HasSubstr(".h5, .hdf5")));
    EXPECT_THROW(write_modal_data(name, modal_data_example()), InputError);
  }
}

}  // namespace
}  // namespace wishbone

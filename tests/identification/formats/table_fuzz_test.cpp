#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "core/error.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/matrix_market.h"
#include "mutated_text.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr Mutation kMutation{"0123456789+-.eE,;\t \n\r\"#%[]xyz/^", 2, 12, 40};

struct Outcomes {
  int read = 0, refused = 0;
};

/// Reads mutations of `text`; anything but success and an InputError that names a place fails the test.
Outcomes fuzz(const std::string& text, unsigned seeds,
              const std::function<void(const std::filesystem::path&)>& read) {
  const TextFiles files;
  Outcomes outcomes;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(seed);
    try {
      read(files.write("a", mutated(text, kMutation, random)));
      ++outcomes.read;
    } catch (const InputError& e) {
      EXPECT_NE(e.diagnostic().where.find(" (byte "), std::string::npos)
          << "seed " << seed << ": " << e.what();
      ++outcomes.refused;
    }
  }
  return outcomes;
}

const std::string kNodes =
    "# frame\nnode,x[mm],y[mm],z,mass[g]\n1,0,0,0.5,10\n2,1e3,0,0,20\n3,0,\"1000\",0,0\n";
const std::string kFrequencies = "mode;frequency;damping[%];modal_mass\n7;17.35;1.5;1\n8;20.66;0;\n";
const std::string kShapes = "node,axis,mode_7,mode_8\n1,x,1,0.5\n1,-z,-0.25,1e-3\n2,x,1,1\n3,2,0,-1\n";

class CsvFuzz : public testing::Test {
 private:
  TextFiles files_;

 protected:
  static void expect_both(const Outcomes& outcomes) {
    EXPECT_GT(outcomes.read, 20);  // the edits are mild enough to reach the readers
    EXPECT_GT(outcomes.refused, 500);
  }
  CsvModalFiles tables_{files_.write("n.csv", kNodes), files_.write("f.csv", kFrequencies),
                        files_.write("s.csv", kShapes)};
};

TEST_F(CsvFuzz, NodesAreReadOrRefused) {
  expect_both(fuzz(kNodes, 1000, [&](const auto& file) {
    read_csv_modal_data({file, tables_.frequencies, tables_.shapes});
  }));
}

TEST_F(CsvFuzz, FrequenciesAreReadOrRefused) {
  expect_both(fuzz(kFrequencies, 1000, [&](const auto& file) {
    read_csv_modal_data({tables_.nodes, file, tables_.shapes});
  }));
}

TEST_F(CsvFuzz, ShapesAreReadOrRefused) {
  expect_both(fuzz(kShapes, 1000, [&](const auto& file) {
    read_csv_modal_data({tables_.nodes, tables_.frequencies, file});
  }));
}

TEST(MatrixMarketFuzz, IsReadOrRefused) {
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n% K\n";
  const std::string skew = "%%MatrixMarket matrix coordinate integer skew-symmetric\n";
  const std::string array = "%%MatrixMarket matrix array real general\n";
  for (const std::string& text :
       {symmetric + "4 4 6\n1 1 2.5\n2 1 -1.25\n2 2 2.125\n3 2 -1e3\n3 3 4.875e-2\n4 4 0.0625\n",
        skew + "300 300 4\n2 1 5235\n3 2 -7254\n200 100 123456\n212 2 43567\n",
        array + "3 2\n1.537\n-2.125\n0.0125\n4.876e2\n5.987\n6.0123\n"}) {
    const Outcomes outcomes = fuzz(text, 1000, [](const auto& file) { read_matrix_market(file); });
    EXPECT_GT(outcomes.read, 20);
    EXPECT_GT(outcomes.refused, 500);
  }
}

}  // namespace
}  // namespace wishbone

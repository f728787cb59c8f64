#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "identification/formats/uff/uff_reader.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

constexpr std::size_t kPoints = 50'000'000;  // 200 MB
constexpr std::size_t kChunk = 50'000;

float value_at(std::size_t k) {
  return static_cast<float>((k * 2654435761u) % 1000003u) - 500000.0f;
}

void write_large_file(const std::string& name) {
  std::ofstream out(name, std::ios::binary);
  out << "    -1\n    58b     1     2          11   200000000     0     0           0           0\n";
  for (int id = 0; id < 5; ++id) out << "NONE\n";
  out << "    1         0    0         0 NONE               3   1 NONE               0   0\n"
         "         2  50000000         1  0.00000E+00  1.00000E-04  0.00000E+00\n";
  for (int axis = 0; axis < 4; ++axis) out << "         0    0    0    0 NONE                 NONE\n";
  std::vector<float> chunk(kChunk);
  for (std::size_t begin = 0; begin < kPoints; begin += kChunk) {
    for (std::size_t k = 0; k < kChunk; ++k) chunk[k] = value_at(begin + k);
    out.write(reinterpret_cast<const char*>(chunk.data()), static_cast<std::streamsize>(4 * kChunk));
  }
  out << "    -1\n";
}

/// [bytes]
std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

TEST(UffReader, NeedsNoMoreMemoryThanTheDataOfALargeBinaryFile) {
  const TemporaryFolder folder;
  write_large_file(folder / "large.unv");
  const std::size_t before = peak_memory();
  const UffFile file = read_uff(folder / "large.unv");
  const std::size_t growth = peak_memory() - before;
  const auto& values = std::get<std::vector<float>>(file.functions.at(0).values);
  ASSERT_EQ(values.size(), kPoints);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < kPoints; ++k) wrong += values[k] != value_at(k);
  EXPECT_EQ(wrong, 0u);
#ifndef __SANITIZE_ADDRESS__  // whose bookkeeping grows with the data
  EXPECT_LE(growth, 4 * kPoints + 16'000'000);
  RecordProperty("megabytes_beyond_the_data",
                 static_cast<int>((static_cast<double>(growth) - 4.0 * kPoints) / 1e6));
#else
  EXPECT_GT(growth, 0u);
#endif
}

}  // namespace
}  // namespace wishbone

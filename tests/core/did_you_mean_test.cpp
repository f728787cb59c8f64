#include "core/did_you_mean.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace wishbone {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("sunday", "saturday"), 3);
  EXPECT_EQ(edit_distance("stifness", "stiffness"), 1);
  EXPECT_EQ(edit_distance("stfifness", "stiffness"), 1);  // neighbours swapped
  EXPECT_EQ(edit_distance("ca", "abc"), 3);               // no edits within a swapped pair
}

TEST(EditDistance, IsSymmetricBoundedAndZeroOnlyForEqualWords) {
  std::mt19937 random(7);
  const auto word = [&] {
    std::string s(random() % 9, 'a');
    for (char& c : s) c = static_cast<char>('a' + random() % 3);
    return s;
  };
  for (int i = 0; i < 5000; ++i) {
    const std::string a = word(), b = word();
    const int d = edit_distance(a, b);
    EXPECT_EQ(d, edit_distance(b, a));
    EXPECT_EQ(d == 0, a == b);
    EXPECT_GE(d, std::abs(static_cast<int>(a.size()) - static_cast<int>(b.size())));
    EXPECT_LE(d, static_cast<int>(std::max(a.size(), b.size())));
  }
}

TEST(DidYouMean, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> keys{"stiffness", "damping", "free_length"};
  EXPECT_EQ(did_you_mean("stifness", keys, "the keys"), "did you mean 'stiffness'?");
  EXPECT_EQ(did_you_mean("freelength", keys, "the keys"), "did you mean 'free_length'?");
  EXPECT_EQ(did_you_mean("colour", keys, "the keys"), "the keys are: stiffness, damping, free_length");
  EXPECT_EQ(did_you_mean("a", {"b"}, "the bodies"), "the bodies are: b");
  EXPECT_EQ(did_you_mean("a", {}, "the motions"), "there are none");
}

}  // namespace
}  // namespace wishbone

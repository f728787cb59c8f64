#include "app/base64.h"

#include <gtest/gtest.h>

#include <string>

namespace wishbone {
namespace {

std::string encode(const std::string& text) {
  return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

// RFC 4648, section 10.
TEST(Base64, GivesTheTestVectorsOfTheStandard) {
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foob"), "Zm9vYg==");
  EXPECT_EQ(encode("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

// 1.0f is 0x3f800000, -2.0f is 0xc0000000.
TEST(Base64, PacksFloatsInLittleEndianOrder) {
  EXPECT_EQ(base64_of_floats(std::vector<double>{1.0, -2.0}),
            encode(std::string("\0\0\x80\x3f\0\0\0\xc0", 8)));
}

}  // namespace
}  // namespace wishbone

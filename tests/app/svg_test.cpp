#include "app/svg/svg.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/svg/text_width.h"
#include "app/xml.h"
#include "core/error.h"

namespace wishbone {
namespace {

TEST(Svg, NumbersHaveTwoDecimalsAtMost) {
  EXPECT_EQ(svg_number(0), "0");
  EXPECT_EQ(svg_number(-0.001), "0");
  EXPECT_EQ(svg_number(1.5), "1.5");
  EXPECT_EQ(svg_number(-2.004), "-2");
  EXPECT_EQ(svg_number(100), "100");
  EXPECT_EQ(svg_number(2.0 / 3), "0.67");
}

TEST(Svg, WhatIsNotFiniteIsNotDrawn) {
  EXPECT_THROW(svg_number(NAN), NumericsError);
  EXPECT_THROW(svg_circle({0, INFINITY}, 1), NumericsError);
}

TEST(Svg, ElementsNestAndEscape) {
  SvgElement group = svg_group({{"class", "a\"b"}});
  group.add(svg_text({1, 2}, "x < y & z\n"));
  EXPECT_EQ(group.markup(), "<g class=\"a&quot;b\"><text x=\"1\" y=\"2\">x &lt; y &amp; z </text>\n</g>");
  EXPECT_EQ(svg_line({0, 1}, {2, 3.25}, {{"stroke", "#fff"}}).markup(),
            "<line x1=\"0\" y1=\"1\" x2=\"2\" y2=\"3.25\" stroke=\"#fff\"/>");
  EXPECT_EQ(path_through({{0, 1}, {2, 3}}), "M0 1L2 3");
}

TEST(Svg, PictureIsWellFormedXml) {
  SvgElement picture = svg_picture(100, 50, "\"<&>\"\x01 ζ");
  picture.add(svg_rectangle({0, 0}, {10, 5}));
  EXPECT_TRUE(is_well_formed_xml(picture.markup()));
}

TEST(FittedText, IsCutAtACharacterAndNotWiderThanAsked) {
  EXPECT_EQ(fitted("short", 10, 100), "short");
  std::string texts;
  for (double width = 0; width < 80; width += 3) {
    const std::string text = fitted("ζζζζ ζζζζ ζζζζ", 10, width);
    EXPECT_TRUE(text.ends_with("…"));
    EXPECT_LE(text_width(text, 10), std::max(width, text_width("…", 10)));
    texts += text;
  }
  EXPECT_TRUE(is_well_formed_xml("<t>" + texts + "</t>"));  // XML has no half characters
}

}  // namespace
}  // namespace wishbone

#include "core/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

TEST(Expression, FollowsArithmetic) {
  const std::map<std::string, double> values{{"speed", 120 / 3.6}, {"R1", 0.315}};
  EXPECT_DOUBLE_EQ(evaluate_expression("speed / (R1 - (R1 - 0.3)/3)", values), 120 / 3.6 / 0.31);
  EXPECT_DOUBLE_EQ(evaluate_expression("-2^2", {}), -4);
  EXPECT_DOUBLE_EQ(evaluate_expression("2*pi", {}), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(evaluate_expression("atan2(1, -1) + max(1, 3) + sqrt(16)", {}),
                   0.75 * std::numbers::pi + 7);
  EXPECT_DOUBLE_EQ(evaluate_expression("R1 > 0.3 ? 1 : 2", values), 1);
}

TEST(Expression, ListsTheNamesItUses) {
  EXPECT_THAT(names_in_expression("a + sin(b)*pi - a"), testing::UnorderedElementsAre("a", "b"));
  EXPECT_THAT(names_in_expression("1 + 2"), testing::IsEmpty());
}

class BadExpressions : public testing::TestWithParam<const char*> {};

TEST_P(BadExpressions, AreRefused) {
  const std::map<std::string, double> values{{"a", 0.0}};
  EXPECT_THROW(evaluate_expression(GetParam(), values), InputError) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Texts, BadExpressions,
                         testing::Values("", "1 +", "(1", "1)", "b", "a = 5", "a a", "1, 2", "1/a",
                                         "sqrt(-1)", "sin()", "1e400", "\"text\"", "a.b", "$", "log(a)"));

TEST(Expression, RefusesToDivideByZeroInWords) {
  EXPECT_EQ(message_of<InputError>([] {
              evaluate_expression("1/(a - a)", {{"a", 2.0}});
            }),
            "error: the value of the expression is not finite (got '= 1/(a - a)')\n"
            "  look for a division by zero or a root of a negative number");
}

TEST(Expression, RefusesWhatIsTooLong) {
  EXPECT_THROW(evaluate_expression(std::string(1001, '1'), {}), InputError);
  EXPECT_THROW(evaluate_expression(std::string(990, '('), {}), InputError);
}

}  // namespace
}  // namespace wishbone

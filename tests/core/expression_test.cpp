#include "core/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <muParser.h>

#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "core/dual.h"
#include "core/error.h"
#include "core/jet2.h"
#include "text_files.h"

namespace wishbone {
namespace {

TEST(Expression, FollowsArithmetic) {
  const std::map<std::string, double> values{{"speed", 120 / 3.6}, {"R1", 0.315}};
  EXPECT_DOUBLE_EQ(evaluate_expression("speed / (R1 - (R1 - 0.3)/3)", values), 120 / 3.6 / 0.31);
  EXPECT_DOUBLE_EQ(evaluate_expression("-2^2", {}), -4);
  EXPECT_DOUBLE_EQ(evaluate_expression("2^3^2", {}), 512);
  EXPECT_DOUBLE_EQ(evaluate_expression("2^-1 - -3", {}), 3.5);
  EXPECT_DOUBLE_EQ(evaluate_expression("2*pi", {}), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(evaluate_expression("atan2(1, -1) + max(1, 3) + sqrt(16)", {}),
                   0.75 * std::numbers::pi + 7);
  EXPECT_DOUBLE_EQ(evaluate_expression("R1 > 0.3 ? 1 : 2", values), 1);
  EXPECT_DOUBLE_EQ(evaluate_expression("1 ? 2 : 3 + 10", {}), 2);
  EXPECT_DOUBLE_EQ(evaluate_expression("(0 ? 2 : 3) + 10", {}), 13);
  EXPECT_DOUBLE_EQ(evaluate_expression("0 ? 1 : 0 ? 2 : 3", {}), 3);
  EXPECT_DOUBLE_EQ(evaluate_expression("sign(-3) + sign(0) + min(4, 2, 3) + max(5)", {}), 6);
  EXPECT_DOUBLE_EQ(evaluate_expression("1 < 2 && 2 < 1 || 3 >= 3", {}), 1);
}

TEST(Expression, ListsTheNamesItUses) {
  EXPECT_THAT(names_in_expression("a + sin(b)*pi - a"), testing::UnorderedElementsAre("a", "b"));
  EXPECT_THAT(names_in_expression("1 + 2"), testing::IsEmpty());
  EXPECT_THAT(Expression("c + a*0", {"a", "b", "c"}).variables(), testing::ElementsAre(0, 2));
}

TEST(Expression, EvaluatesOnlyTheBranchThatIsTaken) {
  const Expression e("x > 0 ? ln(x) : 0", {"x"});
  Dual x(-1);
  x.d[0] = 1;
  const Dual f = e(std::span<const Dual>(&x, 1));
  EXPECT_EQ(f.value, 0);
  EXPECT_EQ(f.d[0], 0);
}

/// Random formulas of x, y and z, among them none that is undefined over wide ranges.
class Formulas {
 public:
  explicit Formulas(unsigned seed) : engine_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }

  std::string formula(int depth) {
    const auto part = [&] { return formula(depth - 1); };
    const auto of = [](const std::string& f, const std::string& a) { return f + "(" + a + ")"; };
    if (depth == 0) return leaf();
    switch (pick(16)) {
      case 0:
        return part() + " + " + part();
      case 1:
        return part() + " - " + "(" + part() + ")";
      case 2:
        return "(" + part() + ")*(" + part() + ")";
      case 3:
        return part() + " / (2 + abs(" + part() + "))";
      case 4:
        return of("sin", part());
      case 5:
        return of("cos", part()) + "^2";
      case 6:
        return of("exp", "-abs(" + part() + ")");
      case 7:
        return "sqrt(1 + (" + part() + ")^2)";
      case 8:
        return "ln(2 + abs(" + part() + "))";
      case 9:
        return "(" + part() + (pick(2) ? " < " : " >= ") + part() + " ? " + part() + " : " + part() + ")";
      case 10:
        return "max(" + part() + ", " + part() + ", " + part() + ")";
      case 11:
        return "atan2(" + part() + ", 3 + cos(" + part() + "))";
      case 12:
        return "(1.5 + sin(" + part() + "))^cos(" + part() + ")";
      case 13:
        return "tanh(" + part() + ")";
      case 14:
        return "-" + of("atan", part());
      default:
        return "asin(0.9*sin(" + part() + ")) - acos(0.9*cos(" + part() + "))";
    }
  }

 private:
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(engine_); }
  std::string leaf() {
    static const std::vector<std::string> kLeaves{"x", "y", "z", "0.5", "2", "pi", "1e-1", "x", "y", "z"};
    return kLeaves[static_cast<std::size_t>(pick(10))];
  }

  std::mt19937 engine_;
};

double muparser_value(const std::string& formula, std::vector<double>& values) {
  mu::Parser parser;
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineVar("x", &values[0]);
  parser.DefineVar("y", &values[1]);
  parser.DefineVar("z", &values[2]);
  parser.SetExpr(formula);
  return parser.Eval();
}

TEST(Expression, HasTheValuesOfAnIndependentParser) {
  Formulas random(1);
  for (int i = 0; i < 3000; ++i) {
    const std::string formula = random.formula(1 + i % 3);
    if (formula.size() > 900) continue;
    std::vector<double> values{random.number(-2, 2), random.number(-2, 2), random.number(-2, 2)};
    const double expected = muparser_value(formula, values);
    const double actual = Expression(formula, {"x", "y", "z"})(std::span<const double>(values));
    EXPECT_NEAR(actual, expected, 1e-13 * std::max(1.0, std::abs(expected))) << formula;
  }
}

// Along the curve x(s) = x + x' s + x'' s^2/2, and so on, Jet2 gives d/ds and Dual the gradient: df/ds = grad
// f . x'. The second derivative is the one of the first, by central differences.
TEST(Expression, DerivativesOfBothKindsAgree) {
  Formulas random(2);
  for (int i = 0; i < 1000; ++i) {
    const std::string formula = random.formula(1 + i % 3);
    if (formula.size() > 900) continue;
    const Expression e(formula, {"x", "y", "z"});
    std::vector<Jet2> curve;
    std::vector<Dual> point;
    for (int k = 0; k < 3; ++k) {
      curve.emplace_back(random.number(-2, 2), random.number(-1, 1), random.number(-1, 1));
      point.emplace_back(curve.back().value);
      point.back().d[static_cast<std::size_t>(k)] = 1;
    }
    const Jet2 along = e(std::span<const Jet2>(curve));
    const Dual gradient = e(std::span<const Dual>(point));
    double rate = 0, scale = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      rate += gradient.d[k] * curve[k].d1;
      scale += std::abs(gradient.d[k]);
    }
    EXPECT_EQ(along.value, gradient.value) << formula;
    EXPECT_NEAR(along.d1, rate, 1e-12 * scale) << formula;

    const auto rate_at = [&](double s) {
      std::vector<Jet2> there;
      for (const Jet2& x : curve)
        there.emplace_back(x.value + x.d1 * s + 0.5 * x.d2 * s * s, x.d1 + x.d2 * s, x.d2);
      return e(std::span<const Jet2>(there)).d1;
    };
    constexpr double h = 1e-5;
    if (std::abs(rate_at(h) - rate_at(-h)) > 0.01 * scale) continue;  // a kink lies within
    EXPECT_NEAR(along.d2, (rate_at(h) - rate_at(-h)) / (2 * h), 2e-4 * (scale + std::abs(along.d2)))
        << formula;
  }
}

struct ClosedForm {
  const char* formula;
  double (*f)(double);
  double (*f1)(double);
  double (*f2)(double);
};

class ClosedForms : public testing::TestWithParam<ClosedForm> {};

TEST_P(ClosedForms, AreReachedByBothKindsOfDerivatives) {
  const ClosedForm& c = GetParam();
  const Expression e(c.formula, {"t"});
  for (const double t : {0.2, 0.45, 0.8}) {
    const Jet2 jet = Jet2::variable(t);
    const Jet2 f = e(std::span<const Jet2>(&jet, 1));
    Dual dual(t);
    dual.d[3] = 1;
    const auto near = [](double expected) { return 4e-15 * std::max(1.0, std::abs(expected)); };
    EXPECT_NEAR(f.value, c.f(t), near(c.f(t)));
    EXPECT_NEAR(f.d1, c.f1(t), near(c.f1(t)));
    EXPECT_NEAR(f.d2, c.f2(t), near(c.f2(t)));
    EXPECT_NEAR(e(std::span<const Dual>(&dual, 1)).d[3], c.f1(t), near(c.f1(t)));
  }
}

double cube(double x) {
  return x * x * x;
}

const ClosedForm kClosedForms[] = {
    {"sin(3*t)", [](double t) { return std::sin(3 * t); }, [](double t) { return 3 * std::cos(3 * t); },
     [](double t) { return -9 * std::sin(3 * t); }},
    {"cos(t)", [](double t) { return std::cos(t); }, [](double t) { return -std::sin(t); },
     [](double t) { return -std::cos(t); }},
    {"tan(t)", [](double t) { return std::tan(t); }, [](double t) { return 1 / std::pow(std::cos(t), 2); },
     [](double t) { return 2 * std::sin(t) / cube(std::cos(t)); }},
    {"asin(t)", [](double t) { return std::asin(t); }, [](double t) { return 1 / std::sqrt(1 - t * t); },
     [](double t) { return t / cube(std::sqrt(1 - t * t)); }},
    {"acos(t)", [](double t) { return std::acos(t); }, [](double t) { return -1 / std::sqrt(1 - t * t); },
     [](double t) { return -t / cube(std::sqrt(1 - t * t)); }},
    {"sinh(t)", [](double t) { return std::sinh(t); }, [](double t) { return std::cosh(t); },
     [](double t) { return std::sinh(t); }},
    {"cosh(t)", [](double t) { return std::cosh(t); }, [](double t) { return std::sinh(t); },
     [](double t) { return std::cosh(t); }},
    {"tanh(t)", [](double t) { return std::tanh(t); }, [](double t) { return 1 / std::pow(std::cosh(t), 2); },
     [](double t) { return -2 * std::sinh(t) / cube(std::cosh(t)); }},
    {"exp(-2*t)", [](double t) { return std::exp(-2 * t); }, [](double t) { return -2 * std::exp(-2 * t); },
     [](double t) { return 4 * std::exp(-2 * t); }},
    {"ln(t)", [](double t) { return std::log(t); }, [](double t) { return 1 / t; },
     [](double t) { return -1 / (t * t); }},
    {"log10(t)", [](double t) { return std::log10(t); }, [](double t) { return 1 / (t * std::log(10)); },
     [](double t) { return -1 / (t * t * std::log(10)); }},
    {"sqrt(t)", [](double t) { return std::sqrt(t); }, [](double t) { return 0.5 / std::sqrt(t); },
     [](double t) { return -0.25 / cube(std::sqrt(t)); }},
    {"t^2.5", [](double t) { return std::pow(t, 2.5); }, [](double t) { return 2.5 * std::pow(t, 1.5); },
     [](double t) { return 3.75 * std::sqrt(t); }},
    {"2^t", [](double t) { return std::pow(2, t); }, [](double t) { return std::log(2) * std::pow(2, t); },
     [](double t) { return std::log(2) * std::log(2) * std::pow(2, t); }},
    {"atan2(sin(t), cos(t))*t", [](double t) { return t * t; }, [](double t) { return 2 * t; },
     [](double) { return 2.0; }},
    {"abs(-t) + sign(t) + max(t, -t)", [](double t) { return 2 * t + 1; }, [](double) { return 2.0; },
     [](double) { return 0.0; }},
    {"step(t, 0, 1, 1, 3)", [](double t) { return 1 + 2 * cube(t) * (6 * t * t - 15 * t + 10); },
     [](double t) { return 60 * t * t * (1 - t) * (1 - t); },
     [](double t) { return 120 * t * (1 - t) * (1 - 2 * t); }}};

INSTANTIATE_TEST_SUITE_P(Functions, ClosedForms, testing::ValuesIn(kClosedForms),
                         [](const auto& param_info) { return "F" + std::to_string(param_info.index); });

TEST(Expression, WholePowersAreDefinedAtZeroAndBelow) {
  const Jet2 zero = Jet2::variable(0), below = Jet2::variable(-2);
  EXPECT_EQ(Expression("t^2", {"t"})(std::span<const Jet2>(&zero, 1)).d2, 2);
  EXPECT_EQ(Expression("t^1", {"t"})(std::span<const Jet2>(&zero, 1)).d1, 1);
  EXPECT_EQ(Expression("t^0", {"t"})(std::span<const Jet2>(&zero, 1)).d1, 0);
  EXPECT_EQ(Expression("t^3", {"t"})(std::span<const Jet2>(&below, 1)).d2, -12);
}

TEST(Expression, StepsAreConstantOutsideAndSmoothAtTheirEdges) {
  const Expression e("step(t, 1, -1, 3, 5)", {"t"});
  const auto at = [&](double t) {
    const Jet2 x = Jet2::variable(t);
    return e(std::span<const Jet2>(&x, 1));
  };
  EXPECT_EQ(at(-7).value, -1);
  EXPECT_EQ(at(9).value, 5);
  EXPECT_DOUBLE_EQ(at(2).value, 2);
  for (const double edge : {1.0, 3.0}) {
    EXPECT_NEAR(at(edge - 1e-9).value, at(edge + 1e-9).value, 1e-15);
    EXPECT_NEAR(at(edge - 1e-9).d1, at(edge + 1e-9).d1, 1e-15);
    EXPECT_NEAR(at(edge - 1e-9).d2, at(edge + 1e-9).d2, 1e-7);
  }
}

TEST(Expression, TellsWhereItsStepsBeginAndEnd) {
  const Expression e("step(t, 1, 0, 1 + a, 5) - step(t, 4, 0, t0, 1) + step(x, 7, 0, 8, 1)", {"t", "x"},
                     {{"a", 0.5}, {"t0", 6}});
  EXPECT_THAT(e.step_edges(0), testing::UnorderedElementsAre(1, 1.5, 4, 6));
  EXPECT_THAT(e.step_edges(1), testing::UnorderedElementsAre(7, 8));
  EXPECT_THAT(Expression("step(t - 1, 0, 0, 1, 1)", {"t"}).step_edges(0), testing::IsEmpty());
}

class BadExpressions : public testing::TestWithParam<const char*> {};

TEST_P(BadExpressions, AreRefused) {
  const std::map<std::string, double> values{{"a", 0.0}};
  EXPECT_THROW(evaluate_expression(GetParam(), values), InputError) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Texts, BadExpressions,
                         testing::Values("", "1 +", "(1", "1)", "b", "a = 5", "a a", "1, 2", "1/a",
                                         "sqrt(-1)", "sin()", "1e400", "\"text\"", "a.b", "$", "log(a)", "2a",
                                         "a ? 1", "? 1 : 2", "1 : 2", "atan2(1)", "step(1, 2)", "a(1)", "sin",
                                         ".", "1 ** 2", "max()", "a & a", "(a, a)", "1.2.3", "\xC3\xA4"));

struct Refusal {
  const char* name;
  const char* text;
  const char* message;
};

class ExpressionRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(ExpressionRefusals, TellPlaceAndRemedy) {
  EXPECT_EQ(message_of<InputError>([] {
              Expression(GetParam().text, {"t", "gap"}, {{"stiffness", 1.0}});
            }),
            GetParam().message);
}

const Refusal kRefusals[] = {
    {"Unclosed", "2*(t + 1",
     "error: the expression cannot be read at character 3, '(t + 1': this '(' is not closed (got '2*(t + "
     "1')\n"
     "  add the ')'"},
    {"ValueMissing", "t + ",
     "error: the expression cannot be read at its end: a value is missing (got 't + ')\n"
     "  write a number, a name, a function or '('"},
    {"UnknownName", "stifness*gap",
     "error: the expression cannot be read at character 1, 'stifness*gap': there is no 'stifness' (got "
     "'stifness*gap')\n"
     "  did you mean 'stiffness'?"},
    {"UnknownFunction", "1 + sine(t)",
     "error: the expression cannot be read at character 5, 'sine(t)': there is no function 'sine' (got '1 + "
     "sine(t)')\n"
     "  did you mean 'sin'?"},
    {"BareFunction", "sin*t",
     "error: the expression cannot be read at character 1, 'sin*t': the function 'sin' has no arguments (got "
     "'sin*t')\n"
     "  write sin(...)"},
    {"Arguments", "step(t, 0, 1)",
     "error: the expression cannot be read at character 1, 'step(t, 0, 1)': 'step' takes 5 values, not 3 "
     "(got "
     "'step(t, 0, 1)')\n"
     "  write step(x, x0, h0, x1, h1)"},
    {"StepBackwards", "step(t, 1, 0, 0.5, 1)",
     "error: the expression cannot be read at character 1, 'step(t, 1, 0, 0.5, 1)': the step ends at 0.5, "
     "where it "
     "has not begun: at 1 (got 'step(t, 1, 0, 0.5, 1)')\n"
     "  write step(x, x0, h0, x1, h1) with x0 < x1"},
    {"Assignment", "t = 1",
     "error: the expression cannot be read at character 3, '= 1': nothing can be assigned here (got 't = "
     "1')\n"
     "  to compare, write =="},
    {"NoOperator", "2 t",
     "error: the expression cannot be read at character 3, 't': an operator is missing before it (got '2 "
     "t')\n"
     "  write one of + - * / ^, a comparison, or '? :'"}};

INSTANTIATE_TEST_SUITE_P(Catalogue, ExpressionRefusals, testing::ValuesIn(kRefusals),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(Expression, RefusesANameWithTwoMeanings) {
  EXPECT_EQ(
      message_of<InputError>([] {
        Expression("2*t", {"t"}, {{"t", 1.0}});
      }),
      "error: 't' is a variable of this expression and a parameter too (got '2*t')\n  rename the parameter");
}

TEST(Expression, RefusesToDivideByZeroInWords) {
  EXPECT_EQ(message_of<InputError>([] {
              evaluate_expression("1/(a - a)", {{"a", 2.0}});
            }),
            "error: the value of the expression is not finite (got '= 1/(a - a)')\n"
            "  look for a division by zero or a root of a negative number");
}

TEST(Expression, RefusesWhatIsTooLongOrTooDeep) {
  EXPECT_THROW(evaluate_expression(std::string(1001, '1'), {}), InputError);
  EXPECT_THROW(evaluate_expression(std::string(990, '('), {}), InputError);
  EXPECT_THROW(evaluate_expression(std::string(990, '-') + "1", {}), InputError);
  std::string values = "max(t";
  for (int i = 0; i < 40; ++i) values += ", t";
  EXPECT_THROW(Expression(values + ")", {"t"}), InputError);
  std::string nested = "t", chained = "t";
  for (int i = 0; i < 200; ++i) chained += " + t";
  for (int i = 0; i < 40; ++i) nested = "t + (" + nested + ")";
  EXPECT_THROW(Expression(nested, {"t"}), InputError);
  const double one = 1;
  EXPECT_EQ(Expression(chained, {"t"})(std::span<const double>(&one, 1)), 201);
}

// Whatever the text, it is either read and evaluated, or refused.
TEST(Expression, SurvivesRandomTexts) {
  std::mt19937 random(3);
  const std::string letters = "tx01.()+-*/^<>=!&|?:, e";
  int read = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text;
    const int length = std::uniform_int_distribution(1, 14)(random);
    for (int k = 0; k < length; ++k)
      text += letters[std::uniform_int_distribution<std::size_t>(0, letters.size() - 1)(random)];
    try {
      const Expression e(text, {"t", "x"});
      const double values[]{0.5, 2};
      std::ignore = e(std::span<const double>(values));
      ++read;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace wishbone

#include "core/expression_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <string_view>
#include <system_error>

#include "core/ascii.h"
#include "core/did_you_mean.h"
#include "core/error.h"

namespace wishbone {
namespace {

struct NamedFunction {
  std::string_view name;
  Operation operation;
  int arguments;  ///< 0: one or more
};

constexpr std::array kFunctions{
    NamedFunction{"abs", Operation::abs, 1},     NamedFunction{"acos", Operation::acos, 1},
    NamedFunction{"asin", Operation::asin, 1},   NamedFunction{"atan", Operation::atan, 1},
    NamedFunction{"atan2", Operation::atan2, 2}, NamedFunction{"cos", Operation::cos, 1},
    NamedFunction{"cosh", Operation::cosh, 1},   NamedFunction{"exp", Operation::exp, 1},
    NamedFunction{"ln", Operation::ln, 1},       NamedFunction{"log10", Operation::log10, 1},
    NamedFunction{"max", Operation::max, 0},     NamedFunction{"min", Operation::min, 0},
    NamedFunction{"sign", Operation::sign, 1},   NamedFunction{"sin", Operation::sin, 1},
    NamedFunction{"sinh", Operation::sinh, 1},   NamedFunction{"sqrt", Operation::sqrt, 1},
    NamedFunction{"step", Operation::step, 5},   NamedFunction{"tan", Operation::tan, 1},
    NamedFunction{"tanh", Operation::tanh, 1}};

struct Sign {
  std::string_view text;
  Operation operation;
};
using Signs = std::initializer_list<Sign>;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, const NameReader& read_name,
                   const std::vector<std::string>& known)
      : text_(text), read_name_(read_name), known_(known) {}

  ExpressionProgram parse() && {
    constexpr std::size_t kLongest = 1000;
    if (text_.size() > kLongest) {
      throw InputError({"", fmt::format("the expression is longer than {} characters", kLongest), "",
                        "divide it over several parameters"});
    }
    choice();
    if (next() != '\0') refuse_rest();
    return std::move(program_);
  }

 private:
  // choice := either [ '?' choice ':' choice ]
  void choice() {
    const Nesting nesting(*this);
    either();
    if (!take("?")) return;
    const int condition = program_.begin_branch();
    choice();
    if (!take(":")) refuse("the ':' of '?' is missing", "write condition ? value : value");
    const int first = program_.otherwise(condition);
    choice();
    program_.end_branches(first);
  }

  void either() { chain(&ExpressionParser::both, {{"||", Operation::either}}); }
  void both() { chain(&ExpressionParser::comparison, {{"&&", Operation::both}}); }
  void comparison() {
    chain(&ExpressionParser::sum, {{"<=", Operation::less_equal},
                                   {">=", Operation::greater_equal},
                                   {"==", Operation::equal},
                                   {"!=", Operation::not_equal},
                                   {"<", Operation::less},
                                   {">", Operation::greater}});
  }
  void sum() { chain(&ExpressionParser::product, {{"+", Operation::add}, {"-", Operation::subtract}}); }
  void product() {
    chain(&ExpressionParser::signed_power, {{"*", Operation::multiply}, {"/", Operation::divide}});
  }

  // chain := operand { operator operand }, from the left
  void chain(void (ExpressionParser::*operand)(), Signs operators) {
    (this->*operand)();
    for (;;) {
      const auto found =
          std::find_if(operators.begin(), operators.end(), [&](const Sign& s) { return take(s.text); });
      if (found == operators.end()) return;
      (this->*operand)();
      program_.apply(found->operation, 2);
    }
  }

  // signed_power := ('-' | '+') signed_power | operand [ '^' signed_power ]
  void signed_power() {
    const Nesting nesting(*this);
    if (take("-")) {
      signed_power();
      return program_.apply(Operation::negate, 1);
    }
    if (take("+")) return signed_power();
    operand();
    if (!take("^")) return;
    signed_power();
    program_.apply(Operation::power, 2);
  }

  // operand := number | name | function '(' choice { ',' choice } ')' | '(' choice ')'
  void operand() {
    const char c = next();
    const std::size_t begin = at_;
    if (is_digit(c) || c == '.') {
      program_.push_constant(number());
    } else if (is_letter(c)) {
      const std::string word = name();
      if (next() == '(')
        call(word, begin);
      else
        push(word, begin);
    } else if (take("(")) {
      choice();
      close(begin);
    } else {
      refuse("a value is missing", "write a number, a name, a function or '('");
    }
    if (program_.depth() > ExpressionProgram::kMostValues) {
      at_ = begin;
      refuse("the expression is nested too deeply",
             "give its parts names of their own, or compute from left to right");
    }
  }

  double number() {
    double value = 0;
    const char* first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range)
      refuse("the number does not fit", "numbers go up to about 1e308 and down to 1e-308");
    if (error != std::errc()) refuse("not a number", "write it as in 12, 0.5 or 3e-2");
    at_ += static_cast<std::size_t>(end - first);
    return value;
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void push(const std::string& word, std::size_t begin) {
    if (word == "pi") return program_.push_constant(std::numbers::pi);
    const std::optional<NameMeaning> meaning = read_name_(word);
    if (!meaning) {
      at_ = begin;
      const auto& functions = expression_functions();
      if (std::binary_search(functions.begin(), functions.end(), word))
        refuse(fmt::format("the function '{}' has no arguments", word), fmt::format("write {}(...)", word));
      refuse(fmt::format("there is no '{}'", word), did_you_mean(word, known_, "the names known here"));
    }
    if (meaning->is_variable)
      program_.push_variable(meaning->index);
    else
      program_.push_constant(meaning->value);
  }

  void call(const std::string& word, std::size_t begin) {
    const auto* function = std::find_if(kFunctions.begin(), kFunctions.end(),
                                        [&](const NamedFunction& f) { return f.name == word; });
    if (function == kFunctions.end()) {
      at_ = begin;
      refuse(fmt::format("there is no function '{}'", word),
             word == "log" ? "write ln for the natural logarithm, log10 for the decimal one"
                           : did_you_mean(word, expression_functions(), "the functions"));
    }
    const std::size_t opening = at_;
    take("(");
    std::vector<int> begins;
    do {
      begins.push_back(program_.size());
      choice();
    } while (take(","));
    close(opening);
    const int count = static_cast<int>(begins.size());
    if (function->arguments > 0 && count != function->arguments) {
      at_ = begin;
      refuse(fmt::format("'{}' takes {} value{}, not {}", word, function->arguments,
                         function->arguments == 1 ? "" : "s", count),
             word == "step" ? "write step(x, x0, h0, x1, h1)" : "separate the values by commas");
    }
    if (function->operation == Operation::step) check_step(begins, begin);
    program_.apply(function->operation, count);
  }

  void check_step(const std::vector<int>& begins, std::size_t place) {
    if (!program_.is_constant(begins[1], begins[2]) || !program_.is_constant(begins[3], begins[4])) return;
    const double first = program_.at(begins[1]).number, last = program_.at(begins[3]).number;
    if (!(first < last)) {
      at_ = place;
      refuse(fmt::format("the step ends at {}, where it has not begun: at {}", last, first),
             "write step(x, x0, h0, x1, h1) with x0 < x1");
    }
    if (program_.is_variable(begins[0], begins[1]))
      program_.note_step(program_.at(begins[0]).index, first, last);
  }

  void close(std::size_t opening) {
    if (take(")")) return;
    if (next() != '\0') refuse_rest();
    at_ = opening;
    refuse("this '(' is not closed", "add the ')'");
  }

  [[noreturn]] void refuse_rest() {
    const char c = next();
    if (c == ')') refuse("there is no '(' for this ')'", "remove it, or add the '('");
    if (c == ',')
      refuse("a comma belongs between the arguments of a function", "write numbers with a decimal point");
    if (c == '=') refuse("nothing can be assigned here", "to compare, write ==");
    refuse("an operator is missing before it", "write one of + - * / ^, a comparison, or '? :'");
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
    constexpr std::size_t kShown = 24;
    std::size_t end = std::min(text_.size(), at_ + kShown);
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80)
      ++end;  // whole letters
    const std::string place = at_ >= text_.size()
                                  ? "its end"
                                  : fmt::format("character {}, '{}'", at_ + 1, text_.substr(at_, end - at_));
    throw InputError({"", fmt::format("the expression cannot be read at {}: {}", place, what),
                      fmt::format("'{}'", text_), remedy});
  }

  /// The next character that is no blank; zero at the end.
  char next() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(std::string_view sign) {
    next();
    if (!std::string_view(text_).substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }

  /// Against texts of brackets alone, which would use up the memory for calls.
  struct Nesting {
    explicit Nesting(ExpressionParser& p) : parser(p) {
      constexpr int kDeepest = 100;
      if (++parser.level_ > kDeepest)
        parser.refuse("the expression is nested too deeply", "give its parts names of their own");
    }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    ~Nesting() { --parser.level_; }
    ExpressionParser& parser;
  };

  const std::string& text_;
  const NameReader& read_name_;
  const std::vector<std::string>& known_;
  ExpressionProgram program_;
  std::size_t at_ = 0;
  int level_ = 0;
};

}  // namespace

ExpressionProgram parse_expression(const std::string& text, const NameReader& read_name,
                                   const std::vector<std::string>& known) {
  return ExpressionParser(text, read_name, known).parse();
}

const std::vector<std::string>& expression_functions() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedFunction& f : kFunctions) list.emplace_back(f.name);
    return list;
  }();
  return names;
}

}  // namespace wishbone

#include "core/expression_program.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "core/dual.h"
#include "core/jet2.h"

namespace wishbone {
namespace {

/// Room for values that are not made before they are needed.
template <class T>
union Stack {
  Stack() {}
  T values[ExpressionProgram::kMostValues];
};

template <class T>
T smooth_step(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  if (value_of(x) <= value_of(x0)) return h0;
  if (value_of(x) >= value_of(x1)) return h1;
  const T u = (x - x0) / (x1 - x0);
  return h0 + (h1 - h0) * (u * u * u * (u * (6.0 * u - 15.0) + 10.0));
}

template <class T>
T one_of(Operation operation, const T& a) {
  using std::abs, std::acos, std::asin, std::atan, std::cos, std::cosh, std::exp, std::log, std::log10,
      std::sin;
  using std::sinh, std::sqrt, std::tan, std::tanh;
  switch (operation) {
    case Operation::negate:
      return -a;
    case Operation::sin:
      return sin(a);
    case Operation::cos:
      return cos(a);
    case Operation::tan:
      return tan(a);
    case Operation::asin:
      return asin(a);
    case Operation::acos:
      return acos(a);
    case Operation::atan:
      return atan(a);
    case Operation::sinh:
      return sinh(a);
    case Operation::cosh:
      return cosh(a);
    case Operation::tanh:
      return tanh(a);
    case Operation::exp:
      return exp(a);
    case Operation::ln:
      return log(a);
    case Operation::log10:
      return log10(a);
    case Operation::sqrt:
      return sqrt(a);
    case Operation::abs:
      return abs(a);
    default:  // sign
      return T(static_cast<double>((value_of(a) > 0) - (value_of(a) < 0)));
  }
}

bool holds(Operation comparison, double a, double b) {
  switch (comparison) {
    case Operation::less:
      return a < b;
    case Operation::less_equal:
      return a <= b;
    case Operation::greater:
      return a > b;
    case Operation::greater_equal:
      return a >= b;
    case Operation::equal:
      return a == b;
    case Operation::not_equal:
      return a != b;
    case Operation::both:
      return a != 0 && b != 0;
    default:  // either
      return a != 0 || b != 0;
  }
}

template <class T>
T one_of(Operation operation, const T& a, const T& b) {
  using std::atan2, std::pow;
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return pow(a, b);
    case Operation::atan2:
      return atan2(a, b);
    default:
      return T(holds(operation, value_of(a), value_of(b)) ? 1.0 : 0.0);
  }
}

template <class T>
T extreme_of(const T* values, int count, bool largest) {
  const T* best = values;
  for (const T* v = values + 1; v < values + count; ++v)
    if (largest ? value_of(*v) > value_of(*best) : value_of(*v) < value_of(*best)) best = v;
  return *best;
}

bool is_binary(Operation operation) {
  return (operation >= Operation::add && operation <= Operation::either) || operation == Operation::atan2;
}

}  // namespace

template <class T>
T ExpressionProgram::run(std::span<const T> variables) const {
  using std::pow;
  Stack<T> stack;
  T* top = stack.values;  // above the last value
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const Instruction& c = code_[i];
    switch (c.operation) {
      case Operation::constant:
        std::construct_at(top++, c.number);
        break;
      case Operation::variable:
        std::construct_at(top++, variables[static_cast<std::size_t>(c.index)]);
        break;
      case Operation::jump:
        i = static_cast<std::size_t>(c.index) - 1;
        break;
      case Operation::jump_if_zero:
        if (value_of(*--top) == 0) i = static_cast<std::size_t>(c.index) - 1;
        break;
      case Operation::power_of:
        top[-1] = pow(top[-1], c.number);
        break;
      case Operation::min:
      case Operation::max:
        top -= c.index - 1;
        top[-1] = extreme_of(top - 1, c.index, c.operation == Operation::max);
        break;
      case Operation::step:
        top -= 4;
        top[-1] = smooth_step(top[-1], top[0], top[1], top[2], top[3]);
        break;
      default:
        if (is_binary(c.operation)) {
          --top;
          top[-1] = one_of(c.operation, top[-1], top[0]);
        } else {
          top[-1] = one_of(c.operation, top[-1]);
        }
    }
  }
  return top[-1];
}

template double ExpressionProgram::run(std::span<const double>) const;
template Jet2 ExpressionProgram::run(std::span<const Jet2>) const;
template Dual ExpressionProgram::run(std::span<const Dual>) const;

std::vector<int> ExpressionProgram::variables() const {
  std::set<int> used;
  for (const Instruction& c : code_)
    if (c.operation == Operation::variable) used.insert(c.index);
  return {used.begin(), used.end()};
}

std::vector<double> ExpressionProgram::step_edges(int variable) const {
  std::vector<double> edges;
  for (const StepEdges& step : steps_)
    if (step.variable == variable) edges.insert(edges.end(), {step.begin, step.end});
  return edges;
}

std::vector<double> ExpressionProgram::switches(int variable) const {
  std::vector<double> places;
  const auto is_variable = [&](const Instruction& c) {
    return c.operation == Operation::variable && c.index == variable;
  };
  for (std::size_t i = 2; i < code_.size(); ++i) {
    const Instruction &a = code_[i - 2], &b = code_[i - 1];
    if (code_[i].operation < Operation::less || code_[i].operation > Operation::not_equal) continue;
    if (is_variable(a) && b.operation == Operation::constant) places.push_back(b.number);
    if (is_variable(b) && a.operation == Operation::constant) places.push_back(a.number);
  }
  return places;
}

void ExpressionProgram::push(Instruction instruction) {
  code_.push_back(instruction);
  deepest_ = std::max(deepest_, ++height_);
}

bool ExpressionProgram::is_constant(int begin, int end) const {
  return end == begin + 1 && begin >= meeting_ && at(begin).operation == Operation::constant;
}

bool ExpressionProgram::is_variable(int begin, int end) const {
  return end == begin + 1 && begin >= meeting_ && at(begin).operation == Operation::variable;
}

void ExpressionProgram::apply(Operation operation, int arguments) {
  height_ -= arguments - 1;
  if (fold(operation, arguments)) return;
  if (operation == Operation::power && is_constant(size() - 1, size()))
    code_.back().operation = Operation::power_of;
  else
    code_.push_back({operation, arguments, 0});
}

/// Does now what depends on nothing.
bool ExpressionProgram::fold(Operation operation, int arguments) {
  const int begin = size() - arguments;
  for (int i = begin; i < size(); ++i)
    if (!is_constant(i, i + 1)) return false;
  ExpressionProgram part;
  part.code_.assign(code_.end() - arguments, code_.end());
  part.code_.push_back({operation, arguments, 0});
  code_.resize(static_cast<std::size_t>(begin));
  code_.push_back({Operation::constant, 0, part.run<double>({})});
  return true;
}

int ExpressionProgram::begin_branch() {
  code_.push_back({Operation::jump_if_zero, 0, 0});
  --height_;
  meet_here();
  return size() - 1;
}

int ExpressionProgram::otherwise(int branch) {
  code_.push_back({Operation::jump, 0, 0});
  --height_;
  code_[static_cast<std::size_t>(branch)].index = size();
  meet_here();
  return size() - 1;
}

void ExpressionProgram::end_branches(int branch) {
  code_[static_cast<std::size_t>(branch)].index = size();
  meet_here();
}

}  // namespace wishbone

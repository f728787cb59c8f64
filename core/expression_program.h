#pragma once

#include <span>
#include <vector>

namespace wishbone {

/// What one instruction does with the values on top of the stack.
enum class Operation {
  constant,  ///< pushes `number`
  variable,  ///< pushes the variable `index`
  jump,      ///< goes on at the instruction `index`
  jump_if_zero,
  power_of,  ///< top ^ `number`
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  both,
  either,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  sinh,
  cosh,
  tanh,
  exp,
  ln,
  log10,
  sqrt,
  abs,
  sign,
  min,  ///< of the topmost `index` values
  max,
  step  ///< of five
};

struct Instruction {
  Operation operation = Operation::constant;
  int index = 0;
  double number = 0;
};

/// An expression in postfix order, for a machine with a small stack. Written by ExpressionParser; grows by
/// the member functions below, which work out what is constant.
class ExpressionProgram {
 public:
  static constexpr int kMostValues = 32;  ///< on the stack at once

  /// The value for given variables. Instantiated for double, Jet2 and Dual.
  template <class T>
  T run(std::span<const T> variables) const;

  std::vector<int> variables() const;
  std::vector<double> step_edges(int variable) const;
  std::vector<double> switches(int variable) const;

  void push_constant(double value) { push({Operation::constant, 0, value}); }
  void push_variable(int index) { push({Operation::variable, index, 0}); }
  /// Replaces the topmost `arguments` values by the result.
  void apply(Operation operation, int arguments);
  /// Begins a branch, which is skipped when the top value is zero; returns what `otherwise` wants.
  int begin_branch();
  /// Ends the branch that is taken and begins the other; returns what `end_branches` wants.
  int otherwise(int branch);
  void end_branches(int branch);

  /// Place of the next instruction.
  int size() const { return static_cast<int>(code_.size()); }
  /// Whether the instructions from `begin` to `end` are one constant, or one variable.
  bool is_constant(int begin, int end) const;
  bool is_variable(int begin, int end) const;
  const Instruction& at(int place) const { return code_[static_cast<std::size_t>(place)]; }
  /// Remembers the edges of a step along a variable.
  void note_step(int variable, double begin, double end) { steps_.push_back({variable, begin, end}); }
  /// The most values that are on the stack at once.
  int depth() const { return deepest_; }

 private:
  struct StepEdges {
    int variable;
    double begin, end;
  };

  void push(Instruction instruction);
  bool fold(Operation operation, int arguments);
  void meet_here() { meeting_ = size(); }

  std::vector<Instruction> code_;
  std::vector<StepEdges> steps_;
  int height_ = 0, deepest_ = 0;
  int meeting_ = 0;  // branches meet here: what stands before has not one value
};

}  // namespace wishbone

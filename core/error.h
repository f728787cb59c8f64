#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace wishbone {

/// What went wrong, told so that the reader can mend it.
struct Diagnostic {
  std::string where;   ///< `file:line:column: path.of.key`, or the name of an element and a time
  std::string what;    ///< the rule that was broken
  std::string value;   ///< the offending value as written; empty when there is none
  std::string remedy;  ///< what to do about it

  /// "where: error: what (got value)\n  remedy"
  std::string text() const;
  /// "where: warning: what (got value)\n  remedy"
  std::string warning() const;
};

/// What a user should doubt of a scene, a run or a result although it went through. Collected on the way: by a Scene while it
/// is read, by a CompiledScene, by a TransientSummary; printed, and kept with the results in the attribute `warnings` of /meta.
using Warnings = std::vector<Diagnostic>;

/// Base of every error that wishbone reports to its user.
class Error : public std::runtime_error {
 public:
  explicit Error(Diagnostic diagnostic);
  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  Diagnostic diagnostic_;
};

/// The user's input is wrong: nothing was computed. Exit code 2 of the command.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The numerics failed: what was computed up to then is kept. Exit code 3 of the command.
class NumericsError : public Error {
 public:
  using Error::Error;
};

}  // namespace wishbone

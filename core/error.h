#pragma once

#include <stdexcept>
#include <string>

namespace wishbone {

/// What went wrong, told so that the reader can mend it.
struct Diagnostic {
  std::string where;   ///< `file:line:column: path.of.key`, or the name of an element and a time
  std::string what;    ///< the rule that was broken
  std::string value;   ///< the offending value as written; empty when there is none
  std::string remedy;  ///< what to do about it

  /// "where: error: what (got value)\n  remedy"
  std::string text() const;
};

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

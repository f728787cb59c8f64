#pragma once

#include <CLI/CLI.hpp>

namespace wishbone {

/// What the command returns to the shell.
enum ExitCode : int {
  kDone = 0,
  kComparisonFailed = 1,  ///< the files differ by more than they may
  kBadInput = 2,          ///< command line, scene or file: nothing was computed
  kNumericsFailed = 3,    ///< or interrupted, or no disk or memory left: what was computed is kept, so marked
  kDefect = 70,           ///< an error that wishbone did not foresee (EX_SOFTWARE of sysexits.h)
};

// Each sub-command lives in a file of its own and adds itself to `app`; when it is the one asked for, it runs
// while the command line is parsed and leaves its result in `exit_code`.
void add_check(CLI::App& app, ExitCode& exit_code);
void add_compare(CLI::App& app, ExitCode& exit_code);
void add_convert(CLI::App& app, ExitCode& exit_code);
void add_extract(CLI::App& app, ExitCode& exit_code);
void add_identify(CLI::App& app, ExitCode& exit_code);
void add_info(CLI::App& app, ExitCode& exit_code);
void add_modes(CLI::App& app, ExitCode& exit_code);
void add_plan(CLI::App& app, ExitCode& exit_code);
void add_run(CLI::App& app, ExitCode& exit_code);

}  // namespace wishbone

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "app/command.h"
#include "core/did_you_mean.h"
#include "core/error.h"
#include "core/hdf5.h"
#include "core/version.h"

namespace wishbone {

namespace {

/// @throws InputError when the first argument is a word that names no sub-command
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) == names.end())
    throw InputError(
        {"", "no such command", fmt::format("'{}'", argv[1]), did_you_mean(argv[1], names, "the commands")});
}

/// The prefix that makes up for a place: who speaks, where a log holds the words of many programs.
void print_error(const Error& error) {
  fmt::print(stderr, "{}{}\n", error.diagnostic().where.empty() ? "wishbone: " : "", error.what());
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Rigid and flexible multibody simulation of vehicles.", "wishbone");
  app.set_version_flag("--version", fmt::format("wishbone {} ({})", kVersion, kGitRevision),
                       "Tell the version and end");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a comparison failed, 2 bad input, 3 the numerics failed or the run was "
      "interrupted,\n"
      "70 a defect of wishbone.\n"
      "`wishbone COMMAND --help` shows options and an example.");
  ExitCode exit_code = kDone;
  add_run(app, exit_code);
  add_plan(app, exit_code);
  add_check(app, exit_code);
  add_compare(app, exit_code);
  add_extract(app, exit_code);
  add_identify(app, exit_code);
  add_modes(app, exit_code);
  add_info(app, exit_code);
  add_convert(app, exit_code);
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0)
      throw InputError(
          {"", e.what(), "", "`wishbone --help` and `wishbone COMMAND --help` tell what there is"});
    app.exit(e);  // --help and --version are errors to CLI11, and successes
  }
  return exit_code;
}

}  // namespace

}  // namespace wishbone

int main(int argc, char** argv) {
  wishbone::hdf5::leave_out_exit_handler();
  try {
    return wishbone::run(argc, argv);
  } catch (const wishbone::InputError& e) {
    wishbone::print_error(e);
    return wishbone::kBadInput;
  } catch (const wishbone::NumericsError& e) {
    wishbone::print_error(e);
    return wishbone::kNumericsFailed;
  } catch (const std::bad_alloc&) {
    std::fputs(
        "wishbone: error: not enough memory\n"
        "  Ask for less (output interval, recorded nodes, elements of flexible bodies), or take a larger "
        "computer.\n",
        stderr);
    return wishbone::kNumericsFailed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "wishbone: unexpected error: {}\n  This is a defect of wishbone: please report it.\n",
               e.what());
    return wishbone::kDefect;
  }
}

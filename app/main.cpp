#include <fcntl.h>
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/command.h"
#include "core/descriptor.h"
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

/// Descriptors 0 to 2 that the caller has closed would be given to the next files that are opened, and what is meant for the
/// terminal would be written into them. They are opened the wrong way round, so that their use fails and is told.
void occupy_standard_descriptors() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) < 0)
      return;
}

/// On standard error; when that cannot be written, the exit code is all that is left to say.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

/// The prefix that makes up for a place: who speaks, where a log holds the words of many programs.
void tell(const Error& error) {
  tell(fmt::format("{}{}\n", error.diagnostic().where.empty() ? "wishbone: " : "", error.what()));
}

ExitCode lost_output(int error_number) {
  tell(fmt::format(
      "wishbone: error: standard output cannot be written: {}\n  Files that were to be written are whole.\n",
      system_reason(error_number)));
  return kNumericsFailed;
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Rigid and flexible multibody simulation of vehicles.", "wishbone");
  app.set_version_flag("--version", fmt::format("wishbone {} ({})", kVersion, kGitRevision),
                       "Tell the version and end");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a comparison failed, 2 bad input, 3 the numerics failed, the run was "
      "interrupted,\n"
      "or the output could not be written, 70 a defect of wishbone.\n"
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

/// run() with its exceptions turned into words and an exit code.
ExitCode answer(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& e) {
    tell(e);
    return kBadInput;
  } catch (const NumericsError& e) {
    tell(e);
    return kNumericsFailed;
  } catch (const std::bad_alloc&) {
    tell(
        "wishbone: error: not enough memory\n"
        "  Ask for less (output interval, recorded nodes, elements of flexible bodies), or take a larger "
        "computer.\n");
    return kNumericsFailed;
  } catch (const std::system_error& e) {
    if (std::ferror(stdout) != 0) return lost_output(e.code().value());
    tell(fmt::format("wishbone: error: {}\n", e.what()));
    return kNumericsFailed;
  } catch (const std::exception& e) {
    tell(fmt::format("wishbone: unexpected error: {}\n  This is a defect of wishbone: please report it.\n",
                     e.what()));
    return kDefect;
  }
}

/// Success is what has been told: 0 becomes 3 when some of it was lost on the way.
ExitCode told(ExitCode code) {
  if (code != kDone) return code;
  if (std::fflush(stdout) != 0) return lost_output(errno);
  return std::ferror(stdout) != 0 || std::ferror(stderr) != 0 ? kNumericsFailed : kDone;
}

}  // namespace

}  // namespace wishbone

int main(int argc, char** argv) {
  wishbone::occupy_standard_descriptors();
  // A pipe that is closed and a file that may grow no more are failures to write like others.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  wishbone::hdf5::leave_out_exit_handler();
  return wishbone::told(wishbone::answer(argc, argv));
}

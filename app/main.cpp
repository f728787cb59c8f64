#include <fmt/core.h>

#include <exception>

#include "app/command.h"
#include "core/error.h"

namespace {

wishbone::ExitCode run(int argc, char** argv) {
  using namespace wishbone;
  CLI::App app("Rigid and flexible multibody simulation of vehicles.", "wishbone");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a comparison failed, 2 bad input, 3 the numerics failed.\n"
      "`wishbone COMMAND --help` shows options and an example.");
  ExitCode exit_code = kDone;
  add_run(app, exit_code);
  add_plan(app, exit_code);
  add_check(app, exit_code);
  add_compare(app, exit_code);
  add_extract(app, exit_code);
  add_info(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kDone : kBadInput;  // --help is an error to CLI11, and a success
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const wishbone::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return wishbone::kBadInput;
  } catch (const wishbone::NumericsError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return wishbone::kNumericsFailed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "wishbone: unexpected error: {}\n  This is a defect of wishbone: please report it.\n",
               e.what());
    return wishbone::kDefect;
  }
}

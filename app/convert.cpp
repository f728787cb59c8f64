#include <fmt/core.h>

#include <memory>

#include "app/check_output.h"
#include "app/command.h"
#include "app/modal_summary.h"
#include "identification/formats/modal_file.h"

namespace wishbone {

namespace {

struct Options {
  std::string input, output;
};

/// A name may stand for several files, which are all read or written.
void check_files(const Options& options) {
  std::vector<std::string> inputs;
  for (const auto& file : modal_data_files(options.input)) inputs.push_back(file.string());
  check_modal_output(options.output, inputs);
}

/// What a reader made of numbers that do not speak for themselves.
void tell_understood(const ModalData& data) {
  print_extent(data);
  for (const std::string& line : data.provenance) fmt::print("  {}\n", line);
}

ExitCode run(const Options& options) {
  check_files(options);
  const ModalData data = read_modal_data(options.input);
  write_and_tell(options.output, data);
  tell_understood(data);
  warn_of_units(options.input, data);
  return kDone;
}

}  // namespace

void add_convert(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("convert", "Write modal data in another format");
  command->add_option("IN", options->input, "file of modes")->required();
  command->add_option("OUT", options->output, "file to write")->required();
  command->footer(
      "The extensions tell the formats: .h5 (mode file), .unv and .uff (Universal File), .csv (NAME.csv "
      "stands for\n"
      "the tables NAME_nodes.csv, NAME_frequencies.csv and NAME_shapes.csv). What the format of OUT has no "
      "place for\n"
      "is named.\n\n"
      "Example:\n  wishbone convert frame.unv frame.h5");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone

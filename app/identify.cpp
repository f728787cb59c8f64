#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app/check_output.h"
#include "app/command.h"
#include "app/identification_html.h"
#include "app/identification_pictures.h"
#include "app/identification_text.h"
#include "app/meta_text.h"
#include "core/partial_file.h"
#include "core/yaml.h"
#include "identification/formats/identification_file.h"
#include "identification/formats/matrix_market.h"
#include "identification/formats/modal_file.h"
#include "models/identification_loader.h"

namespace wishbone {

namespace {

struct Options {
  std::string input, output;
  std::vector<std::string> set;
  std::optional<std::string> also, html, pictures, matrices;
  bool json = false;
};

/// Names of the files of the matrices.
std::string mass_file(const std::string& prefix) {
  return prefix + "_M.mtx";
}
std::string stiffness_file(const std::string& prefix) {
  return prefix + "_K.mtx";
}

/// The files that the options name.
std::vector<std::string> output_files(const Options& options) {
  std::vector<std::string> files{options.output};
  if (options.also)
    for (const auto& file : modal_data_files(*options.also)) files.push_back(file.string());
  if (options.html) files.push_back(*options.html);
  if (options.matrices) {
    files.push_back(mass_file(*options.matrices));
    files.push_back(stiffness_file(*options.matrices));
  }
  return files;
}

void check_outputs(const Options& options, const std::vector<std::string>& inputs) {
  std::set<std::filesystem::path> taken;
  for (const std::string& file : output_files(options)) {
    check_output(file, inputs);
    if (!taken.insert(std::filesystem::weakly_canonical(file)).second)
      throw InputError({file, "two outputs have the same name", "", "give each output a name of its own"});
  }
  if (options.pictures) check_output_folder(*options.pictures);
}

void write_outputs(const Options& options, const Identification& result) {
  write_identification(options.output, result);
  if (options.also) write_modal_data(*options.also, result.modes);
  if (options.html) write_file(*options.html, identification_html(result));
  if (options.pictures) write_pictures(*options.pictures, result);
  if (!options.matrices) return;
  const auto symmetric = [](const MatrixX& A) -> SparseMatrix {
    return MatrixX((A + A.transpose()) / 2).sparseView();
  };
  const CorrectedModel matrices = identified_matrices(result);
  write_matrix_market(mass_file(*options.matrices), symmetric(matrices.M), true);
  write_matrix_market(stiffness_file(*options.matrices), symmetric(matrices.K), true);
}

ExitCode run(const Options& options) {
  const LoadedIdentification loaded = load_identification(options.input, options.set);
  check_outputs(options, loaded.files);
  Source where = loaded.where;
  where.path.clear();  // the error says itself what it is about
  const Identification result = within(where, [&] { return identify(loaded.task); });
  write_outputs(options, result);
  if (options.json)
    fmt::print("{}\n", json_text(json_of(result)));
  else
    fmt::print("{}\nmodes in {}\n", text_of(result), options.output);
  return kDone;
}

}  // namespace

void add_identify(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "identify", "Find the modes of a structure from modes that were measured on a support");
  command->add_option("IDENT", options->input, "file with a section 'identification' (YAML)")->required();
  command->add_option("-o,--output", options->output, "mode file to write (HDF5)")->required();
  command->add_option("--set", options->set, "replace a parameter of the file: name=value (several allowed)");
  command->add_option("--also", options->also,
                      "write the modes in another format too: .unv, .uff, .csv, .h5");
  command->add_option("--html", options->html, "write a page with tables and pictures to this file");
  command->add_option("--pictures", options->pictures,
                      "write mode shapes and MAC matrices as SVG into this folder");
  command->add_option(
      "--matrices", options->matrices,
      "write mass and stiffness to PREFIX_M.mtx and PREFIX_K.mtx (MatrixMarket): of a corrected model,\n"
      "else what the modes stand for");
  command->add_flag("--json", options->json, "print JSON");
  command->footer(
      "What the file may say: docs/identification.md.\n\n"
      "Example:\n  wishbone identify models/identification/chassis_on_springs.yaml -o chassis.h5 --html "
      "chassis.html");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone

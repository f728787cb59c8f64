#include "models/identification_loader.h"

#include <fmt/format.h>

#include <limits>

#include "core/document.h"
#include "identification/formats/csv_table.h"
#include "identification/formats/modal_file.h"
#include "identification/held_freedoms.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/support_matrices.h"
#include "models/identification_sections.h"

namespace wishbone {
namespace {

using namespace identification_sections;

/// A virtual test: the lowest modes of the model on the support (all by default), rigid-body modes of a free one left
/// out.
ModalData model_test(const AnalyticalModel& model, const Support& support, std::optional<int> count) {
  ModalData data;
  data.node_ids = model.node_ids;
  data.node_position = model.node_position;
  data.node_mass = model.node_mass;
  data.freedoms = model.freedoms();
  data.lines = model.lines;
  data.support = support;
  const int rigid = support.springs.empty() && support.joints.empty() ? 6 : 0;
  std::optional<Eigen::Index> wanted;
  if (count) wanted = *count + rigid;
  Modes modes = model_modes(model.K, model.M, support_matrices(support, data.freedoms), wanted);
  modes = {modes.lambda.tail(modes.count() - rigid), modes.shapes.rightCols(modes.count() - rigid)};
  constexpr double kRounding = 1e-12;  // of the largest eigenvalue
  if (!(modes.lambda[0] > kRounding * modes.lambda[modes.count() - 1]))
    throw InputError({"", "the support leaves rigid-body motion of the model free",
                      fmt::format("lowest eigenvalue {:.3g} rad2/s2", modes.lambda[0]),
                      "hold all six motions"});
  data.omega = modes.lambda.cwiseSqrt();
  data.shapes = modes.shapes;
  data.damping_ratio = VectorX::Zero(modes.count());
  data.modal_mass = VectorX::Ones(modes.count());
  data.provenance = {fmt::format("modes of a finite-element model of {} freedoms", model.M.rows())};
  return data;
}

/// Puts the masses of a table with the columns node and mass on the nodes of the data; others have none.
void read_node_masses(const std::filesystem::path& path, ModalData& data) {
  CsvTable table(path);
  const std::size_t node = table.column("node"), mass = table.column("mass");
  const double factor = table.si_factor(mass, kMass);
  data.node_mass = VectorX::Zero(data.node_count());
  while (table.next_row()) {
    const double value = factor * table.number(mass);
    if (!(value >= 0)) table.reject(mass, "a mass must not be negative", "give the lumped mass of the node");
    data.node_mass[data.node_index(table.integer(node))] = value;
  }
}

/// One section on its way into a task.
class Reader {
 public:
  Reader(const Value& section, const AnalyticalModel* own_model)
      : keys_(section, {"measured", "support", "mass", "find", "new_support", "change", "model", "expansion",
                        "space", "keep", "noise", "reference"}) {
    if (own_model) task_.model = *own_model;
  }

  LoadedIdentification read() && {
    if (const auto model = keys_.optional("model")) task_.model = read_model(*model, files_);
    if (const auto support = keys_.optional("support")) support_ = read_support(*support);
    task_.measured = read_modes(keys_.required("measured"), support_);
    read_choices();
    if (const auto mass = keys_.optional("mass")) read_mass(*mass);
    read_goal();
    if (const auto noise = keys_.optional("noise")) task_.noise = read_noise(*noise);
    if (const auto reference = keys_.optional("reference")) {
      task_.reference = read_modes(*reference, std::nullopt);
      task_.reference_name = Mapping(*reference, {"file", "from", "modes"}).has("file")
                                 ? Mapping(*reference, {"file", "from", "modes"}).required("file").text()
                                 : "model";
    }
    drop_unused_model();
    return {std::move(task_), files_.read()};
  }

 private:
  /// {file: NAME, modes: CHOICE} or {from: model, modes: CHOICE}; a support that is given replaces that of the file.
  ModalData read_modes(const Value& value, const std::optional<Support>& support) {
    const Mapping keys(value, {"file", "from", "modes"});
    if (keys.has("file") == keys.has("from"))
      keys.refuse("modes come either from a file or from the model", "write 'file: NAME' or 'from: model'");
    ModalData data;
    if (const auto file = keys.optional("file")) {
      const auto path = files_.note(*file);
      data = located(file->where(), [&] { return read_modal_data(path); });
      if (support) data.support = *support;
    } else {
      const Value from = keys.required("from");
      if (!from.is_word("model"))
        from.refuse("modes can be computed from the model only", "write 'from: model'");
      if (!task_.model) from.refuse("there is no model to take modes from", "add the section 'model'");
      data = located(from.where(), [&] {
        return model_test(*task_.model, support.value_or(Support{}), lowest_wanted(keys.optional("modes")));
      });
    }
    within(value.where(), [&] {
      data.validate();
      data = with_held_freedoms(data);
      return 0;
    });
    const auto choice = keys.optional("modes");
    return choice ? choose_modes(*choice, data) : data;
  }

  /// The number when the choice of modes is one, so that no others need be computed.
  std::optional<int> lowest_wanted(const std::optional<Value>& choice) const {
    if (!choice || choice->is_list() || choice->is_mapping() || choice->is_word("all")) return std::nullopt;
    return choice->integer(1, static_cast<int>(task_.model->M.rows()));
  }

  void read_mass(const Value& value) {
    const Mapping keys(value, {"file", "matrix", "total", "centre", "inertia"});
    const bool is_distributed = keys.has("total") || keys.has("centre") || keys.has("inertia");
    if (keys.has("file") + keys.has("matrix") + is_distributed > 1)
      keys.refuse("the masses are given in more than one way",
                  "write 'file', or 'matrix', or 'total', 'centre' and 'inertia'");
    if (task_.coverage == Coverage::kGuyan || (takes_model_freedoms() && !is_distributed))
      keys.refuse("with this expansion the masses are those of the model",
                  "remove 'mass', and give the masses with the model");
    if (const auto file = keys.optional("file")) {
      const auto path = files_.note(*file);
      located(file->where(), [&] {
        read_node_masses(path, task_.measured);
        return 0;
      });
    } else if (const auto matrix = keys.optional("matrix")) {
      task_.mass = read_structure_matrix(*matrix, files_);
      task_.measured.node_mass.resize(0);
    } else {
      task_.rigid_body = read_rigid_body(value);
    }
  }

  void read_choices() {
    if (const auto space = keys_.optional("space"))
      task_.space =
          space->choice<Space>({{"modal", Space::kModal}, {"physical", Space::kPhysical}}, "the spaces");
    if (const auto keep = keys_.optional("keep"))
      task_.keep = keep->integer(1, std::numeric_limits<int>::max());
    if (const auto expansion = keys_.optional("expansion")) {
      task_.coverage = expansion->choice<Coverage>({{"none", Coverage::kAsMeasured},
                                                    {"serep", Coverage::kSerep},
                                                    {"static", Coverage::kStatic},
                                                    {"guyan", Coverage::kGuyan}},
                                                   "the kinds of expansion");
      if (task_.coverage != Coverage::kAsMeasured && !task_.model)
        expansion->refuse("an expansion needs a model", "add the section 'model'");
    }
  }

  void read_goal() {
    if (const auto find = keys_.optional("find"))
      task_.goal = find->choice<Goal>({{"free", Goal::kFree},
                                       {"held", Goal::kHeld},
                                       {"changed", Goal::kChanged},
                                       {"corrected", Goal::kCorrected}},
                                      "what can be found");
    const auto belongs = [&](const char* key, Goal goal, const char* word) {
      const auto value = keys_.optional(key);
      if (value && task_.goal != goal)
        value->refuse(fmt::format("'{}' belongs to 'find: {}'", key, word), "remove it, or find that");
      if (!value && task_.goal == goal) keys_.required(key);
      return value;
    };
    if (const auto support = belongs("new_support", Goal::kHeld, "held"))
      task_.support = read_support(*support);
    if (const auto change = belongs("change", Goal::kChanged, "changed"))
      task_.change = read_change(*change, structure(), files_);
    if (task_.goal == Goal::kCorrected && !task_.model)
      keys_.refuse("a correction needs a model", "add the section 'model'");
  }

  /// Shapes are expanded to the freedoms of the model.
  bool takes_model_freedoms() const {
    return task_.coverage == Coverage::kSerep || task_.coverage == Coverage::kStatic;
  }

  /// Nodes and freedoms that the identified modes will have.
  ModalData structure() const {
    ModalData data = task_.measured;
    if (!takes_model_freedoms()) return data;
    data.node_ids = task_.model->node_ids;
    data.node_position = task_.model->node_position;
    data.freedoms = task_.model->freedoms();
    return data;
  }

  /// A model that only served to compute modes need not be carried along.
  void drop_unused_model() {
    if (task_.coverage == Coverage::kAsMeasured && task_.goal != Goal::kCorrected) task_.model.reset();
  }

  Mapping keys_;
  Files files_;
  IdentificationTask task_;
  std::optional<Support> support_;
};

}  // namespace

LoadedIdentification read_identification(const Value& section, const AnalyticalModel* own_model) {
  return Reader(section, own_model).read();
}

LoadedIdentification load_identification(const std::filesystem::path& path,
                                         const std::vector<std::string>& overrides) {
  const YamlNodePtr document = load_document(path, overrides);
  const Mapping root(Value(document, document->where), {"wishbone", "title", "parameters", "identification"});
  root.required("wishbone").integer(1, 1);
  LoadedIdentification loaded = read_identification(root.required("identification"), nullptr);
  loaded.files.insert(loaded.files.begin(), path.string());
  if (const auto title = root.optional("title")) loaded.task.title = title->text();
  return loaded;
}

}  // namespace wishbone

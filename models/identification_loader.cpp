#include "models/identification_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/document.h"
#include "identification/formats/csv_table.h"
#include "identification/formats/modal_file.h"
#include "identification/free_model.h"
#include "identification/held_freedoms.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/support_matrices.h"
#include "models/identification_sections.h"

namespace wishbone {
namespace {

using namespace identification_sections;

/// Springs and joints must hold all rigid-body motions, for rounding alone gives the others a frequency.
void check_holds(const AnalyticalModel& model, const Support& support) {
  if (support.springs.empty() && support.joints.empty()) return;
  const std::vector<Freedom> freedoms = model.freedoms();
  const MatrixX rigid =
      rigid_body_basis(rigid_body_shapes(freedoms, model.node_ids, model.node_position), model.M);
  const int held = held_motions(support_matrices(support, freedoms), rigid);
  if (held < rigid.cols())
    throw InputError({"", "the support leaves rigid-body motion of the model free",
                      fmt::format("{} of {} motions are held", held, rigid.cols()),
                      "hold all of them, or name no support"});
}

/// What rounding gives the rigid-body modes must be no frequency among the elastic ones.
void check_rigid_modes(const VectorX& lambda, int rigid) {
  constexpr double kGap = 1e-4;  // a hundredth of the frequency
  const double largest = lambda.head(rigid).cwiseAbs().maxCoeff();
  if (lambda.size() > rigid && !(largest <= kGap * lambda[rigid]))
    throw InputError(
        {"", "the six rigid-body modes of the model are not told from its elastic ones",
         fmt::format("eigenvalues up to {:.3g}, then {:.3g} rad2/s2", largest, lambda[rigid]),
         "write the stiffness with more digits; look for soft springs to the ground, loose parts or hinges"});
}

void check_stiffness(const Modes& modes) {
  if (!(modes.lambda[0] > 0))
    throw InputError({"", "the model has a mode without stiffness",
                      fmt::format("lowest eigenvalue {:.3g} rad2/s2", modes.lambda[0]),
                      "check the stiffness of the model: only rigid-body motion is without"});
}

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
  if (rigid > 0) check_rigid_modes(modes.lambda, rigid);
  modes = {modes.lambda.tail(modes.count() - rigid), modes.shapes.rightCols(modes.count() - rigid)};
  check_stiffness(modes);
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
    const int id = table.integer(node);
    const auto found = std::find(data.node_ids.begin(), data.node_ids.end(), id);
    if (found == data.node_ids.end())
      table.reject(node, "the structure has no such node", nodes_text(data.node_ids));
    data.node_mass[found - data.node_ids.begin()] = value;
  }
}

/// The file of a document and those that it includes.
void list_files(const YamlNode& node, std::set<std::string>& files) {
  if (node.where.file) files.insert(*node.where.file);
  for (const YamlNodePtr& item : node.items) list_files(*item, files);
  for (const YamlNode::Entry& entry : node.entries) list_files(*entry.value, files);
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
    if (const auto model = keys_.optional("model")) task_.model = read_free_model(*model);
    support_ = keys_.optional("support");
    task_.measured = read_modes(keys_.required("measured"), support_);
    read_choices();
    if (const auto mass = keys_.optional("mass")) read_mass(*mass);
    if (!keys_.has("mass")) take_mass_of_model();
    read_goal();
    if (const auto noise = keys_.optional("noise")) task_.noise = read_noise(*noise);
    if (const auto reference = keys_.optional("reference")) {
      task_.reference = read_modes(*reference, std::nullopt);
      const YamlNode::Entry* file = reference->node()->find("file");
      task_.reference_name = file ? file->value->text : "model";
    }
    drop_unused_model();
    return {std::move(task_), files_.read(), keys_.where()};
  }

 private:
  AnalyticalModel read_free_model(const Value& value) {
    AnalyticalModel model = read_model(value, files_);
    within(value.where(), [&] {
      check_is_free(model);
      return 0;
    });
    return model;
  }

  /// {file: NAME, modes: CHOICE} or {from: model, modes: CHOICE}; a support that is given replaces that of the file.
  ModalData read_modes(const Value& value, const std::optional<Value>& support) {
    const Mapping keys(value, {"file", "from", "modes"});
    if (keys.has("file") == keys.has("from"))
      keys.refuse("modes come either from a file or from the model", "write 'file: NAME' or 'from: model'");
    const auto choice = keys.optional("modes");
    ModalData data = keys.has("file") ? read_file(keys.required("file"), support)
                                      : read_model_test(keys.required("from"), support, choice);
    within(value.where(), [&] {
      data.validate();
      data = with_held_freedoms(data);
      return 0;
    });
    return choice ? choose_modes(*choice, data) : data;
  }

  ModalData read_file(const Value& name, const std::optional<Value>& support) {
    const auto path = files_.note_modal_data(name);
    ModalData data = located(name.where(), [&] { return read_modal_data(path); });
    if (support) {
      data.support = read_support(*support);
      check_nodes(*support, data.node_ids);
    }
    return data;
  }

  /// The number when the choice of modes is one, so that no others need be computed.
  std::optional<int> lowest_wanted(const std::optional<Value>& choice) const {
    if (!choice || choice->is_list() || choice->is_mapping() || choice->is_word("all")) return std::nullopt;
    return choice->integer(1, static_cast<int>(task_.model->M.rows()));
  }

  ModalData read_model_test(const Value& from, const std::optional<Value>& support,
                            const std::optional<Value>& choice) {
    if (!from.is_word("model"))
      from.refuse("modes can be computed from the model only", "write 'from: model'");
    if (!task_.model) from.refuse("there is no model to take modes from", "add the section 'model'");
    Support held;
    if (support) {
      held = read_support(*support);
      check_nodes(*support, task_.model->node_ids);
      located(support->where(), [&] {
        check_holds(*task_.model, held);
        return 0;
      });
    }
    return within(from.where(), [&] { return model_test(*task_.model, held, lowest_wanted(choice)); });
  }

  /// A table of nodal masses, a mass matrix, or mass, centre and inertia of the body.
  void read_mass(const Value& value) {
    const Mapping keys(value, {"file", "matrix", "total", "centre", "inertia"});
    const bool is_body = keys.has("total") || keys.has("centre") || keys.has("inertia");
    if (keys.has("file") + keys.has("matrix") + is_body != 1)
      keys.refuse("masses come from a table, a matrix or the mass data of the body",
                  "write one of 'file: NAME', 'matrix: NAME' and 'total, centre, inertia'");
    if (const auto file = keys.optional("file")) {
      if (task_.coverage != Coverage::kAsMeasured)
        file->refuse("the nodal masses are those of the model that the modes are expanded to",
                     "remove the table, or write the masses into the model");
      read_node_masses(files_.note(*file), task_.measured);
    } else if (const auto matrix = keys.optional("matrix")) {
      task_.mass = read_symmetric(*matrix, files_);
      task_.measured.node_mass.resize(0);
    } else {
      task_.rigid_body = read_rigid_body(value);
    }
  }

  /// The mass matrix of a model over the very freedoms of the modes, where nothing else tells their masses: consistent
  /// masses, as finite-element programs store them.
  void take_mass_of_model() {
    if (task_.measured.has_masses() || task_.coverage != Coverage::kAsMeasured || !task_.model) return;
    if (task_.model->M.rows() == 0 || task_.model->freedoms() != task_.measured.freedoms) return;
    task_.mass = task_.model->M;
    task_.measured.provenance.push_back("masses: the mass matrix of the model");
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
                                      "the goals");
    const auto belongs = [&](const char* key, Goal goal, const char* word) {
      const auto value = keys_.optional(key);
      if (value && task_.goal != goal)
        value->refuse(fmt::format("'{}' belongs to 'find: {}'", key, word), "remove it, or find that");
      if (!value && task_.goal == goal) keys_.required(key);
      return value;
    };
    const bool expanded = task_.coverage == Coverage::kSerep || task_.coverage == Coverage::kStatic;
    const std::vector<int>& ids = expanded ? task_.model->node_ids : task_.measured.node_ids;
    const Matrix3X& position = expanded ? task_.model->node_position : task_.measured.node_position;
    if (const auto support = belongs("new_support", Goal::kHeld, "held")) {
      task_.support = read_support(*support);
      check_nodes(*support, ids);
    }
    if (const auto change = belongs("change", Goal::kChanged, "changed")) {
      task_.change = read_change(*change, ids, position, files_);
      check_nodes(*change, ids);
    }
    if (task_.goal == Goal::kCorrected && !task_.model)
      keys_.refuse("a correction needs a model", "add the section 'model'");
  }

  /// A model that only served to compute modes need not be carried along.
  void drop_unused_model() {
    if (task_.coverage == Coverage::kAsMeasured && task_.goal != Goal::kCorrected) task_.model.reset();
  }

  Mapping keys_;
  Files files_;
  IdentificationTask task_;
  std::optional<Value> support_;
};

}  // namespace

LoadedIdentification read_identification(const Value& section, const AnalyticalModel* own_model) {
  return Reader(section, own_model).read();
}

LoadedIdentification load_identification(const std::filesystem::path& path,
                                         const std::vector<std::string>& overrides) {
  const YamlNodePtr document = load_document(path, overrides);
  const Mapping root(Value(document, document->where), {"wishbone", "title", "parameters", "identification"});
  const Value version = root.required("wishbone");
  if (version.integer(1, 1000) != 1)
    version.refuse("this format version is not known", "write 'wishbone: 1', or use a newer wishbone");
  LoadedIdentification loaded = read_identification(root.required("identification"), nullptr);
  std::set<std::string> documents{path.string()};
  list_files(*document, documents);
  loaded.files.insert(loaded.files.begin(), documents.begin(), documents.end());
  if (const auto title = root.optional("title")) loaded.task.title = title->text();
  return loaded;
}

}  // namespace wishbone

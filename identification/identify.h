#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/elements/mesh.h"
#include "identification/judgement/judgement.h"
#include "identification/judgement/monte_carlo.h"
#include "identification/methods/design_change.h"
#include "identification/methods/mass_distribution.h"
#include "identification/methods/model_correction.h"
#include "identification/modal_data.h"

namespace wishbone {

/// What is looked for. A measured structure that is on a support is released from it first, whatever the goal.
enum class Goal {
  kFree,      ///< free-free elastic modes [4]
  kHeld,      ///< modes on another support [3]
  kChanged,   ///< free-free modes after a design change [2.3]
  kCorrected  ///< a model corrected by the measured modes, and its free-free modes
};

/// Changes of mass and stiffness on existing freedoms.
struct StructureChange {
  /// Spring between two nodes along u: force k (u . (delta_b - delta_a)) u on a, the opposite on b.
  struct Spring {
    std::array<int, 2> nodes{};  ///< a, b
    Vector3 direction =
        Vector3::Zero();   ///< u, unit vector; along a b unless the spring only couples one direction
    double stiffness = 0;  ///< k, of any sign [N/m]
  };
  std::vector<Support::Mass> masses;  ///< of any sign [kg]
  std::vector<Spring> springs;
  std::optional<SparseMatrix> dM, dK;  ///< further changes over the freedoms of the modes

  bool empty() const { return masses.empty() && springs.empty() && !dM && !dK; }
};

/// Elements of one material.
struct MeshedBody {
  Mesh mesh;
  IsotropicMaterial material;
};

/// A finite-element model of the structure, three freedoms a node, free.
struct AnalyticalModel {
  std::vector<int> node_ids;
  Matrix3X node_position;                                ///< 3 x n [m]
  VectorX node_mass;                                     ///< n [kg]; empty when M is not lumped
  SparseMatrix M, K;                                     ///< 3n x 3n [kg], [N/m]
  std::vector<std::array<int, 2>> lines;                 ///< to draw it by
  std::shared_ptr<const MeshedBody> elements = nullptr;  ///< null: the matrices are all that is known

  std::vector<Freedom> freedoms() const { return all_freedoms(node_ids); }
};

/// How a measurement that shows fewer freedoms than there are is made to fit.
enum class Coverage {
  kAsMeasured,  ///< it is taken as the whole structure
  kSerep,       ///< shapes expanded to the model by its modes
  kStatic,      ///< shapes expanded to the model statically
  kGuyan        ///< the model's mass reduced to the measured freedoms
};

/// Everything that an identification is made from.
struct IdentificationTask {
  std::string title;
  Goal goal = Goal::kFree;
  ModalData measured;  ///< with the support that it was measured on

  std::optional<SparseMatrix> mass;  ///< over the freedoms measured (of the model, when expanded) instead of
                                     ///< lumped masses
  std::optional<RigidBodyData> rigid_body;  ///< nodal masses are found from these [6.4-6.10]
  std::optional<AnalyticalModel> model;
  Coverage coverage = Coverage::kAsMeasured;

  Support support;         ///< kHeld: the new one
  StructureChange change;  ///< kChanged
  Space space = Space::kModal;
  std::optional<int> keep;  ///< lowest identified modes; all by default

  std::optional<MeasurementNoise> noise;
  std::optional<ModalData> reference;  ///< known modes to compare with
  std::string reference_name;
};

/// Modes that were looked for, the modes that they were found from, and how good they are.
struct Identification {
  std::string title;
  ModalData input;  ///< as used: chosen modes, real, expanded or reduced
  ModalData modes;  ///< the identified ones, of unit modal mass
  Judgement judgement;
  SparseMatrix M;                           ///< mass over the freedoms of the modes
  std::optional<CorrectedModel> corrected;  ///< kCorrected
};

/// Mass and stiffness matrix that an identification comes to: the corrected model, else M and the stiffness K* that the
/// modes stand for [2.11, 2.12]. Dense.
CorrectedModel identified_matrices(const Identification& identification);

/// Carries out the task.
/// @throws InputError when the data cannot give what is looked for: with what is missing
Identification identify(const IdentificationTask& task);

}  // namespace wishbone

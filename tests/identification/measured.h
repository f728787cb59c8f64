#pragma once

#include "identification/identify.h"
#include "identification/structures.h"

namespace wishbone {

/// A faultless modal test of a structure on a support: its lowest modes (all by default), rigid motion that nothing
/// resists left out.
ModalData measured_on(const TestStructure& structure, const Support& support, Eigen::Index lowest = -1);

/// The structure as a model.
AnalyticalModel model_of(const TestStructure& structure);

/// The data as a test at some of the nodes would show them.
ModalData seen_at(const std::vector<int>& nodes, const ModalData& data);

/// Frequencies [Hz] of K x = lambda M x by a dense solver, rows and columns of `held` freedoms deleted; six zeros of
/// rigid motion left out when nothing holds it (`is_free`).
VectorX true_frequencies(const MatrixX& K, const MatrixX& M, bool is_free, const std::vector<int>& held = {});

/// How far the columns of B are from the space of the columns of A: largest norm of what is left of an M-orthonormal
/// basis of B. Modes of equal frequency may be any of their plane; this does not care which.
double plane_distance(const MatrixX& A, const MatrixX& B, const SparseMatrix& M);

/// Springs of 47 kN/m in x, y and z at the bottom corners of the chassis.
Support chassis_springs();
/// The same with 3 kg and 1 kg of fixtures.
Support chassis_springs_with_masses();
/// Two sensors, and nothing that resists.
Support chassis_sensors();
/// Three springs along z and a sensor: no motion in the plane is resisted.
Support chassis_bounce_springs();
/// One corner on a joint, the others on springs, and a sensor of 0.4 kg.
Support chassis_joint_and_springs();

/// The free-free modes are looked for in the test of a structure on a support.
IdentificationTask task_on(const TestStructure& structure, const Support& support, Eigen::Index lowest = -1);
VectorX frequencies(const Identification& found);
VectorX free_frequencies(const TestStructure& structure);

}  // namespace wishbone

#pragma once

#include <cmath>

#include "identification/elements/element_edges.h"
#include "identification/free_free_modes.h"
#include "identification/identify.h"

namespace wishbone {

/// The lowest modes of a free block of the source's hexahedra, with its edges as lines.
inline ModalData block_modes(const Vector3& size, const Eigen::Vector3i& divisions, int count) {
  const Mesh mesh = make_block(size, divisions, ElementType::mean_dilatation);
  const ModeSet set = free_free_modes(mesh, {210e6, 0.3, 2600}).lowest(count);
  ModalData data;
  data.title = "block";
  data.node_ids = set.node_ids;
  data.node_position = set.node_position;
  data.node_mass = set.node_mass;
  data.freedoms = all_freedoms(set.node_ids);
  data.omega = set.omega;
  data.damping_ratio = VectorX::LinSpaced(count, 0.012, 0.005);
  data.modal_mass = VectorX::Ones(count);
  data.shapes = set.shapes;
  data.lines = element_edges(mesh);
  data.provenance = {"block of hexahedra", "free-free modes"};
  return data;
}

inline ModalData chassis_modes(int count) {
  return block_modes({2.4, 0.4, 0.4}, {4, 1, 1}, count);
}

/// The data as sensors along one axis would give them.
inline ModalData measured_along(const ModalData& data, int axis) {
  ModalData measured = data;
  std::vector<Eigen::Index> rows;
  measured.freedoms.clear();
  for (int r = 0; r < data.freedom_count(); ++r)
    if (data.freedoms[r].axis == axis) {
      rows.push_back(r);
      measured.freedoms.push_back(data.freedoms[r]);
    }
  measured.shapes = data.shapes(rows, Eigen::all);
  return measured;
}

/// Modal assurance criterion |a.b|^2 / (a.a)(b.b) of all columns.
inline MatrixX plain_mac(const MatrixX& a, const MatrixX& b) {
  return (a.colwise().normalized().transpose() * b.colwise().normalized()).cwiseAbs2();
}

/// An identification of the chassis that is a little wrong, growing with the mode, held on four springs.
inline Identification chassis_identification(int count) {
  Identification made;
  made.title = "Chassis <A> & \"B\"";
  made.input = chassis_modes(count);
  for (const int node : {1, 2, 17, 18}) made.input.support.springs.push_back({node, Vector3::UnitZ(), 2e4});
  made.modes = chassis_modes(count);
  const MatrixX noise =
      0.02 * MatrixX::NullaryExpr(made.modes.shapes.rows(), count, [](auto i, auto j) {
        return (j + 1) * std::sin(12.9898 * static_cast<double>(i + 1) + 78.233 * static_cast<double>(j + 1));
      });
  const MatrixX exact = made.modes.shapes;
  made.modes.shapes += noise * exact.cwiseAbs().maxCoeff() / 4;

  Judgement& judged = made.judgement;
  const VectorX hz = made.modes.omega / (2 * 3.14159265358979323846);
  const VectorX error = VectorX::NullaryExpr(count, [](auto i) { return 1e-3 * static_cast<double>(i + 1); });
  judged.input_hz = hz;
  judged.frequency_hz = hz.array() * (1 + error.array());
  judged.residual = VectorX::Constant(count, 0.0123);
  judged.residual[count - 1] = NAN;
  judged.frequency_std_hz = 0.002 * hz;
  judged.auto_mac = plain_mac(made.modes.shapes, made.modes.shapes);
  judged.input_mac = plain_mac(made.modes.shapes, exact);
  judged.condition_numbers = {{"Psi", 12.3}, {"Psi^T M Psi", 1.02}};
  judged.reference =
      ReferenceComparison{"finite elements", hz, plain_mac(made.modes.shapes, exact), {}, error};
  for (int i = 0; i < count; ++i) judged.reference->partner.push_back(i);
  judged.notes = {"scaled the modes to unit modal mass"};
  judged.warnings = {"mode 2 & 3 are close"};
  return made;
}

}  // namespace wishbone

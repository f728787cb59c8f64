#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "identification/methods/modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// What modal data say of the body as a whole: enough to see by eye whether units were understood.
struct BodyExtent {
  Vector3 size = Vector3::Zero();     ///< of the box around the nodes, along the axes [m]
  double mass = 0;                    ///< of the nodes [kg]; 0: not known
  Vector3 centre = Vector3::Zero();   ///< of mass, in the coordinates of the nodes [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about the centre, sum of m_i (|r|^2 1 - r r^T) [kg m2]
};
BodyExtent body_extent(const ModalData& data);
/// The same with the mass, centre and inertia of a mass matrix over all freedoms: of rigid motion, G^T M G.
BodyExtent body_extent(const ModalData& data, const SparseMatrix& M);

/// "size 2.4 x 0.4 x 0.4 m; mass 1000 kg, mass centre (0, 0, 0) m, inertia about it ...".
std::string describe(const BodyExtent& extent);

/// Why lengths or masses are probably not in m and kg, in words; nothing where they may be. Tests that know of no
/// material:
/// * mass over volume of the box is 1 to 30 000 kg/m3 (from a light truss to tungsten), thin directions of the box counted
///   as 1 % of the longest against the one bound and as 20 % against the other. Millimetres read as metres are wrong by
///   10^9;
/// * no structure has all of its frequencies above c / 2L, the first longitudinal one of a bar of its length: twice the
///   lowest frequency times the length is below 20 km/s (c is 5 km/s in steel, 12 km/s in beryllium).
/// A structure of unknown mass that is longer than 1 km is doubted too.
/// `lowest_omega`: of the modes [rad/s].
std::optional<Diagnostic> doubt_of_units(const BodyExtent& extent, double lowest_omega);

}  // namespace wishbone

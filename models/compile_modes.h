#pragma once

#include <string>
#include <vector>

#include "bodies/interface_frame.h"
#include "bodies/mode_set.h"
#include "core/error.h"
#include "identification/identify.h"
#include "identification/mode_table.h"
#include "models/scene.h"

namespace wishbone {

/// What was identified for a flexible body.
struct IdentifiedBody {
  std::string body;
  Identification identification;
};

/// What the deformation of a flexible body is made of.
struct BodyModes {
  std::string body;
  std::string choice;  ///< in words
  std::vector<ModeRow> modes;
  Warnings warnings = {};
};

/// Modes with the damping and the geometric stiffening (ShapeSet::stiffening; empty: none) that the scene asks for.
struct StiffenedModes {
  ModeSet set;
  MatrixX stiffening;
};

/// What should be doubted of modes that were identified or chosen.
Warnings warnings_of(const std::vector<IdentifiedBody>& identified, const std::vector<BodyModes>& chosen);

InterfaceFrame interface_frame(const Scene::Frame& frame);
/// Those of a body whose nodes keep their distances.
std::vector<InterfaceFrame> rigid_frames(const Scene::Flexible& flexible);

/// Modes of the flexible bodies of a scene.
class ModeCompiler {
 public:
  explicit ModeCompiler(const Scene& scene) : scene_(scene) {}

  /// Modes of a body (index into `Scene::bodies`), its rigid frames left out. The table has them as the frames change
  /// them.
  /// @throws InputError naming the place in the scene file
  StiffenedModes modes_of(int body);

  std::vector<IdentifiedBody> identified;  ///< so far
  std::vector<BodyModes> tables;           ///< so far

 private:
  const Scene& scene_;
};

}  // namespace wishbone

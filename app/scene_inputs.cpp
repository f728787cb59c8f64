#include "app/scene_inputs.h"

#include <set>

namespace wishbone {

std::vector<std::string> input_files(const std::string& path, const Scene& scene) {
  std::set<std::string> files{path};
  const auto note = [&](const Source& where) {
    if (where.file) files.insert(*where.file);
  };
  const auto note_all = [&](const auto&... lists) {
    const auto note_list = [&](const auto& list) {
      for (const auto& item : list) note(item.where);
    };
    (note_list(lists), ...);
  };
  note_all(scene.bodies, scene.joints, scene.closures, scene.springs, scene.signals, scene.loads,
           scene.drives, scene.tire_models, scene.tires, scene.motions);
  if (scene.road) note(scene.road->where);
  if (scene.vehicle) note(scene.vehicle->where);
  note(scene.analysis.where);
  note(scene.output.where);
  files.insert(scene.data_files.begin(), scene.data_files.end());
  return {files.begin(), files.end()};
}

}  // namespace wishbone

#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {

/// A scene that has been run, and its results.
class RanScene {
 public:
  explicit RanScene(const std::string& text) : RanScene(load(text)) {}
  explicit RanScene(Scene scene) : scene_(std::move(scene)), result_(run(scene_, files_ / "out.h5")) {
    EXPECT_EQ(result_.summary.status, TransientSummary::Status::complete) << result_.summary.message;
    file_ = std::make_unique<ResultFile>(files_ / "out.h5");
  }
  const ResultFile& file() const { return *file_; }
  MatrixX read(const std::string& path) const { return file_->read(path); }
  const Warnings& warnings() const { return result_.warnings; }
  const WorkCounters& work() const { return result_.work; }
  double meta(const std::string& name) const { return std::get<double>(file_->meta().at(name)); }

 private:
  static Scene load(const std::string& text) {
    const TextFiles files;
    return load_scene(files.write("scene.yaml", text));
  }
  static RunResult run(const Scene& scene, const std::string& output) {
    return run_scene(scene, compile(scene), {"scene.yaml", output, {}, {}});
  }
  TextFiles files_;
  Scene scene_;
  RunResult result_;
  std::unique_ptr<ResultFile> file_;
};

}  // namespace wishbone

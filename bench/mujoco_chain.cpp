#include <fmt/core.h>
#include <mujoco/mujoco.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "bench/chain.h"

namespace wishbone::bench {
namespace {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, ModelDeleter>;

/// Bodies within one another, without anything that collides.
std::string chain_xml(int rods) {
  std::string open, close;
  for (int i = 0; i < rods; ++i) {
    open += fmt::format(
        "<body pos='0 0 {}'><inertial pos='0 0 {}' mass='{}' diaginertia='{} {} {}'/><joint axis='{}'/>\n",
        i == 0 ? 0.0 : -ChainRod::kLength, -ChainRod::kLength / 2, ChainRod::kMass, ChainRod::kAcross,
        ChainRod::kAcross, ChainRod::kAlong, ChainRod::turns_about_y(i) ? "0 1 0" : "1 0 0");
    close += "</body>";
  }
  return fmt::format(
      "<mujoco><compiler angle='radian'/><option gravity='0 0 {}'><flag contact='disable' constraint='disable'/>"
      "</option><worldbody>{}{}</worldbody></mujoco>",
      -ChainRod::kGravity, open, close);
}

/// Nothing when MuJoCo refuses: its reader of version 2.2.2 does not go down to a hundred bodies within one another.
Model load(int rods) {
  const auto path = std::filesystem::temp_directory_path() / "wishbone_chain.xml";
  std::ofstream(path) << chain_xml(rods);
  char message[1000] = "";
  Model model(mj_loadXML(path.c_str(), nullptr, message, sizeof message));
  std::filesystem::remove(path);
  return model;
}

class MujocoChain final : public Chain {
 public:
  explicit MujocoChain(Model model) : model_(std::move(model)), data_(mj_makeData(model_.get())) {
    for (int i = 0; i < model_->nv; ++i) {
      data_->qpos[i] = ChainRod::angle(i);
      data_->qvel[i] = ChainRod::speed(i);
    }
  }
  void evaluate() override { mj_forwardSkip(model_.get(), data_.get(), mjSTAGE_NONE, 1); }
  std::vector<double> accelerations() const override { return {data_->qacc, data_->qacc + model_->nv}; }

 private:
  Model model_;
  std::unique_ptr<mjData, DataDeleter> data_;
};

}  // namespace

std::unique_ptr<Chain> make_mujoco_chain(int rods) {
  constexpr int kDeepest = 1000;  // beyond which its reader may exhaust the stack
  Model model = rods <= kDeepest ? load(rods) : nullptr;
  return model ? std::make_unique<MujocoChain>(std::move(model)) : nullptr;
}

}  // namespace wishbone::bench

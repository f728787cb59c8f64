#include <fmt/core.h>
#include <mujoco/mujoco.h>

#include <algorithm>
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

/// Elements that its XML reader goes down to in one file, some less than the hundred that it allows.
constexpr int kDepth = 80;

std::filesystem::path part(int number) {
  return std::filesystem::temp_directory_path() / fmt::format("wishbone_chain_{}.xml", number);
}

/// Bodies within one another, from rod `first` on; what lies deeper is included from a file of its own.
std::string bodies_xml(int first, int rods) {
  const int end = std::min(rods, first + kDepth);
  std::string open, close;
  for (int i = first; i < end; ++i) {
    open += fmt::format(
        "<body pos='0 0 {}'><inertial pos='0 0 {}' mass='{}' diaginertia='{} {} {}'/><joint axis='{}'/>\n",
        i == 0 ? 0.0 : -ChainRod::kLength, -ChainRod::kLength / 2, ChainRod::kMass, ChainRod::kAcross,
        ChainRod::kAcross, ChainRod::kAlong, ChainRod::turns_about_y(i) ? "0 1 0" : "1 0 0");
    close += "</body>";
  }
  if (end < rods) open += fmt::format("<include file='{}'/>", part(end).filename().string());
  return open + close;
}

/// Nothing when MuJoCo refuses.
Model load(int rods) {
  for (int first = kDepth; first < rods; first += kDepth)
    std::ofstream(part(first)) << "<mujocoinclude>" << bodies_xml(first, rods) << "</mujocoinclude>";
  std::ofstream(part(0)) << fmt::format(
      "<mujoco><compiler angle='radian'/><option gravity='0 0 {}'>"
      "<flag contact='disable' constraint='disable'/></option><worldbody>{}</worldbody></mujoco>",
      -ChainRod::kGravity, bodies_xml(0, rods));
  char message[1000] = "";
  Model model(mj_loadXML(part(0).c_str(), nullptr, message, sizeof message));
  for (int first = 0; first < rods; first += kDepth) std::filesystem::remove(part(first));
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
  constexpr int kDeepest = 1000;  // joint-space matrices grow with the square of the number of rods
  Model model = rods <= kDeepest ? load(rods) : nullptr;
  return model ? std::make_unique<MujocoChain>(std::move(model)) : nullptr;
}

}  // namespace wishbone::bench

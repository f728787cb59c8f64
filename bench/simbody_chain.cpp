#include <Simbody.h>

#include "bench/chain.h"

namespace wishbone::bench {
namespace {

using SimTK::Vec3;

class SimbodyChain final : public Chain {
 public:
  explicit SimbodyChain(int rods) : matter_(system_), forces_(system_) {
    SimTK::Force::Gravity(forces_, matter_, Vec3(0, 0, -ChainRod::kGravity));
    const Vec3 middle(0, 0, -ChainRod::kLength / 2);
    const SimTK::Inertia central(ChainRod::kAcross, ChainRod::kAcross, ChainRod::kAlong);
    const SimTK::Body::Rigid rod(SimTK::MassProperties(
        ChainRod::kMass, middle, central.shiftFromMassCenter(-middle, ChainRod::kMass)));
    SimTK::MobilizedBody parent = matter_.Ground();
    for (int i = 0; i < rods; ++i) {
      // a pin turns about the z axis of its frames
      const SimTK::UnitVec3 axis(ChainRod::turns_about_y(i) ? Vec3(0, 1, 0) : Vec3(1, 0, 0));
      const SimTK::Rotation R(axis, SimTK::ZAxis);
      const Vec3 end(0, 0, i == 0 ? 0.0 : -ChainRod::kLength);
      parent = SimTK::MobilizedBody::Pin(parent, SimTK::Transform(R, end), rod, SimTK::Transform(R));
    }
    state_ = system_.realizeTopology();
    for (int i = 0; i < rods; ++i) {
      state_.updQ()[i] = ChainRod::angle(i);
      state_.updU()[i] = ChainRod::speed(i);
    }
  }

  void evaluate() override {
    state_.updQ();  // makes positions and all that follows from them stale
    system_.realize(state_, SimTK::Stage::Acceleration);
  }
  std::vector<double> accelerations() const override {
    const SimTK::Vector& a = state_.getUDot();
    std::vector<double> values;
    for (int i = 0; i < a.size(); ++i) values.push_back(a[i]);
    return values;
  }

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::State state_;
};

}  // namespace

std::unique_ptr<Chain> make_simbody_chain(int rods) {
  return std::make_unique<SimbodyChain>(rods);
}

}  // namespace wishbone::bench

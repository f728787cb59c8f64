// Error against CPU time of Andrews' squeezing mechanism with Debian's Simbody: the lines that go with those of
// mechanism_precision. A program of its own, since Simbody brings functions of an older SUNDIALS under the same names.

#include <Simbody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/andrews_reference.h"
#include "bench/least_time.h"
#include "bench/work_precision.h"

namespace wishbone::bench {
namespace {

using SimTK::Vec3;

/// Bodies have their frame at the inboard joint; closures hold points on the axis through E of FE, two rows each.
class Andrews {
 public:
  Andrews() : matter_(system_), forces_(system_) {
    const double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035,
                 sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04,
                 ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
    const Vec3 O(0), A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0);
    SimTK::MobilizedBody& ground = matter_.Ground();
    OF_ = pin(ground, O, 0.04325, 2.194e-6, {ra, 0, 0});
    FE_ = pin(OF_, {rr, 0, 0}, 0.00365, 4.410e-7, {-da, 0, 0});
    BDE_ = pin(ground, B, 0.02373, 5.255e-6, {sb, -sa, 0});
    AG_ = pin(ground, A, 0.07050, 1.169e-5, {ta, tb, 0});
    GE_ = pin(AG_, {zt, 0, 0}, 0.00706, 5.667e-7, {0, -(e - ea), 0});
    AH_ = pin(ground, A, 0.05498, 1.912e-5, {-ub, -ua, 0});
    HE_ = pin(AH_, {0, -u, 0}, 0.00706, 5.667e-7, {zf - fa, 0, 0});
    const Vec3 p_FE_E(-d, 0, 0);
    close(p_FE_E, BDE_, {0, -ss, 0});
    close(p_FE_E, GE_, {0, -e, 0});
    close(p_FE_E, HE_, {zf, 0, 0});
    SimTK::Force::TwoPointLinearSpring(forces_, ground, C, BDE_, {sd, -sc, 0}, 4530, 0.07785);
    SimTK::Force::ConstantTorque(forces_, OF_, {0, 0, 0.033});
    start_ = system_.realizeTopology();
    const auto joints = angles();
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i]->setOneQ(start_, 0, kAndrewsAngles[i].start);
  }

  template <class Integrator>
  Precision run(double accuracy) {
    Precision result{accuracy, 0, 0};
    try {
      result.cpu_seconds = least_cpu_seconds([&] {
        Integrator integrator(system_);
        integrator.setAccuracy(accuracy);
        integrator.initialize(start_);
        while (integrator.getTime() < kAndrewsDuration)
          integrator.stepTo(kAndrewsDuration);  // returns once at the start
        result.error = error(integrator.getState());
        return true;
      });
    } catch (const std::exception&) {
      result.error = std::numeric_limits<double>::infinity();
    }
    return result;
  }

 private:
  SimTK::MobilizedBody::Pin pin(SimTK::MobilizedBody& parent, const Vec3& at, double mass, double J_zz,
                                const Vec3& com) {
    const SimTK::Inertia central(J_zz, J_zz, J_zz);  // only the turn about z matters in the plane
    const SimTK::Body::Rigid body(SimTK::MassProperties(mass, com, central.shiftFromMassCenter(-com, mass)));
    return {parent, SimTK::Transform(at), body, SimTK::Transform()};
  }

  void close(const Vec3& p_FE_E, SimTK::MobilizedBody& follower, const Vec3& E) {
    SimTK::Constraint::PointOnLine(FE_, SimTK::UnitVec3(SimTK::ZAxis), p_FE_E, follower, E);
  }

  /// In the order of kAndrewsAngles.
  std::array<const SimTK::MobilizedBody::Pin*, 7> angles() const {
    return {&OF_, &FE_, &BDE_, &GE_, &AG_, &HE_, &AH_};
  }

  double error(const SimTK::State& state) const {
    double worst = 0;
    const auto joints = angles();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double reference = kAndrewsAngles[i].end;
      worst = std::max(worst, std::abs(joints[i]->getOneQ(state, 0) - reference) / std::abs(reference));
    }
    return worst;
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::MobilizedBody::Pin OF_, FE_, BDE_, AG_, GE_, AH_, HE_;
  SimTK::State start_;
};

template <class Integrator>
std::vector<Precision> line(Andrews& andrews) {
  std::vector<Precision> runs;
  for (int k = 4; k <= 18; ++k) runs.push_back(andrews.run<Integrator>(std::pow(10.0, -0.5 * k)));
  return runs;
}

}  // namespace
}  // namespace wishbone::bench

int main() {
  using namespace wishbone::bench;
  Andrews andrews;
  print_cost_heading();
  print_cost_row("Simbody, Runge-Kutta-Merson", line<SimTK::RungeKuttaMersonIntegrator>(andrews));
  print_cost_row("Simbody, Runge-Kutta-Fehlberg", line<SimTK::RungeKuttaFeldbergIntegrator>(andrews));
  return 0;
}

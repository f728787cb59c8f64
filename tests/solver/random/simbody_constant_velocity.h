#pragma once

#include <Simbody.h>

namespace wishbone::testing {

/// A homokinetic mobilizer, which Simbody lacks. The joint bends half way by Rx(a) Ry(b) and by the mirror image of that the
/// other half,
///     R_FM = Rx(a) Ry(b) Ry(b) Rx(a),
/// so that the rotation vector of R_FM stays in the plane of x and y. With u = (a', b'), as seen from F,
///     w_FM = a' (x + m) + 2 b' y1,   y1 = Rx(a) y,  m = R_FM x,
///     y1' = a' x cross y1,           m' = w_FM cross m.
class ConstantVelocityMobilizer : public SimTK::MobilizedBody::Custom::Implementation {
 public:
  explicit ConstantVelocityMobilizer(SimTK::SimbodyMatterSubsystem& matter)
      : Implementation(matter, 2, 2, 0) {}
  Implementation* clone() const override { return new ConstantVelocityMobilizer(*this); }

  SimTK::Transform calcMobilizerTransformFromQ(const SimTK::State&, int, const double* q) const override {
    return SimTK::Transform(rotation(q[0], q[1]));
  }
  SimTK::SpatialVec multiplyByHMatrix(const SimTK::State& state, int, const double* u) const override {
    const Arms arms(getQ(state));
    return {arms.first * u[0] + arms.second * u[1], Vec3(0)};
  }
  void multiplyByHTranspose(const SimTK::State& state, const SimTK::SpatialVec& F, int,
                            double* f) const override {
    const Arms arms(getQ(state));
    f[0] = ~arms.first * F[0];
    f[1] = ~arms.second * F[0];
  }
  SimTK::SpatialVec multiplyByHDotMatrix(const SimTK::State& state, int, const double* u) const override {
    const Arms rates = arm_rates(state);
    return {rates.first * u[0] + rates.second * u[1], Vec3(0)};
  }
  void multiplyByHDotTranspose(const SimTK::State& state, const SimTK::SpatialVec& F, int,
                               double* f) const override {
    const Arms rates = arm_rates(state);
    f[0] = ~rates.first * F[0];
    f[1] = ~rates.second * F[0];
  }

  /// The quaternion of Rx(a) Ry(2b) Rx(a) is (cos b cos a, cos b sin a, sin b, 0).
  void setQToFitTransform(const SimTK::State&, const SimTK::Transform& X_FM, int, double* q) const override {
    const SimTK::Quaternion Q = X_FM.R().convertRotationToQuaternion();
    q[0] = std::atan2(Q[1], Q[0]);
    q[1] = std::asin(Q[2]);
  }
  /// By least squares of w_FM = H u.
  void setUToFitVelocity(const SimTK::State& state, const SimTK::SpatialVec& V_FM, int,
                         double* u) const override {
    const Arms arms(getQ(state));
    const double aa = ~arms.first * arms.first, ab = ~arms.first * arms.second,
                 bb = ~arms.second * arms.second;
    const double a = ~arms.first * V_FM[0], b = ~arms.second * V_FM[0], det = aa * bb - ab * ab;
    u[0] = (a * bb - b * ab) / det;
    u[1] = (b * aa - a * ab) / det;
  }

 private:
  using Vec3 = SimTK::Vec3;

  static SimTK::Rotation about_x(double a) { return SimTK::Rotation(a, SimTK::XAxis); }
  static SimTK::Rotation rotation(double a, double b) {
    return about_x(a) * SimTK::Rotation(2 * b, SimTK::YAxis) * about_x(a);
  }

  /// The columns of H.
  struct Arms {
    Vec3 first, second;
    Arms() = default;
    explicit Arms(const SimTK::Vector& q)
        : first(Vec3(1, 0, 0) + rotation(q[0], q[1]) * Vec3(1, 0, 0)),
          second(2 * (about_x(q[0]) * Vec3(0, 1, 0))) {}
  };
  Arms arm_rates(const SimTK::State& state) const {
    const SimTK::Vector q = getQ(state), u = getU(state);
    const Arms arms(q);
    const Vec3 x(1, 0, 0), w_FM = arms.first * u[0] + arms.second * u[1];
    Arms rates;
    rates.first = w_FM % (arms.first - x);
    rates.second = u[0] * (x % arms.second);
    return rates;
  }
};

}  // namespace wishbone::testing

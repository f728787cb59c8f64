// The flexible slider crank of Simeon against quadruple precision. Sources: B. Simeon, "Modelling a flexible slider crank
// mechanism by a mixed system of DAEs and PDEs", Mathematical Modelling of Systems 2, 1996; F. Mazzia, C. Magherini, Test Set
// for Initial Value Problem Solvers, release 2.4, 2008, problem II-19, from which all data are. Reference values: two
// formulations integrated in quadruple precision (index 1 with extrapolation, minimal coordinates with Gauss collocation of
// order 16), which agree to 14 digits.
//
// A driven crank, a connecting rod with the lateral shapes sin(pi x), sin(2 pi x) and those of one quadratic finite element
// lengthwise, 4x(1 - x) and x(2x - 1), 0 <= x <= 1, and a sliding block.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::Built;
using testing::diagonal;
using testing::Trajectory;
using Matrix4 = Eigen::Matrix4d;
using Vector4 = Eigen::Vector4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

constexpr double kPi = std::numbers::pi;
constexpr double kM1 = 0.36, kM2 = 0.151104, kM3 = 0.075552, kL1 = 0.15, kL2 = 0.30, kJ1 = 0.002727;
constexpr double kJ2 = 0.0045339259;  // of the rod about its pin, the height h taken into account
constexpr double kE = 2e11, kB = 0.008, kH = 0.008, kRho = 7870, kOmega = 150;
constexpr double kFacM = kRho * kB * kH * kL2, kFacK = kE * kB * kH / kL2;

// ---- the problem's matrices, as printed

Matrix4 printed_mass() {
  Matrix4 M = Matrix4::Zero();
  M.diagonal() << 0.5, 0.5, 8, 2;
  M(2, 3) = M(3, 2) = 1;
  return kFacM * M;
}
Matrix4 printed_stiffness() {
  const double slenderness = (kH / kL2) * (kH / kL2), pi4 = std::pow(kPi, 4);
  Matrix4 K = Matrix4::Zero();
  K.diagonal() << pi4 / 24 * slenderness, 2 * pi4 / 3 * slenderness, 16.0 / 3, 7.0 / 3;
  K(2, 3) = K(3, 2) = -8.0 / 3;
  return kFacK * K;
}

// ---- the rod as mass points

struct Quadrature {
  VectorX x, weight;  // on [0, 1]
};

/// Both ends are points, as the joints need them; n points integrate polynomials of degree 2n - 3.
Quadrature gauss_lobatto(int n) {
  const unsigned degree = static_cast<unsigned>(n - 1);
  Quadrature rule{VectorX(n), VectorX(n)};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(kPi * i / degree);
    for (int iteration = 0; iteration < 20; ++iteration)  // towards a root of (1 - x^2) P'(x)
      x -= (x * std::legendre(degree, x) - std::legendre(degree - 1, x)) / (n * std::legendre(degree, x));
    const double P = std::legendre(degree, x);
    rule.x[i] = (1 + x) / 2;
    rule.weight[i] = 1 / (n * degree * P * P);
  }
  return rule;
}

/// Deflection at x for unit q1..q4.
Matrix34 shapes_at(double x) {
  Matrix34 phi = Matrix34::Zero();
  phi(1, 0) = std::sin(kPi * x);
  phi(1, 1) = std::sin(2 * kPi * x);
  phi(0, 2) = 4 * x * (1 - x);
  phi(0, 3) = x * (2 * x - 1);
  return phi;
}

struct Rod {
  ShapeSet set;
  Matrix4 L;  // M_q = L L^T: z = L^T q
  int pin = 1, tip = 0;

  Vector4 z_of(const Vector4& q) const { return L.transpose() * q; }
  Vector4 q_of(const Vector4& z) const { return L.transpose().triangularView<Eigen::Upper>().solve(z); }
};

/// The lengthwise block of the printed mass matrix, (8 1; 1 2), is 15 times what its shapes have, int N_i N_j dx = (8 1; 1 2)/15,
/// while the first moments c1, c12 and the products B with the lateral shapes are those of the shapes. Points can have that
/// too: four at each inner place, which deflect by the shapes plus and minus a surplus e. It cancels in all that is linear in the
/// lengthwise deflection, and adds sum m e e^T to the mass. They lie at both sides of the axis, for the inertia of the height.
Rod make_rod() {
  const Quadrature rule = gauss_lobatto(16);
  const int places = static_cast<int>(rule.x.size());
  const double inner_mass = kM2 * (1 - rule.weight[0] - rule.weight[places - 1]);
  const double y = std::sqrt((kJ2 - kM2 * kL2 * kL2 / 3) / inner_mass);
  Eigen::Matrix2d surplus;
  surplus << 8, 1, 1, 2;
  surplus = (surplus * (kFacM * 14.0 / 15)).llt().matrixL();  // any two places can bear it, a column each

  Rod rod;
  ShapeSet& set = rod.set;
  set.mean_axes = false;  // the body axes go through the pin and the tip
  std::vector<double> masses;
  std::vector<Vector3> positions;
  std::vector<Matrix34> shapes;
  const auto add = [&](double mass, const Vector3& position, const Matrix34& phi) {
    masses.push_back(mass);
    positions.push_back(position);
    shapes.push_back(phi);
    set.node_ids.push_back(static_cast<int>(masses.size()));
  };
  for (int i = 0; i < places; ++i) {
    const double mass = kM2 * rule.weight[i], s = (rule.x[i] - 0.5) * kL2;
    const Matrix34 phi = shapes_at(rule.x[i]);
    if (i == 0 || i == places - 1) {
      add(mass, {s, 0, 0}, phi);
      continue;
    }
    Matrix34 e = Matrix34::Zero();
    if (i <= 2) e.block<1, 2>(0, 2) = surplus.col(i - 1).transpose() / std::sqrt(mass);
    for (const double side : {y, -y})
      for (const double sign : {1.0, -1.0}) add(mass / 4, {s, side, 0}, phi + sign * e);
  }
  rod.tip = set.node_ids.back();

  const Eigen::Index n = static_cast<Eigen::Index>(masses.size());
  set.node_mass = Eigen::Map<VectorX>(masses.data(), n);
  set.node_position.resize(3, n);
  set.shapes.resize(3 * n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    set.node_position.col(i) = positions[i];
    set.shapes.middleRows<3>(3 * i) = shapes[i];
  }
  rod.L = printed_mass().llt().matrixL();
  const auto inverse = [&](const MatrixX& A) -> MatrixX {
    return rod.L.triangularView<Eigen::Lower>().solve(A);
  };
  set.shapes = inverse(set.shapes.transpose()).transpose().eval();
  const MatrixX K_half = inverse(printed_stiffness());
  set.stiffness = inverse(K_half.transpose());
  set.stiffness = (set.stiffness + set.stiffness.transpose()).eval() / 2;
  set.damping = VectorX::Zero(4);
  return rod;
}

TEST(FlexibleSliderCrank, MassPointsOfTheRodHaveItsIntegrals) {
  const Rod rod = make_rod();
  const ShapeSet& set = rod.set;
  const MatrixX phi = set.shapes * rod.L.transpose();  // of q
  double mass = 0, J2 = 0;
  Matrix4 M = Matrix4::Zero(), B = Matrix4::Zero();
  Vector4 c1 = Vector4::Zero(), c2 = Vector4::Zero(), c12 = Vector4::Zero(), c21 = Vector4::Zero();
  for (int i = 0; i < set.node_count(); ++i) {
    const double m = set.node_mass[i];
    const Vector3 s = set.node_position.col(i) + Vector3(kL2 / 2, 0, 0);  // from the pin
    const Vector4 x = phi.row(3 * i), y = phi.row(3 * i + 1);
    mass += m;
    J2 += m * s.squaredNorm();
    M += m * (x * x.transpose() + y * y.transpose());
    B += m * (x * y.transpose() - y * x.transpose());
    c1 += m * x;
    c2 += m * y;
    c12 += m * (s.x() * x + s.y() * y);
    c21 += m * (s.x() * y - s.y() * x);
  }
  const double B13 = -16 / std::pow(kPi, 3), B14 = 8 / std::pow(kPi, 3) - 1 / kPi, B24 = 1 / (2 * kPi);
  Matrix4 B_printed = Matrix4::Zero();
  B_printed(0, 2) = B13;
  B_printed(0, 3) = B14;
  B_printed(1, 3) = B24;
  B_printed -= B_printed.transpose().eval();
  const double tolerance = 1e-12 * kFacM;
  EXPECT_NEAR(mass, kM2, tolerance);
  EXPECT_NEAR(J2, kJ2, 1e-12 * kJ2);
  EXPECT_LE((M - printed_mass()).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((B - kFacM * B_printed).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((c1 - kFacM * Vector4(0, 0, 2.0 / 3, 1.0 / 6)).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((c2 - kFacM * Vector4(2 / kPi, 0, 0, 0)).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((c12 - kL2 * kFacM * Vector4(0, 0, 1.0 / 3, 1.0 / 6)).cwiseAbs().maxCoeff(), kL2 * tolerance);
  EXPECT_LE((c21 - kL2 * kFacM * Vector4(1 / kPi, -1 / (2 * kPi), 0, 0)).cwiseAbs().maxCoeff(),
            kL2 * tolerance);
  const Matrix4 K = rod.L * set.stiffness * rod.L.transpose();
  EXPECT_LE((K - printed_stiffness()).cwiseAbs().maxCoeff(), 1e-12 * printed_stiffness().norm());
}

// ---- the mechanism

/// phi2, x3 and q of the problem, or their rates or accelerations.
struct Coordinates {
  double phi2 = 0, x3 = 0;
  Vector4 q = Vector4::Zero();
};

/// Published state at 0.1 s. Multipliers are those of the rows y and x at the tip and of the drive.
struct Reference {
  Coordinates position, rate, acceleration;
  Vector3 lambda;
};

class SliderCrank {
 public:
  /// The rod floats and is held at its pin by a cut joint, for a flexible body cannot hang on a revolute one.
  SliderCrank(const Coordinates& start, const Coordinates& rates) : rod_(make_rod()) {
    SystemBuilder b;
    const Vector3 pin(kL1, 0, 0), tip(kL1 + kL2, 0, 0);
    const int crank =
        b.add_body("crank", kM1, diagonal(1e-4, kJ1, kJ1), {Matrix3::Identity(), Vector3(kL1 / 2, 0, 0)});
    b.add_joint("bearing", {}, crank, Vector3::Zero(),
                PrescribedJoint{PrescribedJoint::Kind::revolute, Vector3::UnitZ(),
                                Motion("drive", Function(Expression("w*t", {"t"}, {{"w", kOmega}})))});
    const int rod = b.add_flexible_body("rod", rod_.set, {Matrix3::Identity(), (pin + tip) / 2});
    const Vector3 spin(0, 0, rates.phi2);
    b.set_velocity(rod, kOmega * Vector3::UnitZ().cross(pin) + spin.cross((tip - pin) / 2), spin);
    const int block = b.add_body("block", kM3, diagonal(1e-5, 1e-5, 1e-5), {Matrix3::Identity(), tip});
    b.add_joint("guide", {}, block, tip, PrismaticJoint(Vector3::UnitX()), start.x3 - tip.x(), rates.x3);
    b.add_closure("pin", b.add_marker({crank}, pin), b.add_marker({rod}, pin), RevoluteClosure{});
    b.add_closure("tip", b.add_marker({rod, rod_.tip}), b.add_marker({block}, tip), SphericalClosure{});
    auto [system, state] = std::move(b).build();
    m_ = {std::move(system), std::move(state)};
    rod_body_ = b.built_index(rod);
    block_body_ = b.built_index(block);
    const FlexibleBody& flexible = m_.system.flexible.front();
    m_.state.q.segment<4>(flexible.z_start) = rod_.z_of(start.q);
    m_.state.v.segment<4>(flexible.z_rate_start) = rod_.z_of(rates.q);
  }

  /// The mechanism after 0.1 s, in the problem's terms.
  Reference at_0p1(double rtol, double atol) {
    TransientOptions options;
    options.duration = options.interval = 0.1;
    options.integrator.rtol = rtol;
    options.integrator.atol = atol;
    Workspace run_ws(m_.system);
    const TransientSummary summary = run_transient(m_.system, m_.state, options, run_ws,
                                                   [&](const State& s, const Work&) { m_.state = s; });
    EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
    EXPECT_EQ(summary.assembly.redundant_rows.size(), 1U) << "the plane loop closes itself out of plane";
    return evaluate();
  }

 private:
  Reference evaluate() const {
    const System& system = m_.system;
    Workspace ws = testing::with_independent_rows(m_);
    calc_forward_dynamics(system, m_.state, ws);
    const BodyMotion &rod = ws.bodies[rod_body_], &block = ws.bodies[block_body_];
    const FlexibleMotionT<double>& bending = ws.flexible.front();
    Reference r;
    r.position = {std::atan2(rod.X_WB.R(1, 0), rod.X_WB.R(0, 0)), block.X_WB.p.x(),
                  rod_.q_of(bending.modal.z)};
    r.rate = {angular(rod.V).z(), linear(block.V).x(), rod_.q_of(bending.modal.zdot)};
    r.acceleration = {angular(rod.A).z(), linear(block.A).x(), rod_.q_of(bending.z_dd)};
    // M p'' = f - G^T lambda: the row y pulls the tip by -lambda_1, the row x the block by -lambda_2
    const Vector3 on_rod = linear(closure_wrench(system.closures[1], 0, ws.lambda, ws));
    calc_joint_forces(system, ws);
    const double drive = calc_motion_power(system, m_.state.t, ws) / kOmega;
    r.lambda = {-on_rod.y(), on_rod.x(), -drive};
    return r;
  }

  Rod rod_;
  Built m_;
  int rod_body_ = 0, block_body_ = 0;
};

double relative(double value, double reference) {
  return std::abs(value / reference - 1);
}

TEST(FlexibleSliderCrank, FollowsTheSmoothMotionToEightDigits) {
  // the problem's own start, on the slow motion; exact pi in the matrices, linear stiffness
  SliderCrank mechanism({0, 4.50016932796900000e-01, {0, 0, 1.03339863e-05, 1.69327969e-05}},
                        {-7.49957670396945238e+01,
                         -2.68938672e-06,
                         {4.44896105e-01, 4.63434311e-03, -1.78591076e-06, -2.68938672e-06}});
  const Reference expected{
      {-3.3117349882569756e-01,
       1.6973733263990974e-01,
       {1.893192467657070e-04, 2.375751487770230e-05, -5.323896807389100e-06, -8.363313337818813e-06}},
      {6.025346755131174e+01,
       -8.753116326721195e+00,
       {-3.0055504881190e-02, -5.5004308826156e-03, 4.9741113361509e-04, 1.1055599762733e-03}},
      {6.4887375405355e+03,
       2.1679386287865e+03,
       {3.3911464286971e+01, 1.7149713979411e-01, -1.4224486493706e+00, 1.0039457433152e+00}},
      {-6.2329363549833e+01, -1.6379209928208e+02, 2.5298580197194e+01}};
  const Reference found = mechanism.at_0p1(1e-9, 1e-13);
  EXPECT_LE(relative(found.position.phi2, expected.position.phi2), 1e-8);
  EXPECT_LE(relative(found.position.x3, expected.position.x3), 1e-8);
  for (int i = 0; i < 4; ++i) EXPECT_LE(relative(found.position.q[i], expected.position.q[i]), 1e-8) << i;
  // what remains of an error in q4 swings at 2e4 rad/s, which multiplies it in rates and again in accelerations
  const double w = 2e4, error = 1e-8 * expected.position.q.tail<2>().norm();
  EXPECT_LE(relative(found.rate.phi2, expected.rate.phi2), 1e-8);
  EXPECT_LE(relative(found.rate.x3, expected.rate.x3), 1e-8);
  EXPECT_LE((found.rate.q - expected.rate.q).cwiseAbs().maxCoeff(), w * error);
  EXPECT_LE((found.acceleration.q - expected.acceleration.q).cwiseAbs().maxCoeff(), w * w * error);
  EXPECT_LE(relative(found.acceleration.phi2, expected.acceleration.phi2), 1e-7);
  EXPECT_LE(relative(found.acceleration.x3, expected.acceleration.x3), 1e-7);
  EXPECT_LE((found.lambda - expected.lambda).norm(), 1e-7 * expected.lambda.norm());
}

TEST(FlexibleSliderCrank, RingsFromARigidStartWithItsAmplitudeAndPhase) {
  // undeformed with the rates of the rigid mechanism, which sets every elastic shape ringing
  SliderCrank mechanism({0, 0.45, Vector4::Zero()}, {-75, 0, Vector4::Zero()});
  const Reference found = mechanism.at_0p1(1e-9, 1e-10);
  EXPECT_LE(relative(found.position.phi2, -3.3117900604399471e-01), 1e-9);
  EXPECT_LE(relative(found.position.x3, 1.6973225166865220e-01), 1e-9);
  const Vector4 q(-1.417241255705478e-04, 2.162530613134591e-05, -7.934712392419564e-06,
                  -1.316818732416687e-05);
  for (int i = 0; i < 4; ++i) EXPECT_LE(relative(found.position.q[i], q[i]), 1e-6) << i;
  EXPECT_LE(relative(found.rate.q[0], 1.2194754414000e-01), 1e-6);
  EXPECT_LE(relative(found.rate.phi2, 6.016395193072944e+01), 1e-8);
}

}  // namespace
}  // namespace wishbone

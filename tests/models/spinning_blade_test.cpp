// A blade of solid elements on a hub that turns: how far it sags under its weight, against a beam under tension. The whole way
// from the scene: mesh, modes, rigid frame, stiffening, floating axes, time integration.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <vector>

#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr double kSpin = 20;  // [rad/s]; at rest the blade swings with 16

// 1 m x 0.1 m x 0.02 m, its root at the axis; damped so much that it comes to rest in its turning axes. Along it are so many
// elements that the sag is within 0.3 % of the beam's: 30, 60, 90 leave 0.54, 0.21, 0.10 %.
constexpr std::string_view kSaggingBlade = R"(wishbone: 1
parameters: {spin: 20 rad/s}
gravity: [0, 0, -1]
bodies:
  blade:
    form: modal
    position: [0.5, 0, 0]
    velocity: [0, = 0.5*spin, 0]
    angular_velocity: [0, 0, = spin]
    flexible:
      block: {size: [1, 0.1, 0.02], elements: [60, 2, 1]}
      material: {young: 400 MPa, poisson: 0.3, density: 1000}
      modes: 8
      attachment: [1, 2, 3, 4, 5, 6]
      damping: 4
      frames: {root: {nodes: [1, 2, 3, 4, 5, 6], rigid: true}}
      stiffening: {held: [1, 2, 3, 4, 5, 6], centre: [0, 0, 0]}
joints:
  hub: {type: revolute, bodies: [ground, {body: blade, frame: root}], axis: [0, 0, 1], motion: turn}
motions:
  turn: {expression: spin*t}
analysis: {duration: 3 s, integrator: bdf, rtol: 1e-6, atol: 1e-8}
output: {interval: 1 s, points: {tip: {body: blade, node: 362}}}
)";

class SpinningBlade : public testing::Test {
 protected:
  /// Of the tip under its weight, at the end [m].
  double sag(const std::vector<std::string>& overrides, bool stiffened = true) const {
    std::string text(kSaggingBlade);
    if (!stiffened)
      text.erase(text.find("      stiffening:"), text.find("joints:") - text.find("      stiffening:"));
    const Scene scene = load_scene(files_.write("blade.yaml", text), overrides);
    const auto file = files_ / "blade.h5";
    const TransientSummary summary = run_scene(scene, compile(scene), {"blade.yaml", file, {}, {}}).summary;
    EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
    const MatrixX tip = ResultFile(file.string()).read("/points/tip/position");
    return tip(0, 2) - tip(tip.rows() - 1, 2);
  }
  TextFiles files_;
};

/// Sag of the tip of a clamped beam of unit length, w(0) = w'(0) = 0, under unit weight, by Ritz with x^2 ... x^9:
///     1/2 int (c w''^2 + T w'^2 - (1 - share) T (w' - theta)^2 - 2 w) dx = min,   c = EI / (rho A),
/// T = spin^2 (1 - x^2) / 2 the tension. A body in mean axes, which turn by theta = 12 int (x - 1/2) w dx, has the tension's work
/// on theta and its product with w' - theta from the motion of its axes, exactly; that on w' - theta is the geometric
/// stiffening, of which `share` is there.
double sag_of_beam(double c, double spin, double share) {
  constexpr int n = 8;
  static constexpr int kPoints = 2000;
  using Row = Eigen::Matrix<double, n, 1>;
  const auto shapes = [](double x, int derivative) {
    Row row;
    for (int k = 2; k < n + 2; ++k) {
      const double factor = derivative == 0 ? 1 : derivative == 1 ? k : k * (k - 1);
      row[k - 2] = factor * std::pow(x, k - derivative);
    }
    return row;
  };
  const auto integrate = [](auto&& integrand, auto sum) {
    for (int i = 0; i < kPoints; ++i) sum += integrand((i + 0.5) / kPoints) / kPoints;
    return sum;
  };
  const Row theta = integrate([&](double x) { return Row(12 * (x - 0.5) * shapes(x, 0)); }, Row(Row::Zero()));
  using Matrix = Eigen::Matrix<double, n, n>;
  const Matrix K = integrate(
      [&](double x) {
        const double T = spin * spin * (1 - x * x) / 2;
        const Row w1 = shapes(x, 1), w2 = shapes(x, 2), bent = w1 - theta;
        return Matrix(c * w2 * w2.transpose() + T * w1 * w1.transpose() -
                      (1 - share) * T * bent * bent.transpose());
      },
      Matrix(Matrix::Zero()));
  const Row weight = integrate([&](double x) { return shapes(x, 0); }, Row(Row::Zero()));
  return shapes(1, 0).dot(Row(K.ldlt().solve(weight)));
}

TEST_F(SpinningBlade, SagsAsABeamUnderTensionDoes) {
  // the bending stiffness that the elements have is measured at rest, w = 1 / (8 c)
  const double c = 1 / (8 * sag({"spin=0"}));
  EXPECT_NEAR(sag_of_beam(c, 0, 1), 1 / (8 * c), 1e-6 / c);
  const double stiff = sag_of_beam(c, kSpin, 1), soft = sag_of_beam(c, kSpin, 0);
  ASSERT_GT(soft, 1.15 * stiff);
  EXPECT_NEAR(sag({}), stiff, 3e-3 * stiff);
  EXPECT_NEAR(sag({}, false), soft, 3e-3 * soft);
}

}  // namespace
}  // namespace wishbone

// The rigid benchmark problems against their reference digits, energy books and reported redundancies. Every scene is
// models/scenes/benchmarks/*.yaml; references are cited with each.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "models/compile.h"
#include "models/plan.h"
#include "models/scene_loader.h"
#include "solver/observer.h"

namespace wishbone {
namespace {

/// One run of a benchmark scene: the signals at every output time.
struct Benchmark {
  TransientSummary summary;
  WorkCounters work;
  std::map<std::string, std::vector<std::vector<double>>> signals;  // by path, a row for each output

  double scalar(const std::string& path, std::size_t row) const { return signals.at(path)[row][0]; }
  Vector3 vector(const std::string& path, std::size_t row) const {
    return Eigen::Map<const Vector3>(signals.at(path)[row].data());
  }
  /// Largest departure of the sum of stored energies, dissipation and input from its start [J].
  double energy_drift() const {
    const auto& balance = signals.at("/energy/balance");
    double drift = 0;
    for (const auto& row : balance) drift = std::max(drift, std::abs(row[0] - balance.front()[0]));
    return drift;
  }
  double largest(const std::string& path) const {
    double largest = 0;
    for (const auto& row : signals.at(path)) largest = std::max(largest, std::abs(row[0]));
    return largest;
  }
};

struct Scheme {
  Form form = Form::automatic;
  Method method = Method::automatic;
};

Benchmark run(const std::string& name, const std::vector<std::string>& overrides, double duration,
              double interval, double tolerance, Scheme scheme = {}) {
  const auto path = std::filesystem::path(WISHBONE_SCENES) / "benchmarks" / (name + ".yaml");
  CompiledScene compiled = compile(load_scene(path, overrides));
  TransientOptions options;
  options.duration = duration;
  options.interval = interval;
  options.integrator = {scheme.form, scheme.method, tolerance, 0.1 * tolerance, 0, 0};
  Benchmark result;
  Workspace ws(compiled.system);
  Observer observer(compiled.system, compiled.observer);
  result.summary = run_transient(compiled.system, compiled.initial, options, ws,
                                 [&](const State& state, const Work& work) {
                                   const double* row = observer.sample(state, work, ws).data();
                                   for (const Signal& signal : observer.signals()) {
                                     result.signals[signal.path].emplace_back(row, row + signal.size());
                                     row += signal.size();
                                   }
                                 });
  EXPECT_EQ(result.summary.status, TransientSummary::Status::complete)
      << to_string(scheme.form) << " " << to_string(scheme.method) << " at " << tolerance << ": "
      << result.summary.message;
  result.work = ws.work;
  return result;
}

TEST(SimplePendulum, FollowsItsEllipticFunction) {
  // IFToMM A01; phi from the downward vertical, -pi/2 at the start, 50-digit Jacobi functions
  const Benchmark r = run("simple_pendulum", {}, 10, 1, 1e-12);
  const auto phi = [&](std::size_t t) {
    return r.scalar("/joints/pin/coordinates", t) - std::numbers::pi / 2;
  };
  EXPECT_NEAR(phi(1), 1.40502731152479914595842, 1e-9);
  EXPECT_NEAR(phi(5), -1.22945181148538555927776, 1e-9);
  EXPECT_NEAR(phi(10), -2.78680673569982948434767e-01, 1e-9);
  EXPECT_NEAR(r.scalar("/joints/pin/speeds", 10), 4.34316069286468305328527, 1e-9);
  EXPECT_LT(r.energy_drift(), 1e-9);
}

TEST(DoublePendulum, FollowsTheQuadruplePrecisionSolution) {
  // absolute angles from the downward vertical; a change of 1e-9 at the start grows 108-fold to 10 s
  const Benchmark r = run("double_pendulum", {}, 10, 1, 1e-12);
  const auto th1 = [&](std::size_t t) {
    return std::numbers::pi / 2 + r.scalar("/joints/pin/coordinates", t);
  };
  const auto th2 = [&](std::size_t t) { return th1(t) + r.scalar("/joints/elbow/coordinates", t); };
  const auto near = [](double angle, double reference, double tolerance) {
    EXPECT_NEAR(std::remainder(angle - reference, 2 * std::numbers::pi), 0, tolerance);
  };
  near(th1(1), -6.250876998063906299541e-01, 1e-10);
  near(th2(1), -1.034585085680012340612, 1e-10);
  near(th1(5), -6.271867050665307301381e-01, 1e-9);
  near(th2(5), -1.301315550209811677908, 1e-9);
  near(th1(10), -5.684746640159501887761e-01, 1e-8);
  near(th2(10), -5.263937279324046983296e-01, 1e-8);
  EXPECT_LT(r.energy_drift(), 1e-9);
}

TEST(TorqueFreeTop, KeepsItsAttitudeToTheDigitsOfJacobisFunctions) {
  // quaternion w x y z; 24-digit reference
  const auto attitude_error = [](const Benchmark& r, std::size_t row, const Eigen::Vector4d& expected) {
    const Eigen::Vector4d q =
        Eigen::Map<const Eigen::Vector4d>(r.signals.at("/bodies/top/orientation")[row].data());
    return std::min((q - expected).norm(), (q + expected).norm());
  };
  const Benchmark generic = run("torque_free_top", {}, 100, 10, 1e-13);
  EXPECT_LT(attitude_error(generic, 10,
                           {7.15401938045053785e-02, -3.13690704852154371e-01, -4.67159246132691487e-01,
                            -8.23554722597416570e-01}),
            1e-9);
  EXPECT_LT(generic.energy_drift(), 1e-10);
  const Benchmark flip = run("torque_free_top", {"start=intermediate_axis"}, 50, 10, 1e-13);
  EXPECT_LT(attitude_error(flip, 5,
                           {3.80979709192103532e-01, -9.99999210217757020e-03, -9.24489842150399004e-01,
                            -8.54360009521411242e-03}),
            1e-9);
}

TEST(AndrewsSqueezer, ReachesTheReferenceToNineDigits) {
  // test set for IVP solvers II-13; angles at 0.03 s, two integrations in quadruple precision
  const Benchmark r = run("andrews_squeezer", {}, 0.03, 0.03, 1e-12);
  const auto angle = [&](const char* joint) {
    return r.scalar(std::string("/joints/") + joint + "/coordinates", 1);
  };
  const double beta0 = -6.171389001427644963589484580e-02, gamma0 = 4.552798191630703802559123824e-01;
  const double phi0 = 2.226683901658858846744731856e-01, delta0 = 4.873649795438425502255989535e-01;
  const double epsilon0 = 1.230547444549821192497350156;
  EXPECT_NEAR(beta0 + angle("beta"), 1.581077119515370709712e+01, 1.6e-8);
  EXPECT_NEAR(angle("theta"), -1.575637105841183946973e+01, 1.6e-8);
  EXPECT_NEAR(gamma0 + angle("gamma"), 4.082224011964580485828e-02, 1e-9);
  EXPECT_NEAR(phi0 + angle("phi"), -5.347301163420795937702e-01, 1e-9);
  EXPECT_NEAR(delta0 + angle("delta"), 5.244099658799540693717e-01, 1e-9);
  EXPECT_NEAR(-phi0 + angle("Omega"), 5.347301163420795937702e-01, 1e-9);
  EXPECT_NEAR(epsilon0 + angle("epsilon"), 1.048080741041937873069, 1e-9);
  // rates of the same integrations, to nine digits of the fastest
  const auto rate = [&](const char* joint) {
    return r.scalar(std::string("/joints/") + joint + "/speeds", 1);
  };
  const double tolerance = 1e-9 * 1.424379295177540073196e+03;
  EXPECT_NEAR(rate("beta"), 1.139920302259106064198e+03, tolerance);
  EXPECT_NEAR(rate("theta"), -1.424379295177540073196e+03, tolerance);
  EXPECT_NEAR(rate("gamma"), 1.103291191061859374533e+01, tolerance);
  EXPECT_NEAR(rate("phi"), 1.929337410503204083163e+01, tolerance);
  EXPECT_NEAR(rate("delta"), 5.735699148295024538177e-01, tolerance);
  EXPECT_NEAR(rate("Omega"), -1.929337410503204083163e+01, tolerance);
  EXPECT_NEAR(rate("epsilon"), 3.231791492491308749907e-01, tolerance);
  EXPECT_LT(r.energy_drift(), 1e-10);
  EXPECT_EQ(r.summary.assembly.redundant_rows.size(), 9u);  // three planar loops in space
}

TEST(AndrewsSqueezer, IsTheSameInEveryForm) {
  const Benchmark reference = run("andrews_squeezer", {}, 0.015, 0.015, 1e-12);
  for (const Scheme scheme : {Scheme{Form::index1, Method::bdf}, Scheme{Form::index1, Method::adams},
                              Scheme{Form::partition, Method::erk}, Scheme{Form::partition, Method::bdf},
                              Scheme{Form::partition, Method::adams}, Scheme{Form::ggl, Method::bdf}}) {
    const Benchmark r = run("andrews_squeezer", {}, 0.015, 0.015, 1e-9, scheme);
    for (const char* joint : {"beta", "theta", "gamma", "phi", "delta", "Omega", "epsilon"}) {
      const std::string path = std::string("/joints/") + joint + "/coordinates";
      EXPECT_NEAR(r.scalar(path, 1), reference.scalar(path, 1), 2e-5)
          << to_string(scheme.form) << " " << to_string(scheme.method) << " " << joint;
    }
  }
}

TEST(AndrewsSqueezer, IsFollowedInIndependentCoordinatesByCoarseSteps) {
  // the dependent coordinates lie far from those of the stage before
  const auto beta = [](double tolerance) {
    return run("andrews_squeezer", {}, 0.03, 0.03, tolerance, {Form::partition, Method::erk})
        .scalar("/joints/beta/coordinates", 1);
  };
  const double expected = 1.581077119515370709712e+01 + 6.171389001427644963589484580e-02;
  for (const double tolerance : {3e-4, 1e-4, 3e-5})
    EXPECT_NEAR(beta(tolerance), expected, 20 * tolerance * expected) << tolerance;
  for (const double tolerance : {1e-2, 1e-3})
    EXPECT_NEAR(beta(tolerance), expected, 4) << tolerance;  // it arrives
}

TEST(Bricard, MovesWithoutHelpAlthoughItsRowsAreRedundant) {
  // IFToMM A04: the point P3, joint between bars 3 and 4; closed-form path and quadrature
  const Benchmark r = run("bricard", {}, 10, 1, 1e-11);
  EXPECT_EQ(r.summary.assembly.redundant_rows.size(), 1u);
  // q1 = angle of P0
  EXPECT_NEAR(r.scalar("/joints/P0/coordinates", 1), 1.03502845952, 1e-9);
  EXPECT_NEAR(r.scalar("/joints/P0/coordinates", 3), 2.88476160446, 1e-8);
  EXPECT_NEAR(r.scalar("/joints/P0/coordinates", 7), 2.90174362146, 1e-8);
  EXPECT_NEAR(r.scalar("/joints/P0/coordinates", 9), 1.00147056004, 1e-8);
  EXPECT_LT(r.energy_drift(), 1e-7);
  EXPECT_LT(r.largest("/constraints/position_residual"), 1e-11);
}

/// IFToMM A02: all cranks turn alike, psi'' = -W sin psi, psi = theta + pi/2 with psi(0) = pi, psi'(0) = -1 (closed form).
class FourBars : public testing::TestWithParam<int> {
 protected:
  int N() const { return GetParam(); }
  Benchmark run_for_10_s(double tolerance) const {
    return run("n_four_bar", {"N=" + std::to_string(N())}, 10, 1, tolerance);
  }
  double energy() const { return ((N() + 1) / 3.0 + N()) / 2 + 9.81 * ((N() + 1) / 2.0 + N()); }
  /// Rate of every crank at t [rad/s].
  double rate(std::size_t t) const {
    static const std::map<std::pair<int, std::size_t>, double> rates = {
        {{1, 4}, -1.13988786970367386522215},  {{1, 10}, -1.96693471944031945632741},
        {{2, 4}, -1.07651118008554302195702},  {{2, 10}, -1.50664218084182946989427},
        {{40, 4}, -1.02627468830062499705845}, {{40, 10}, -1.16762210875170682781068}};
    return rates.at({N(), t});
  }
};

TEST_P(FourBars, PassSingularPositionsOnTheBranchOfParallelograms) {
  const Benchmark r = run_for_10_s(N() < 10 ? 1e-10 : 1e-9);
  for (const std::size_t t : {4, 10})
    for (const int crank : {0, N()})
      EXPECT_NEAR(r.scalar("/joints/pin_" + std::to_string(crank) + "/speeds", t), rate(t), 1e-7)
          << "crank " << crank << " at " << t << " s";
  EXPECT_LT(r.energy_drift(), 1e-8 * energy());
  EXPECT_EQ(r.summary.assembly.redundant_rows.size(), static_cast<std::size_t>(3 * N()));
  // two singular positions in each turn of about 2 s
  EXPECT_EQ(r.summary.singular_passages.size(), 10U);
}
INSTANTIATE_TEST_SUITE_P(Loops, FourBars, testing::Values(1, 2, 40),
                         [](const auto& p) { return "N" + std::to_string(p.param); });

/// Next to a singular position a run can be lucky: no tolerance may fail.
class FewFourBars : public FourBars {};

TEST_P(FewFourBars, PassSingularPositionsAtEveryTolerance) {
  for (int k = 0; k <= 16; ++k) {
    const double tolerance = std::pow(10, -6 - 0.25 * k);
    const Benchmark r = run_for_10_s(tolerance);
    EXPECT_LT(r.energy_drift(), 100 * tolerance * energy()) << "tolerance " << tolerance;
    // the longest steps may go over a position unnoticed
    EXPECT_GE(r.summary.singular_passages.size(), tolerance > 5e-7 ? 9U : 10U) << "tolerance " << tolerance;
    EXPECT_LE(r.summary.singular_passages.size(), 10U) << "tolerance " << tolerance;
  }
}
INSTANTIATE_TEST_SUITE_P(Loops, FewFourBars, testing::Values(1, 2, 5, 10),
                         [](const auto& p) { return "N" + std::to_string(p.param); });

TEST(Governor, StiffAsItIsFollowsTheRadauSolution) {
  // IFToMM A05, full model integrated in quadruple precision
  const Benchmark r = run("flyball_governor", {}, 10, 1, 1e-12, {Form::ode, Method::bdf});
  const double s[] = {0.5,
                      5.01420922379567651e-01,
                      5.05909294296703707e-01,
                      5.13246078340220428e-01,
                      5.23223371026043407e-01,
                      5.35563103721643484e-01,
                      5.49928665905642256e-01,
                      5.65938157719403168e-01,
                      5.83178336709771875e-01,
                      6.01218402047506222e-01,
                      6.19622917061365659e-01};
  for (std::size_t t = 1; t <= 10; ++t)
    EXPECT_NEAR(0.5 + r.scalar("/joints/guide/coordinates", t), s[t], 5e-10) << t << " s";
  EXPECT_NEAR(r.scalar("/joints/bearing/coordinates", 10), 5.5935409909102379e+01, 5e-8);
}

}  // namespace
}  // namespace wishbone

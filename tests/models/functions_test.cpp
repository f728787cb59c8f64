// Motions and loads that are functions of time and signals, from the scene to the motion, against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "mutated_text.h"
#include "solver/observer.h"
#include "text_files.h"

namespace wishbone {
namespace {

class Functions : public testing::Test {
 protected:
  struct Result {
    std::vector<double> t, u, speed, balance;
  };

  Scene load(const std::string& text) {
    return load_scene(files_.write("scene.yaml", "wishbone: 1\ngravity: [0, 0, 0]\n" + text));
  }

  /// Runs a scene with the joint `slide` and records its coordinate.
  Result run(const Scene& scene, Form form = Form::ode, Method method = Method::automatic,
             double tolerance = 1e-10) {
    CompiledScene compiled = compile(scene);
    TransientOptions options = compiled.transient;
    options.integrator = {form, method, tolerance, 0.1 * tolerance, 0, 0};
    Workspace ws(compiled.system);
    Observer observer(compiled.system, compiled.observer);
    Result result;
    const auto summary = run_transient(compiled.system, compiled.initial, options, ws,
                                       [&](const State& state, const Work& work) {
                                         const double* row = observer.sample(state, work, ws).data();
                                         result.t.push_back(state.t);
                                         for (const Signal& signal : observer.signals()) {
                                           if (signal.path == "/joints/slide/coordinates")
                                             result.u.push_back(*row);
                                           if (signal.path == "/joints/slide/speeds")
                                             result.speed.push_back(*row);
                                           if (signal.path == "/energy/balance")
                                             result.balance.push_back(*row);
                                           row += signal.size();
                                         }
                                       });
    EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
    EXPECT_FALSE(result.u.empty());
    for (const double balance : result.balance) EXPECT_NEAR(balance, result.balance.front(), 1e-7);
    return result;
  }

  TextFiles files_;
};

const std::string kCart = R"(parameters: {mass: 2 kg, stiffness: 50 N/m, w: 3}
bodies:
  cart: {mass: = mass, inertia: [1, 1, 1], position: [0, 0, 0]}
joints:
  slide: {type: prismatic, bodies: [ground, cart], at: [0, 0, 0], axis: [1, 0, 0], position: 0.1}
analysis: {duration: 2}
output: {interval: 0.25}
)";

// m x'' = F sin(w t):   x = x0 + F/(m w^2) (w t - sin(w t))
TEST_F(Functions, AHarmonicLoadMovesACartAsItsClosedForm) {
  const Result r = run(load(kCart + R"(loads:
  push: {body: cart, force: [{expression: 10*sin(w*t)}, 0, 0]}
)"));
  for (std::size_t i = 0; i < r.t.size(); ++i)
    EXPECT_NEAR(r.u[i], 0.1 + 10.0 / (2 * 9) * (3 * r.t[i] - std::sin(3 * r.t[i])), 1e-8);
}

// f = -k u is a spring:   u = u0 cos(sqrt(k/m) t). A joint that closes the loop makes the form with exact
// Jacobians possible.
TEST_F(Functions, ALoadOnASignalIsASpringInEveryForm) {
  const std::string scene = kCart + R"(signals:
  travel: {joint: slide}
  place: {body: cart, component: x}
  distance: {from: {ground: [-1, 0, 0]}, to: {body: cart}}
loads:
  spring: FORCE
)";
  const double w = std::sqrt(50.0 / 2);
  for (const std::string force :
       {"{body: cart, force: [{expression: -stiffness*travel}, 0, 0]}",
        "{body: cart, force: [{expression: -stiffness*place}, 0, 0]}",
        "{body: cart, force: [{expression: 'stiffness*(1 - distance)'}, 0, 0]}",
        "{body: cart, force: [{table: {of: travel, points: [[-1, 50], [1, -50 N]]}}, 0, 0]}",
        "{joint: slide, force: {expression: -stiffness*travel}}"}) {
    std::string text = scene;
    text.replace(text.find("FORCE"), 5, force);
    for (const bool cut : {false, true}) {
      std::string closed = text;
      if (cut) closed.replace(closed.find("type: prismatic"), 15, "cut: true, type: prismatic");
      if (cut) closed.replace(closed.find(", position: 0.1"), 15, "");
      if (cut)
        closed.replace(closed.find("bodies:\n  cart: {"), 17, "bodies:\n  cart: {velocity: [0.5, 0, 0], ");
      const Result r = cut ? run(load(closed), Form::ggl, Method::bdf) : run(load(closed));
      for (std::size_t i = 0; i < r.t.size(); ++i)
        EXPECT_NEAR(r.u[i], cut ? 0.5 / w * std::sin(w * r.t[i]) : 0.1 * std::cos(w * r.t[i]),
                    cut ? 1e-6 : 1e-8)
            << force << " at " << r.t[i];
    }
  }
}

// J w' = 10 - 2 w:   w = 5 (1 - exp(-2 t/J)), through many turns
TEST_F(Functions, AMotorRunsUpToTheSpeedAtWhichItsTorqueVanishes) {
  const Result r = run(load(R"(bodies:
  rotor: {mass: 1, inertia: [1, 1, 0.4], position: [0, 0, 0]}
joints:
  slide: {type: revolute, bodies: [ground, rotor], at: [0, 0, 0], axis: [0, 0, 1]}
signals:
  rate: {joint: slide, quantity: speed}
  angle: {joint: slide}
loads:
  motor: {joint: slide, moment: {expression: 10 - 2*rate + 0*angle}}
analysis: {duration: 6}
output: {interval: 0.5}
)"));
  for (std::size_t i = 0; i < r.t.size(); ++i) EXPECT_NEAR(r.speed[i], 5 * (1 - std::exp(-5 * r.t[i])), 1e-7);
}

// A torsional spring of angle counts whole turns: f = -k u from u0 of more than a turn.
TEST_F(Functions, AnglesOfSignalsCountWholeTurns) {
  const Result r = run(load(R"(bodies:
  rotor: {mass: 1, inertia: [1, 1, 2], position: [0, 0, 0]}
joints:
  slide: {type: revolute, bodies: [ground, rotor], at: [0, 0, 0], axis: [0, 0, 1], speed: 20}
signals:
  angle: {joint: slide}
loads:
  spring: {joint: slide, moment: {expression: -2*angle}}
analysis: {duration: 4}
output: {interval: 0.5}
)"));
  for (std::size_t i = 0; i < r.t.size(); ++i) EXPECT_NEAR(r.u[i], 20 * std::sin(r.t[i]), 1e-6);
}

// A pulse of 10 ms after seconds of rest: without its stop times, steps of seconds would pass it by.
TEST_F(Functions, ShortPulsesAreNotPassedBy) {
  for (const std::string pulse :
       {"{expression: 'step(t, 1.5, 0, 1.505, 400) - step(t, 1.505, 0, 1.51, 400)'}",
        "{table: {points: [[1.5, 0], [1.505, 400], [1.51, 0]]}}"}) {
    const Result r = run(load(kCart + "loads:\n  push: {body: cart, force: [" + pulse + ", 0, 0]}\n"));
    EXPECT_NEAR(r.speed.back(), 400 * 0.005 / 2, 1e-8) << pulse;
  }
}

// A load along the x axis of a body that lies turned by 90 deg points along y in the design frame.
TEST_F(Functions, LoadsInBodyAxesFollowTheOrientationOfTheBody) {
  const Result r = run(load(R"(bodies:
  cart: {mass: 2, inertia: [1, 1, 1], position: [0, 0, 0], orientation: {axis: [0, 0, 1], angle: 90 deg}}
joints:
  slide: {type: prismatic, bodies: [ground, cart], at: [0, 0, 0], axis: [0, 1, 0]}
loads:
  push: {body: cart, force: [{expression: 6*t}, 0, 0], axes: body}
)"));
  EXPECT_NEAR(r.u.back(), 0.5, 1e-9);  // t^3/2
}

TEST_F(Functions, MotionsFollowMeasuredTables) {
  std::string csv = "# measured\ntime[ms], speed[km/h], angle[deg]\n";
  for (int i = 0; i <= 100; ++i)
    csv += std::to_string(10 * i) + ", 50, " +
           std::to_string(10 * std::sin(2 * std::numbers::pi * 0.01 * i)) + "\n";
  files_.write("steer.csv", csv);
  const Scene scene = load(R"(bodies:
  wheel: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0]}
  load: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}
joints:
  slide: {type: revolute, bodies: [ground, wheel], at: [0, 0, 0], axis: [0, 0, 1], motion: steer}
  hinge: {type: prismatic, bodies: [wheel, load], at: [1, 0, 0], axis: [1, 0, 0]}
motions:
  steer: {table: {file: steer.csv, columns: [time, angle]}}
output: {interval: 0.1}
)");
  // each point of the spline costs the energy book what one step may err
  const Result r = run(scene, Form::ode, Method::automatic, 1e-12);
  for (std::size_t i = 0; i < r.t.size(); ++i)
    EXPECT_NEAR(r.u[i], std::numbers::pi / 18 * std::sin(2 * std::numbers::pi * r.t[i]), 1e-7);
}

TEST_F(Functions, MotionsFollowExpressions) {
  const std::string wheel = R"(parameters: {amplitude: 5 deg, f: 2 Hz}
bodies:
  wheel: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0]}
joints:
  slide: {type: revolute, bodies: [ground, wheel], at: [0, 0, 0], axis: [0, 0, 1], motion: steer}
motions:
  steer: {expression: amplitude*sin(2*pi*f*t)}
)";
  const Scene scene = load(wheel);
  const CompiledScene compiled = compile(scene);
  const auto& joint = std::get<PrescribedJoint>(compiled.system.bodies[0].joint);
  const double w = 4 * std::numbers::pi, a = std::numbers::pi / 36;
  EXPECT_NEAR(joint.motion.at(0.3).position, a * std::sin(w * 0.3), 1e-15);
  EXPECT_NEAR(joint.motion.at(0.3).rate, a * w * std::cos(w * 0.3), 1e-14);
  EXPECT_NEAR(joint.motion.at(0.3).acceleration, -a * w * w * std::sin(w * 0.3), 1e-12);
  // what is recorded with the results gives the same motion
  const Scene again = load_scene(files_.write("again.yaml", scene.text));
  EXPECT_EQ(again.text, scene.text);
}

TEST_F(Functions, AreEitherReadOrRefusedWhateverTheyAreGiven) {
  const std::string good = "wishbone: 1\n" + kCart + R"yaml(signals:
  travel: {joint: slide}
  gap: {from: {ground: [-1, 0, 0]}, to: {body: cart}, quantity: speed}
loads:
  push: {body: cart, force: [{expression: "step(t, 1, 0, 2, w) - stiffness*max(travel, gap^2)"}, 0, 0], axes: body}
  motor: {joint: slide, force: {table: {of: travel, points: [[0, 1 kN], [20 mm, 2]], interpolation: spline}}}
motions:
  spare: {expression: "t > 1 && t < 2 ? sin(2*pi*t) : 0"}
  steer: {table: {points: [[0, 0], [1, 0.1], [2, 0]]}}
)yaml";
  ASSERT_NO_THROW(compile(load_scene(files_.write("scene.yaml", good))));
  constexpr Mutation kMutation{"[]{}:,-#&*!|>'\"%@`=\n \t.e0123456789~?<()+/^xt\x80\x00", 1, 4, 8};
  int loaded = 0, refused = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    std::mt19937 random(seed);
    const auto file = files_.write("scene.yaml", mutated(good, kMutation, random));
    try {
      compile(load_scene(file));
      ++loaded;
    } catch (const InputError& e) {
      ++refused;
      EXPECT_FALSE(e.diagnostic().where.empty()) << "seed " << seed << ": " << e.what();
    }  // anything else fails the test
  }
  EXPECT_GT(loaded, 100);
  EXPECT_GT(refused, 500);
}

struct Refused {
  const char* name;
  const char* text;
  const char* message;
};

class RefusedFunctions : public testing::TestWithParam<Refused> {};

constexpr const char* kWheel = R"(wishbone: 1
parameters: {gain: 2, form: rigid, t0: 1 s}
bodies:
  wheel: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0]}
joints:
  axle: {type: revolute, bodies: [ground, wheel], at: [0, 0, 0], axis: [0, 0, 1]}
  MOTION
)";

TEST_P(RefusedFunctions, TellPlaceAndRemedy) {
  const TextFiles files;
  files.write("two.csv", "time,angle\n0,0\n1,2\n1,3\n");
  files.write("three.csv", "time,angle,speed\n0,0,1\n");
  files.write("unit.csv", "time[m],angle\n0,0\n1,2\n");
  std::string text = kWheel;
  text.replace(text.find("  MOTION\n"), 9, GetParam().text);
  const auto file = files.write("scene.yaml", text);
  EXPECT_EQ(files.relative(message_of<InputError>([&] { load_scene(file); })), GetParam().message);
}

const Refused kRefused[] = {
    {"UnknownName", "loads:\n  push: {body: wheel, force: [{expression: gian*t}, 0, 0]}\n",
     "scene.yaml:8:44: loads.push.force[1].expression: error: the expression cannot be read at character 1, "
     "'gian*t': "
     "there is no 'gian' (got 'gian*t')\n"
     "  did you mean 'gain'?"},
    {"TwoComponents", "loads:\n  push: {body: wheel, force: [{expression: t}, 0]}\n",
     "scene.yaml:8:23: loads.push.force: error: a list of three components (force [N]) is wanted here\n"
     "  write [x, y, z], each a number, {expression: ...} or {table: ...}"},
    {"EmptyFunction", "loads:\n  push: {body: wheel, force: [{}, 0, 0]}\n",
     "scene.yaml:8:31: loads.push.force[1]: error: the function is empty\n"
     "  give 'expression' or 'table'"},
    {"InfiniteConstant", "loads:\n  push: {body: wheel, force: [{expression: 1/(gain - 2)}, 0, 0]}\n",
     "scene.yaml:8:44: loads.push.force[1].expression: error: the value of the expression is not finite (got "
     "'1/(gain - "
     "2)')\n"
     "  look for a division by zero or a root of a negative number"},
    {"TableOfNothing", "loads:\n  push: {body: wheel, force: [{table: {interpolation: linear}}, 0, 0]}\n",
     "scene.yaml:8:32: loads.push.force[1].table: error: a table needs points, from one source\n"
     "  give either 'points' or 'file'"},
    {"TableBackwards", "loads:\n  push: {body: wheel, force: [{table: {points: [[1, 0], [0, 5]]}}, 0, 0]}\n",
     "scene.yaml:8:32: loads.push.force[1].table: error: the points of a table must ascend strictly (got 0)\n"
     "  sort them, and give one value for each"},
    {"TableInWrongUnit",
     "loads:\n  push: {body: wheel, force: [{table: {points: [[0 m, 0], [1, 5]]}}, 0, 0]}\n",
     "scene.yaml:8:50: loads.push.force[1].table.points[1][1]: error: wrong dimension: time [s] is wanted, "
     "this is length "
     "[m] (got '0 m')\n"
     "  give it in s, or in a unit that converts to it"},
    {"TableOfUnknownSignal",
     "loads:\n  push: {body: wheel, force: [{table: {of: gap, points: [[0, 0], [1, 5]]}}, 0, 0]}\n",
     "scene.yaml:8:44: loads.push.force[1].table.of: error: there is no 'gap' among the time 't' and the "
     "signals\n"
     "  the time 't' and the signals are: t"},
    {"MomentOnATravel", "loads:\n  motor: {joint: axle, force: 3}\n",
     "scene.yaml:8:31: loads.motor.force: error: the coordinate is an angle (got '3')\n"
     "  give a 'moment'"},
    {"SignalOfNothing", "signals:\n  gap: {quantity: speed}\n",
     "scene.yaml:8:3: signals.gap: error: the signal measures nothing\n"
     "  give 'joint', or 'from' and 'to' for a distance, or 'body' and 'component'"},
    {"SignalNamedAsATime", "signals:\n  t: {joint: axle}\n",
     "scene.yaml:8:3: signals.t: error: 't' is the time\n  use another name"},
    {"SignalNamedAsAFunction", "signals:\n  sin: {joint: axle}\n",
     "scene.yaml:8:3: signals.sin: error: 'sin' has a meaning in every expression\n  use another name"},
    {"SignalNamedAsAParameter", "signals:\n  gain: {joint: axle}\n",
     "scene.yaml:8:3: signals.gain: error: 'gain' is a parameter too\n"
     "  rename one of them: expressions use both"},
    {"SignalOfNoComponent", "signals:\n  height: {body: wheel, component: w}\n",
     "scene.yaml:8:36: signals.height.component: error: not one of the components (got 'w')\n"
     "  the components are: x, y, z"},
    {"LinearMotion", "motions:\n  steer: {table: {points: [[0, 0], [1, 5]], interpolation: linear}}\n",
     "scene.yaml:8:11: motions.steer.table: error: a linear table has no acceleration at its points\n"
     "  use 'interpolation: spline', or write the motion as steps"},
    {"MotionGivenTwice", "motions:\n  steer: {start: 1, expression: t}\n",
     "scene.yaml:8:3: motions.steer: error: the motion is given twice\n"
     "  give 'start' and 'steps', or 'expression', or 'table'"},
    {"MotionOfASignal", "signals:\n  angle: {joint: axle}\nmotions:\n  steer: {expression: 2*angle}\n",
     "scene.yaml:10:3: motions.steer: error: the motion depends on the signal 'angle'\n"
     "  motions are functions of the time t alone; let a load depend on the signal"},
    {"MotionEndsBeforeTheRun", "motions:\n  steer: {table: {points: [[0, 0], [0.5, 5]]}}\n",
     "scene.yaml:8:3: motions.steer: error: the table spans 0 s to 0.5 s, the run 0 s to 1 s\n"
     "  give points for the whole run, or shorten it: at an end the motion need not rest"},
    {"FileMissing", "motions:\n  steer: {table: {file: none.csv}}\n",
     "scene.yaml:8:25: motions.steer.table.file: error: there is no file none.csv (got 'none.csv')\n"
     "  names are relative to the file that they stand in"},
    {"FileNotAscending", "motions:\n  steer: {table: {file: two.csv}}\n",
     "scene.yaml:8:11: motions.steer.table: error: the points of a table must ascend strictly (got 1)\n"
     "  sort them, and give one value for each"},
    {"FileOfThreeColumns", "motions:\n  steer: {table: {file: three.csv}}\n",
     "scene.yaml:8:25: motions.steer.table.file: error: the table has 3 columns (got 'three.csv')\n"
     "  name the two that are meant, as in 'columns: [time, angle]'"},
    {"FileInWrongUnit", "motions:\n  steer: {table: {file: unit.csv}}\n",
     "scene.yaml:8:25: motions.steer.table.file: unit.csv:1 (byte 0): error: wrong dimension: time [s] is "
     "wanted, "
     "this is length "
     "[m] (got 'm')\n"
     "  give it in s, or in a unit that converts to it"}};

INSTANTIATE_TEST_SUITE_P(Catalogue, RefusedFunctions, testing::ValuesIn(kRefused),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

}  // namespace
}  // namespace wishbone

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "models/broken_text.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr std::string_view kGoodScene = R"(wishbone: 1
parameters:
  form: {default: modal, choices: [rigid, modal]}
  width: 0.1 m
bodies:
  arm:
    mass: 2 kg
    inertia: [0.1, 0.2, 0.2]
    position: [1, 0, 0]
  wheel: {mass: 1, inertia: [1, 1, 1], position: [2, 0, 0]}
  beam:
    form: = form
    mass: {select: form, modal: 1, rigid: 2}
    inertia: [1, 1, 1]
    position: [0.5, 5.05, 0.05]
    flexible:
      block: {size: [1, 0.1, 0.1], elements: [2, 1, 1]}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes: all
      damping: 1 %
joints:
  pivot: {type: revolute, bodies: [ground, arm], at: [0, 0, 0], axis: [0, 0, 1], motion: turn}
  slide: {type: prismatic, bodies: [arm, wheel], at: [2, 0, 0], axis: [1, 0, 0], speed: 1 m/s, cut: false}
  hold: {type: spherical, bodies: [ground, {body: beam, node: 1}]}
springs:
  coil: {from: {body: arm}, to: {body: wheel}, stiffness: 2 kN/m, damping: 5, free_length: 1 m}
loads:
  push: {body: wheel, force: [0, 0, 10 N], axes: body}
tire_models:
  ua:
    radius: 0.3
    vertical_stiffness: 200 kN/m
    damping_ratio: 0.02
    mass: = 10 * width
    slip_stiffness: 80 kN
    cornering_stiffness: 73.6 kN/rad
    camber_stiffness: 8 kN/rad
    rolling_resistance: 3 mm
    friction_max: 1
    friction_min: 0.8
    lag: false
tires:
  tire: {wheel: wheel, model: ua}
road: {}
motions:
  turn: {steps: [{time: 0, duration: 0.1, change: 5 deg}], ackermann: {wheelbase: 2, track: 1, side: left}}
vehicle: {chassis: arm, steering: {front: pivot}}
analysis: {duration: 2 s, integrator: bdf, rtol: 1e-6}
output: {interval: 5 ms, nodes: {beam: [1, 12]}}
)";

class BrokenScenes : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScenes, AreRefusedWithPlaceValueAndRemedy) {
  std::string scene(kGoodScene);
  const auto at = scene.find(GetParam().text);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(scene.find(GetParam().text, at + 1), std::string::npos);
  scene.replace(at, GetParam().text.size(), GetParam().replacement);

  const TextFiles files;
  const auto file = files.write("scene.yaml", scene);
  EXPECT_EQ(files.relative(message_of<InputError>([&] { load_scene(file); })), GetParam().message);
}

constexpr Broken kBrokenScenes[] = {
    Broken{"MisspeltKey", "mass: 2 kg", "mas: 2 kg",
           "scene.yaml:7:5: bodies.arm: error: unknown key 'mas'\n"
           "  did you mean 'mass'?"},
    Broken{"MisspeltSection", "springs:", "sprngs:",
           "scene.yaml:25:1: error: unknown key 'sprngs'\n"
           "  did you mean 'springs'?"},
    Broken{"DuplicateKey", "    mass: 2 kg\n", "    mass: 2 kg\n    mass: 3 kg\n",
           "scene.yaml:8:5: error: the key 'mass' is given twice, first in line 7\n"
           "  keep one of the two"},
    Broken{"DuplicateName", "  wheel: {mass", "  arm: {mass",
           "scene.yaml:10:3: error: the key 'arm' is given twice, first in line 6\n"
           "  keep one of the two"},
    Broken{"MissingVersion", "wishbone: 1\n", "",
           "scene.yaml: error: the key 'wishbone' is missing\n"
           "  add 'wishbone: ...' here"},
    Broken{"UnknownVersion", "wishbone: 1\n", "wishbone: 2\n",
           "scene.yaml:1:11: wishbone: error: this format version is not known (got '2')\n"
           "  write 'wishbone: 1', or use a newer wishbone"},
    Broken{"KeyWithoutValue", "mass: 2 kg", "mass:",
           "scene.yaml:7:5: bodies.arm.mass: error: the key has no value\n"
           "  write one after the ':' or remove the key"},
    Broken{"ListInsteadOfMapping", "road: {}", "road: []",
           "scene.yaml:44:1: road: error: a mapping is wanted here\n"
           "  write its keys: bank, depression"},
    Broken{
        "BodyOfOneNumber", "{mass: 1, inertia: [1, 1, 1], position: [2, 0, 0]}", "5",
        "scene.yaml:10:10: bodies.wheel: error: a mapping is wanted here (got '5')\n"
        "  write its keys: mass, inertia, position, orientation, velocity, angular_velocity, form, flexible"},
    Broken{"GravityAsForce", "road: {}", "road: {}\ngravity: [0, 0, 9.81 N]",
           "scene.yaml:45:17: gravity[3]: error: wrong dimension: acceleration [m/s2] is wanted, this is "
           "force [N] (got '9.81 N')\n"
           "  give it in m/s2, or in a unit that converts to it"},
    Broken{"PlacementAboutNothing", "road: {}", "road: {}\nplacement: {axis: [0, 0, 0], angle: 5 deg}",
           "scene.yaml:45:13: placement.axis: error: the direction has zero length\n"
           "  give at least one component that is not zero"},
    Broken{"MassOfInertia", "inertia: [0.1, 0.2, 0.2]", "inertia: [0.1 kg, 0.2, 0.2]",
           "scene.yaml:8:15: bodies.arm.inertia[1]: error: wrong dimension: moment of inertia [kg m2] is "
           "wanted, this is mass [kg] (got '0.1 kg')\n"
           "  give it in kg m2, or in a unit that converts to it"},
    Broken{"BadName", "  wheel: {mass", "  2nd/wheel: {mass",
           "scene.yaml:10:3: bodies.2nd/wheel: error: not a name (got '2nd/wheel')\n"
           "  use up to 64 letters, digits, '_' and '-', beginning with a letter"},
    Broken{"BodyNamedGround", "  wheel: {mass", "  ground: {mass",
           "scene.yaml:10:3: bodies.ground: error: 'ground' is the name of the inertial frame\n"
           "  give the body another name"},
    Broken{"WrongUnit", "mass: 2 kg", "mass: 2 kgs",
           "scene.yaml:7:11: bodies.arm.mass: error: unknown unit 'kgs' (got '2 kgs')\n"
           "  write units as in 120 km/h, 47 kN/m, 4 kN s/m, 2 kg m2, 6 deg, 5 ms or 5 %; a plain number is "
           "in SI units"},
    Broken{"WrongDimension", "stiffness: 2 kN/m", "stiffness: 0.3 m",
           "scene.yaml:26:59: springs.coil.stiffness: error: wrong dimension: stiffness [N/m] is wanted, "
           "this is length [m] (got '0.3 m')\n"
           "  give it in N/m, or in a unit that converts to it"},
    Broken{"AngleAsLength", "position: [1, 0, 0]", "position: [1, 5 deg, 0]",
           "scene.yaml:9:19: bodies.arm.position[2]: error: wrong dimension: length [m] is wanted, this is "
           "angle [rad] (got '5 deg')\n"
           "  give it in m, or in a unit that converts to it"},
    Broken{"NotANumber", "mass: 2 kg", "mass: heavy",
           "scene.yaml:7:11: bodies.arm.mass: error: not a finite number (got 'heavy')\n"
           "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"},
    Broken{"Nan", "mass: 2 kg", "mass: .nan",
           "scene.yaml:7:11: bodies.arm.mass: error: not a finite number (got '.nan')\n"
           "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"},
    Broken{"Infinity", "position: [1, 0, 0]", "position: [1, .inf, 0]",
           "scene.yaml:9:19: bodies.arm.position[2]: error: not a finite number (got '.inf')\n"
           "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"},
    Broken{"Overflow", "mass: 2 kg", "mass: 1e999",
           "scene.yaml:7:11: bodies.arm.mass: error: the number does not fit a double (got '1e999')\n"
           "  magnitudes from 2.3e-308 to 1.7e308, and 0, can be held"},
    Broken{"DecimalComma", "mass: 2 kg", "mass: 2,5",
           "scene.yaml:7:11: bodies.arm.mass: error: unknown unit ',5' (got '2,5')\n"
           "  write units as in 120 km/h, 47 kN/m, 4 kN s/m, 2 kg m2, 6 deg, 5 ms or 5 %; a plain number is "
           "in SI units"},
    Broken{"TwoComponents", "position: [1, 0, 0]", "position: [1, 0]",
           "scene.yaml:9:5: bodies.arm.position: error: a list of three numbers (length [m]) is wanted here, "
           "not of 2\n"
           "  write [x, y, z]"},
    Broken{"NumberForVector", "position: [1, 0, 0]", "position: 1",
           "scene.yaml:9:15: bodies.arm.position: error: a list of three numbers (length [m]) is wanted "
           "here, not a single value (got '1')\n"
           "  write [x, y, z]"},
    Broken{"YesForTrue", "cut: false", "cut: no",
           "scene.yaml:23:101: joints.slide.cut: error: true or false is wanted here (got 'no')\n"
           "  write true or false"},
    Broken{"NegativeMass", "mass: 2 kg", "mass: -2 kg",
           "scene.yaml:7:11: bodies.arm.mass: error: the mass must be positive (got '-2 kg')\n"
           "  give a value above zero"},
    Broken{"ZeroMass", "mass: 2 kg", "mass: 0",
           "scene.yaml:7:11: bodies.arm.mass: error: the mass must be positive (got '0')\n"
           "  give a value above zero"},
    Broken{"MassMissing", "    mass: 2 kg\n", "",
           "scene.yaml:6:3: bodies.arm: error: the key 'mass' is missing\n"
           "  add 'mass: ...' here"},
    Broken{"InertiaOfNoBody", "inertia: [0.1, 0.2, 0.2]", "inertia: [0.1, 0.2, 0.4]",
           "scene.yaml:8:5: bodies.arm.inertia: error: no body can have this inertia: its principal values "
           "are 0.1, 0.2, 0.4 kg m2\n"
           "  the largest must not exceed the sum of the two others"},
    Broken{"InertiaNotDefinite", "inertia: [0.1, 0.2, 0.2]", "inertia: [0.1, 0.2, 0.2, 0.3, 0, 0]",
           "scene.yaml:8:5: bodies.arm.inertia: error: the inertia must not be negative: its principal "
           "values are -0.154138, 0.2, 0.454138 kg m2\n"
           "  check the signs of the products of inertia"},
    Broken{"InertiaOfFour", "inertia: [0.1, 0.2, 0.2]", "inertia: [0.1, 0.2, 0.2, 0]",
           "scene.yaml:8:5: bodies.arm.inertia: error: the inertia must have three or six components\n"
           "  write [Jxx, Jyy, Jzz] or [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]"},
    Broken{"OrientationAboutNothing", "position: [1, 0, 0]",
           "position: [1, 0, 0]\n    orientation: {axis: [0, 0, 0], angle: 1 deg}",
           "scene.yaml:10:19: bodies.arm.orientation.axis: error: the direction has zero length\n"
           "  give at least one component that is not zero"},
    Broken{"UnknownForm", "form: = form", "form: modl",
           "scene.yaml:12:11: bodies.beam.form: error: not one of the forms of a body (got 'modl')\n"
           "  did you mean 'modal'?"},
    Broken{"NodalWithoutBlock", "mass: 2 kg", "mass: 2 kg\n    form: nodal",
           "scene.yaml:6:3: bodies.arm: error: a nodal body needs the key 'flexible'\n"
           "  add 'flexible: {block: ..., material: ..., modes: ...}'"},
    Broken{"ModalWithoutBlock", "mass: 2 kg", "mass: 2 kg\n    form: modal",
           "scene.yaml:6:3: bodies.arm: error: a modal body needs the key 'flexible'\n"
           "  add 'flexible: {block: ..., material: ..., modes: ...}'"},
    Broken{
        "FlatBlock", "size: [1, 0.1, 0.1]", "size: [1, 0, 0.1]",
        "scene.yaml:17:15: bodies.beam.flexible.block.size: error: the edges of the block must be positive\n"
        "  give three lengths above zero"},
    Broken{"NoElements", "elements: [2, 1, 1]", "elements: [0, 1, 1]",
           "scene.yaml:17:47: bodies.beam.flexible.block.elements[1]: error: a whole number from 1 to 100 is "
           "wanted here (got '0')\n"
           "  give one of them"},
    Broken{"FluidMaterial", "poisson: 0.3", "poisson: 0.5",
           "scene.yaml:18:43: bodies.beam.flexible.material.poisson: error: Poisson's ratio must be between "
           "-1 and 0.5 (got '0.5')\n"
           "  metals have 0.3"},
    Broken{"TooManyModes", "modes: all", "modes: 31",
           "scene.yaml:19:14: bodies.beam.flexible.modes: error: a whole number from 1 to 30 is wanted here "
           "(got '31')\n"
           "  give one of them"},
    Broken{"MisspeltModes", "modes: all", "modes: automatik",
           "scene.yaml:19:14: bodies.beam.flexible.modes: error: not one of the choices of modes (got "
           "'automatik')\n"
           "  did you mean 'automatic'?"},
    Broken{"ModesChosenTwice", "modes: all", "modes: {lowest: 3, below: 50 Hz}",
           "scene.yaml:19:7: bodies.beam.flexible.modes: error: one of 'lowest', 'below' and 'list' chooses "
           "the "
           "modes\n"
           "  remove the others"},
    Broken{"ModeListedTwice", "modes: all", "modes: {list: [3, 1, 3]}",
           "scene.yaml:19:15: bodies.beam.flexible.modes.list: error: a mode is listed twice\n"
           "  list each mode once"},
    Broken{"ListOfNoModes", "modes: all", "modes: {list: []}",
           "scene.yaml:19:15: bodies.beam.flexible.modes.list: error: there are no modes in the list\n"
           "  write 'modes: none' for a rigid body"},
    Broken{"LimitAsAngularVelocity", "modes: all", "modes: {below: 50 rad/s}",
           "scene.yaml:19:22: bodies.beam.flexible.modes.below: error: wrong dimension: frequency [Hz] is "
           "wanted, "
           "this is angular velocity [rad/s] (got '50 rad/s')\n"
           "  give it in Hz, or in a unit that converts to it"},
    Broken{"NoModesOfHeldInterfaces", "modes: all", "modes: {fixed_interface: 0}",
           "scene.yaml:19:32: bodies.beam.flexible.modes.fixed_interface: error: a whole number from 1 to 30 "
           "is wanted here (got '0')\n"
           "  give one of them"},
    Broken{"FreeModesAndModesOfHeldInterfaces", "modes: all", "modes: {fixed_interface: 2, lowest: 3}",
           "scene.yaml:19:35: bodies.beam.flexible.modes: error: unknown key 'lowest'\n"
           "  the keys here are: fixed_interface"},
    Broken{"AutomaticWithoutLimit", "modes: all", "modes: automatic",
           "scene.yaml:16:5: bodies.beam.flexible: error: the key 'below' is missing\n"
           "  add 'below: ...' here"},
    Broken{"AutomaticWithItsOwnNodes", "modes: all",
           "modes: automatic\n      below: 50 Hz\n      attachment: [1]",
           "scene.yaml:21:7: bodies.beam.flexible.attachment: error: 'modes: automatic' takes the attachment "
           "modes "
           "of every interface already\n"
           "  remove the key"},
    Broken{
        "LimitWithoutAutomatic", "modes: all", "modes: all\n      below: 50 Hz",
        "scene.yaml:20:14: bodies.beam.flexible.below: error: 'below' belongs to 'modes: automatic' (got '50 "
        "Hz')\n"
        "  write 'modes: {below: ...}' for normal modes alone"},
    Broken{"AttachmentToNowhere", "modes: all", "modes: all\n      attachment: everywhere",
           "scene.yaml:20:19: bodies.beam.flexible.attachment: error: the nodes are neither 'interfaces' nor "
           "a list "
           "(got 'everywhere')\n"
           "  write 'interfaces', or [1, 2, 3]"},
    Broken{
        "AttachmentToNoSuchNode", "modes: all", "modes: all\n      attachment: [1, 13]",
        "scene.yaml:20:23: bodies.beam.flexible.attachment[2]: error: the body has no such node (got '13')\n"
        "  its nodes are 1 to 12"},
    Broken{"ConstraintNamedTwice", "modes: all", "modes: all\n      constraint: [1, 2, 1]",
           "scene.yaml:20:26: bodies.beam.flexible.constraint[3]: error: a node is listed twice (got '1')\n"
           "  list each node once"},
    Broken{"AttachmentOfARigidBody", "modes: all", "modes: none\n      attachment: interfaces",
           "scene.yaml:20:19: bodies.beam.flexible.attachment: error: a body without modes is rigid (got "
           "'interfaces')\n"
           "  remove the key, or choose modes"},
    Broken{"AttachmentOfIdentifiedModes", "modes: all",
           "modes: {measured: {from: model}}\n      attachment: interfaces",
           "scene.yaml:20:19: bodies.beam.flexible.attachment: error: static shapes need the stiffness of a "
           "model, "
           "and identified modes do not tell it (got 'interfaces')\n"
           "  remove the key, or choose modes of a block or model"},
    Broken{"BlockAndModel", "modes: all", "modes: all\n      model: {nodes: nodes.csv, stiffness: K.mtx}",
           "scene.yaml:20:7: bodies.beam.flexible.model: error: the nodes come either from a block or from a "
           "model\n"
           "  remove one of the two"},
    Broken{"DampingOfOtherLength", "damping: 1 %", "damping: [1 %, 2 %]",
           "scene.yaml:20:7: bodies.beam.flexible.damping: error: there are 2 damping ratios for 30 modes\n"
           "  give one ratio for all modes, or one per mode"},
    Broken{
        "NegativeDamping", "damping: 1 %", "damping: -1 %",
        "scene.yaml:20:16: bodies.beam.flexible.damping: error: the ratio must not be negative (got '-1 %')\n"
        "  give zero or a value above it"},
    Broken{"DampingOfNothing", "damping: 1 %", "damping: {}",
           "scene.yaml:20:7: bodies.beam.flexible.damping: error: damping in proportion to mass and "
           "stiffness needs one of the two\n"
           "  write {mass: ... 1/s, stiffness: ... s}, or a damping ratio"},
    Broken{"NegativeMassDamping", "damping: 1 %", "damping: {mass: -1}",
           "scene.yaml:20:23: bodies.beam.flexible.damping.mass: error: the rate must not be negative (got "
           "'-1')\n"
           "  give zero or a value above it"},
    Broken{"StiffnessDampingAsAStiffness", "damping: 1 %", "damping: {stiffness: 2 kN/m}",
           "scene.yaml:20:28: bodies.beam.flexible.damping.stiffness: error: wrong dimension: time [s] is "
           "wanted, this is stiffness [N/m] (got '2 kN/m')\n"
           "  give it in s, or in a unit that converts to it"},
    Broken{"UnknownProportionOfDamping", "damping: 1 %", "damping: {mass: 1, stifness: 1 ms}",
           "scene.yaml:20:26: bodies.beam.flexible.damping: error: unknown key 'stifness'\n"
           "  did you mean 'stiffness'?"},
    Broken{"UnknownJointType", "type: revolute", "type: hinge",
           "scene.yaml:22:17: joints.pivot.type: error: not one of the joint types (got 'hinge')\n"
           "  the joint types are: fixed, revolute, prismatic, cylindrical, screw, universal, "
           "constant_velocity, spherical, planar, free"},
    Broken{"MissingBody", "bodies: [ground, arm]", "bodies: [ground, amr]",
           "scene.yaml:22:44: joints.pivot.bodies[2]: error: there is no 'amr' among the bodies\n"
           "  did you mean 'arm'?"},
    Broken{"ThreeBodies", "bodies: [ground, arm]", "bodies: [ground, arm, wheel]",
           "scene.yaml:22:27: joints.pivot.bodies: error: a joint joins two bodies\n"
           "  write [parent, child]"},
    Broken{"JointToItself", "bodies: [ground, arm]", "bodies: [arm, arm]",
           "scene.yaml:22:27: joints.pivot.bodies: error: the joint joins a body to itself\n"
           "  name two bodies"},
    Broken{"ZeroLengthAxis", "axis: [0, 0, 1]", "axis: [0, 0, 0]",
           "scene.yaml:22:65: joints.pivot.axis: error: the direction has zero length\n"
           "  give at least one component that is not zero"},
    Broken{"AxisMissing", ", axis: [0, 0, 1]", "",
           "scene.yaml:22:3: joints.pivot: error: the key 'axis' is missing\n"
           "  add 'axis: ...' here"},
    Broken{"AtMissing", "at: [0, 0, 0], ", "",
           "scene.yaml:22:3: joints.pivot: error: the key 'at' is missing\n"
           "  add 'at: ...' here"},
    Broken{"AxisOfSpherical", "type: spherical", "type: spherical, axis: [0, 0, 1]",
           "scene.yaml:24:27: joints.hold.axis: error: a spherical joint has no such axis\n"
           "  remove 'axis'"},
    Broken{
        "SteeringByCutJoint", "motion: turn", "motion: turn, cut: true",
        "scene.yaml:47:43: vehicle.steering.front: error: a steering angle is the coordinate of a revolute "
        "tree joint (got 'pivot')\n"
        "  name such a joint"},
    Broken{"MotionAndSpeed", "motion: turn", "motion: turn, speed: 1",
           "scene.yaml:22:103: joints.pivot.speed: error: the motion prescribes the coordinate (got '1')\n"
           "  remove 'speed'"},
    Broken{"UnknownMotion", "motion: turn", "motion: trun",
           "scene.yaml:22:90: joints.pivot.motion: error: there is no 'trun' among the motions\n"
           "  did you mean 'turn'?"},
    Broken{"SpeedInWrongUnit", "speed: 1 m/s", "speed: 1 rad/s",
           "scene.yaml:23:89: joints.slide.speed: error: wrong dimension: velocity [m/s] is wanted, this is "
           "angular velocity [rad/s] (got '1 rad/s')\n"
           "  give it in m/s, or in a unit that converts to it"},
    Broken{"PinnedLoop", "  slide: {type: prismatic, bodies: [arm, wheel]",
           "  weld: {type: fixed, bodies: [ground, wheel], at: [0, 0, 0], cut: false}\n"
           "  brace: {type: fixed, bodies: [ground, arm], at: [0, 0, 0], cut: false}\n"
           "  slide: {type: prismatic, bodies: [arm, wheel]",
           "scene.yaml:25:3: joints.slide: error: not all joints with 'cut: false' fit into one tree: slide\n"
           "  leave one joint of each loop to be cut ('cut: true', or no 'cut')"},
    Broken{
        "NodeOutOfRange", "{body: beam, node: 1}", "{body: beam, node: 13}",
        "scene.yaml:24:63: joints.hold.bodies[2].node: error: the body 'beam' has no such node (got '13')\n"
        "  its nodes are 1 to 12"},
    Broken{"NodeZero", "{body: beam, node: 1}", "{body: beam, node: 0}",
           "scene.yaml:24:63: joints.hold.bodies[2].node: error: the body 'beam' has no such node (got '0')\n"
           "  its nodes are 1 to 12"},
    Broken{"NodeOfBodyWithoutNodes", "{body: beam, node: 1}", "{body: arm, node: 1}",
           "scene.yaml:24:62: joints.hold.bodies[2].node: error: the body 'arm' has no nodes (got '1')\n"
           "  name a position with 'at', or give the body a 'flexible' block"},
    Broken{
        "NodeElsewhere", "type: spherical,", "type: spherical, at: [0, 5.1, 0],",
        "scene.yaml:24:61: joints.hold.bodies[2]: error: the node is at [0, 5, 0], the joint at [0, 5.1, 0]\n"
        "  name another node, or correct or remove 'at'"},
    Broken{"FlexibleHeldBesideItsNodes", "{body: beam, node: 1}]", "beam], at: [0, 5, 0]",
           "scene.yaml:24:44: joints.hold.bodies[2]: error: the flexible body 'beam' can be held at its "
           "nodes and frames only (got 'beam')\n"
           "  write {body: beam, node: ...} or {body: beam, frame: ...}"},
    Broken{"FlexibleHeldByRevolute", "type: spherical,", "type: revolute, axis: [0, 0, 1],",
           "scene.yaml:24:60: joints.hold.bodies[2]: error: a node of a flexible body can only be held by a "
           "spherical joint\n"
           "  use 'type: spherical', or hold a frame over several nodes"},
    Broken{"FreeJointAtNode", "type: spherical,", "type: free,",
           "scene.yaml:24:39: joints.hold.bodies[2]: error: a free joint joins whole bodies\n"
           "  name the body without a node or frame"},
    Broken{
        "FrameWithAnUnknownNode", "damping: 1 %", "damping: 1 %\n      frames: {tip: {nodes: [9, 10, 13]}}",
        "scene.yaml:21:37: bodies.beam.flexible.frames.tip.nodes[3]: error: the body has no such node (got "
        "'13')\n"
        "  its nodes are 1 to 12"},
    Broken{"FrameOverTwoNodes", "damping: 1 %", "damping: 1 %\n      frames: {tip: {nodes: [9, 10]}}",
           "scene.yaml:21:22: bodies.beam.flexible.frames.tip.nodes: frame 'tip': error: a frame needs at "
           "least three nodes (got 2)\n"
           "  name more nodes, or hold the body at a node"},
    Broken{
        "FrameOverALine", "damping: 1 %", "damping: 1 %\n      frames: {tip: {nodes: [9, 1, 5]}}",
        "scene.yaml:21:22: bodies.beam.flexible.frames.tip.nodes: frame 'tip': error: the nodes of a frame "
        "must not lie on one line (got nodes 9, 1, 5)\n"
        "  add a node beside the line, or the frame could not follow turns about it"},
    Broken{
        "FrameWithANodeTwice", "damping: 1 %", "damping: 1 %\n      frames: {tip: {nodes: [9, 10, 9]}}",
        "scene.yaml:21:37: bodies.beam.flexible.frames.tip.nodes[3]: error: the frame has this node already "
        "(got '9')\n"
        "  name each node once; weights let some count more"},
    Broken{
        "FrameWithTooFewWeights", "damping: 1 %",
        "damping: 1 %\n      frames: {tip: {nodes: [9, 10, 11], weights: [1, 2]}}",
        "scene.yaml:21:42: bodies.beam.flexible.frames.tip.weights: error: there are 2 weights for 3 nodes\n"
        "  give one weight per node, or leave them out for equal ones"},
    Broken{"FrameWithAWeightOfZero", "damping: 1 %",
           "damping: 1 %\n      frames: {tip: {nodes: [9, 10, 11], weights: [1, 0, 1]}}",
           "scene.yaml:21:55: bodies.beam.flexible.frames.tip.weights[2]: error: the ratio must be positive "
           "(got '0')\n"
           "  give a value above zero"},
    Broken{
        "FrameThatIsPerhapsRigid", "damping: 1 %",
        "damping: 1 %\n      frames: {tip: {nodes: [9, 10, 11], rigid: perhaps}}",
        "scene.yaml:21:49: bodies.beam.flexible.frames.tip.rigid: error: true or false is wanted here (got "
        "'perhaps')\n"
        "  write true or false"},
    Broken{"FrameWithoutNodes", "damping: 1 %", "damping: 1 %\n      frames: {tip: {}}",
           "scene.yaml:21:16: bodies.beam.flexible.frames.tip: error: the key 'nodes' is missing\n"
           "  add 'nodes: ...' here"},
    Broken{"UnknownFrame", "      damping: 1 %\njoints:\n",
           "      damping: 1 %\n      frames: {tip: {nodes: [9, 10, 11]}}\njoints:\n"
           "  grip: {type: revolute, bodies: [ground, {body: beam, frame: top}], axis: [0, 0, 1]}\n",
           "scene.yaml:23:63: joints.grip.bodies[2].frame: error: there is no 'top' among the frames of "
           "'beam'\n"
           "  did you mean 'tip'?"},
    Broken{"FrameOfABodyWithoutFrames", "{body: beam, node: 1}", "{body: beam, frame: tip}",
           "scene.yaml:24:64: joints.hold.bodies[2].frame: error: the body 'beam' has no frames (got 'tip')\n"
           "  describe it under 'frames' of its 'flexible'"},
    Broken{"JointAtNodeAndFrame", "{body: beam, node: 1}", "{body: beam, node: 1, frame: tip}",
           "scene.yaml:24:44: joints.hold.bodies[2]: error: the joint is given a node and a frame\n"
           "  remove one of them"},
    Broken{"FreeJointOnAFrame", "      damping: 1 %\njoints:\n",
           "      damping: 1 %\n      frames: {tip: {nodes: [9, 10, 11]}}\njoints:\n"
           "  grip: {type: free, bodies: [ground, {body: beam, frame: tip}]}\n",
           "scene.yaml:23:39: joints.grip.bodies[2]: error: a free joint joins whole bodies\n"
           "  name the body without a node or frame"},
    Broken{"SpringOnOneBody", "to: {body: wheel}", "to: {body: arm, at: [1, 1, 0]}",
           "scene.yaml:26:3: springs.coil: error: the spring joins a body to itself\n"
           "  name two bodies"},
    Broken{"SpringEndTwice", "to: {body: wheel}", "to: {body: beam, node: 1, at: [0, 0, 0]}",
           "scene.yaml:26:29: springs.coil.to: error: the point is named twice, by 'at' and by 'node'\n"
           "  remove one of them"},
    Broken{"SpringOnGroundAndBody", "to: {body: wheel}", "to: {ground: [0, 0, 0], body: wheel}",
           "scene.yaml:26:29: springs.coil.to: error: a point is on the ground or on a body\n"
           "  write {ground: [x, y, z]} or {body: ..., at: [x, y, z]}"},
    Broken{"SpringBesideTheNodes", "to: {body: wheel}", "to: {body: beam, at: [0, 5, 0]}",
           "scene.yaml:26:29: springs.coil.to: error: the flexible body 'beam' can be held at its nodes and "
           "frames only\n"
           "  name one with 'node' or 'frame'"},
    Broken{"SpringAtNodeAndFrame", "to: {body: wheel}", "to: {body: beam, node: 1, frame: tip}",
           "scene.yaml:26:29: springs.coil.to: error: the point is named twice, by 'frame' and by 'node'\n"
           "  remove one of them"},
    Broken{"NegativeStiffness", "stiffness: 2 kN/m", "stiffness: -2 kN/m",
           "scene.yaml:26:59: springs.coil.stiffness: error: the stiffness must not be negative (got '-2 "
           "kN/m')\n"
           "  give zero or a value above it"},
    Broken{"NegativeFreeLength", "free_length: 1 m", "free_length: -1 m",
           "scene.yaml:26:92: springs.coil.free_length: error: the length must not be negative (got '-1 m')\n"
           "  give zero or a value above it"},
    Broken{"EmptyLoad", ", force: [0, 0, 10 N]", "",
           "scene.yaml:28:3: loads.push: error: the load is empty\n"
           "  give 'force' or 'moment'"},
    Broken{"LoadInOddAxes", "axes: body", "axes: wheel",
           "scene.yaml:28:50: loads.push.axes: error: not one of the axes of a load (got 'wheel')\n"
           "  the axes of a load are: inertial, body"},
    Broken{"FrictionUpsideDown", "friction_min: 0.8", "friction_min: 1.2",
           "scene.yaml:40:19: tire_models.ua.friction_min: error: the friction at full slip exceeds that at "
           "zero slip (got '1.2')\n"
           "  give at most friction_max = 1"},
    Broken{"LagWithoutLength", "lag: false", "lag: true",
           "scene.yaml:30:3: tire_models.ua: error: the key 'relaxation_longitudinal' is missing\n"
           "  add 'relaxation_longitudinal: ...' here"},
    Broken{"TireModelMissing", "model: ua", "model: au",
           "scene.yaml:43:31: tires.tire.model: error: there is no 'au' among the tire models\n"
           "  did you mean 'ua'?"},
    Broken{"WheelMissing", "{wheel: wheel,", "{wheel: whel,",
           "scene.yaml:43:17: tires.tire.wheel: error: there is no 'whel' among the bodies\n"
           "  did you mean 'wheel'?"},
    Broken{"FlexibleWheel", "{wheel: wheel,", "{wheel: beam,",
           "scene.yaml:43:17: tires.tire.wheel: error: a wheel must be a rigid body (got 'beam')\n"
           "  use 'form: rigid'"},
    Broken{
        "TwoTiresOnAWheel", "  tire: {wheel: wheel, model: ua}",
        "  tire: {wheel: wheel, model: ua}\n  spare: {wheel: wheel, model: ua}",
        "scene.yaml:44:18: tires.spare.wheel: error: the tire 'tire' is on this wheel already (got 'wheel')\n"
        "  name another wheel"},
    Broken{"TireWithoutRoad", "road: {}\n", "",
           "scene.yaml:43:3: tires.tire: error: a tire needs a road\n"
           "  add the section 'road', for a flat one as 'road: {}'"},
    Broken{"VerticalRoad", "road: {}", "road: {bank: 90 deg}",
           "scene.yaml:44:14: road.bank: error: the bank is too steep for a road (got '90 deg')\n"
           "  give an angle within 85 deg"},
    Broken{"DepressionOfNoLength", "road: {}", "road: {depression: {start: 1, length: 0, depth: 3 cm}}",
           "scene.yaml:44:39: road.depression.length: error: the length must be positive (got '0')\n"
           "  give a value above zero"},
    Broken{"StepOfNoDuration", "duration: 0.1, change", "duration: 0, change",
           "scene.yaml:46:38: motions.turn.steps[1].duration: error: the time must be positive (got '0')\n"
           "  give a value above zero"},
    Broken{"StepInLengths", "change: 5 deg", "change: 5 mm",
           "scene.yaml:46:51: motions.turn.steps[1].change: error: wrong dimension: angle [rad] is wanted, "
           "this is length [m] (got '5 mm')\n"
           "  give it in rad, or in a unit that converts to it"},
    Broken{"MotionForAngleAndLength", "speed: 1 m/s", "motion: turn",
           "scene.yaml:46:3: motions.turn: error: an angle and a length follow the same motion\n"
           "  write one motion for each"},
    Broken{"AckermannSide", "side: left", "side: middle",
           "scene.yaml:46:102: motions.turn.ackermann.side: error: not one of the sides (got 'middle')\n"
           "  the sides are: left, right"},
    Broken{"ChassisMissing", "chassis: arm", "chassis: chassis",
           "scene.yaml:47:20: vehicle.chassis: error: there is no 'chassis' among the bodies\n"
           "  the bodies are: arm, wheel, beam"},
    Broken{"SteeringBySlide", "{front: pivot}", "{front: slide}",
           "scene.yaml:47:43: vehicle.steering.front: error: a steering angle is the coordinate of a "
           "revolute tree joint (got 'slide')\n"
           "  name such a joint"},
    Broken{"NegativeDuration", "duration: 2 s", "duration: -2 s",
           "scene.yaml:48:22: analysis.duration: error: the time must be positive (got '-2 s')\n"
           "  give a value above zero"},
    Broken{"UnknownIntegrator", "integrator: bdf", "integrator: rk4",
           "scene.yaml:48:39: analysis.integrator: error: not one of the integrators (got 'rk4')\n"
           "  the integrators are: auto, adams, bdf, erk"},
    Broken{"CoarseTolerance", "rtol: 1e-6", "rtol: 0.5",
           "scene.yaml:48:50: analysis.rtol: error: the relative tolerance is too coarse to mean anything "
           "(got '0.5')\n"
           "  give at most 0.1; 1e-6 is usual"},
    Broken{"ZeroTolerance", "rtol: 1e-6", "rtol: 0",
           "scene.yaml:48:50: analysis.rtol: error: the ratio must be positive (got '0')\n"
           "  give a value above zero"},
    Broken{
        "IntervalLongerThanRun", "interval: 5 ms", "interval: 5 s",
        "scene.yaml:49:20: output.interval: error: the interval is longer than the run of 2 s (got '5 s')\n"
        "  give a shorter one"},
    Broken{"IntervalZero", "interval: 5 ms", "interval: 0 ms",
           "scene.yaml:49:20: output.interval: error: the time must be positive (got '0 ms')\n"
           "  give a value above zero"},
    Broken{"IntervalMinute", "interval: 5 ms", "interval: 1e-9 s",
           "scene.yaml:49:20: output.interval: error: the run would have more than ten million outputs (got "
           "'1e-9 s')\n"
           "  give a longer interval"},
    Broken{"OutputOfMissingNode", "{beam: [1, 12]}", "{beam: [1, 13]}",
           "scene.yaml:49:44: output.nodes.beam[2]: error: the body 'beam' has no such node (got '13')\n"
           "  its nodes are 1 to 12"},
    Broken{"OutputOfMissingBody", "{beam: [1, 12]}", "{bean: [1, 12]}",
           "scene.yaml:49:34: output.nodes.bean: error: there is no 'bean' among the bodies\n"
           "  did you mean 'beam'?"},
    Broken{"ParameterNotDefined", "form: = form", "form: = from",
           "scene.yaml:12:11: bodies.beam.form: error: there is no parameter 'from'\n"
           "  did you mean 'form'?"},
    Broken{"ParameterUnitWrong", "width: 0.1 m", "width: 0.1 meter per",
           "scene.yaml:4:10: parameters.width: error: unknown unit 'meter per' (got '0.1 meter per')\n"
           "  write units as in 120 km/h, 47 kN/m, 4 kN s/m, 2 kg m2, 6 deg, 5 ms or 5 %; a plain number is "
           "in SI units"},
    Broken{"ParameterBadChoice", "default: modal", "default: model",
           "scene.yaml:3:19: parameters.form: error: not a choice of the parameter 'form' (got 'model')\n"
           "  did you mean 'modal'?"},
    Broken{"ExpressionBroken", "= 10 * width", "= 10 * (width",
           "scene.yaml:34:11: tire_models.ua.mass: error: the expression cannot be read at character 6, "
           "'(width': this '(' is not closed (got '10 * (width')\n"
           "  add the ')'"},
    Broken{"ExpressionInfinite", "= 10 * width", "= 1 / (width - width)",
           "scene.yaml:34:11: tire_models.ua.mass: error: the value of the expression is not finite (got '= "
           "1 / (width - width)')\n"
           "  look for a division by zero or a root of a negative number"},
    Broken{
        "ExpressionDimensionless", "position: [2, 0, 0]", "position: [= width, = form, 0]",
        "scene.yaml:10:60: bodies.wheel.position[2]: error: not a finite number (got 'modal' from '= form')\n"
        "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"},
    Broken{"BranchMissing", "{select: form, modal: 1, rigid: 2}", "{select: form, rigid: 2}",
           "scene.yaml:13:20: bodies.beam.mass.select: error: there is no branch for 'modal', the value of "
           "the parameter (got 'form')\n"
           "  the branches are: rigid; add one for 'modal'"},
    Broken{"PiAsParameter", "width: 0.1 m", "pi: 3\n  width: 0.1 m",
           "scene.yaml:4:7: parameters.pi: error: 'pi' is a constant, not a parameter\n"
           "  use another name"}};

INSTANTIATE_TEST_SUITE_P(Catalogue, BrokenScenes, testing::ValuesIn(kBrokenScenes),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(GoodScene, Loads) {
  const TextFiles files;
  const auto file = files.write("scene.yaml", kGoodScene);
  EXPECT_EQ(load_scene(file).bodies.size(), 3u);
  EXPECT_EQ(load_scene(file, {"form=rigid"}).bodies[2].mass, 2);
}

TEST(SceneWithoutBodies, IsRefused) {
  const TextFiles files;
  const auto file = files.write("scene.yaml", "wishbone: 1\nbodies: {}\n");
  EXPECT_EQ(files.relative(message_of<InputError>([&] { load_scene(file); })),
            "scene.yaml:2:1: bodies: error: there are no bodies\n  describe at least one");
}

// A joint whose frames do not share their centre has no place of its own.
TEST(BrokenScene, JointBetweenFramesApartNeedsAPlace) {
  const TextFiles files;
  const std::string beam =
      "{block: {size: [1, 0.1, 0.1], elements: [1, 1, 1]}, material: {young: 1e9, poisson: 0.3, density: "
      "1000}, "
      "modes: 1, frames: {start: {nodes: [1, 2, 3, 4]}, end: {nodes: [5, 6, 7, 8]}}}";
  const auto file = files.write(
      "scene.yaml", "wishbone: 1\nbodies:\n  a: {form: modal, position: [0, 0, 0], flexible: " + beam +
                        "}\n  b: {form: modal, position: [1.5, 0, 0], flexible: " + beam +
                        "}\njoints:\n  pin: {type: revolute, axis: [0, 0, 1], bodies: "
                        "[{body: a, frame: end}, {body: b, frame: start}]}\n");
  EXPECT_EQ(files.relative(message_of<InputError>([&] { load_scene(file); })),
            "scene.yaml:6:3: joints.pin: error: the frames have their centres at [0.5, 0, 0] and [1, 0, 0]\n"
            "  say where the joint is with 'at'; the frames carry it");
}

}  // namespace
}  // namespace wishbone

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "models/broken_text.h"
#include "models/identification_files.h"

namespace wishbone {
namespace {

class BrokenIdentifications : public testing::TestWithParam<Broken> {};

TEST_P(BrokenIdentifications, AreRefusedWithPlaceValueAndRemedy) {
  std::string text(kGoodIdentification);
  const auto at = text.find(GetParam().text);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().text.size(), GetParam().replacement);
  const IdentificationFiles files;
  const auto file = files.write("frame.yaml", text);
  EXPECT_EQ(files.relative(message_of<InputError>([&] { load_identification(file); })), GetParam().message);
}

constexpr Broken kBrokenIdentifications[] = {
    Broken{"MisspeltKey", "  support:", "  suport:",
           "frame.yaml:7:3: identification: error: unknown key 'suport'\n"
           "  did you mean 'support'?"},
    Broken{"MisspeltSection", "identification:\n", "identifcation:\n",
           "frame.yaml:5:1: error: unknown key 'identifcation'\n"
           "  did you mean 'identification'?"},
    Broken{"NoSection", "identification:\n  measured: {file: test.csv, modes: = modes}\n",
           "identification: free\nignored:\n",
           "frame.yaml:6:1: error: unknown key 'ignored'\n"
           "  the keys here are: wishbone, title, parameters, identification"},
    Broken{"MissingVersion", "wishbone: 1\n", "",
           "frame.yaml: error: the key 'wishbone' is missing\n"
           "  add 'wishbone: ...' here"},
    Broken{"UnknownVersion", "wishbone: 1\n", "wishbone: 2\n",
           "frame.yaml:1:11: wishbone: error: this format version is not known (got '2')\n"
           "  write 'wishbone: 1', or use a newer wishbone"},
    Broken{"NoModes", "  measured: {file: test.csv, modes: = modes}\n", "",
           "frame.yaml:5:1: identification: error: the key 'measured' is missing\n"
           "  add 'measured: ...' here"},
    Broken{"ModesFromTwoPlaces", "{file: test.csv,", "{file: test.csv, from: model,",
           "frame.yaml:6:3: identification.measured: error: modes come either from a file or from the model\n"
           "  write 'file: NAME' or 'from: model'"},
    Broken{"ModesFromNowhere", "{file: test.csv,", "{",
           "frame.yaml:6:3: identification.measured: error: modes come either from a file or from the model\n"
           "  write 'file: NAME' or 'from: model'"},
    Broken{"ModesFromElsewhere", "{file: test.csv,", "{from: memory,",
           "frame.yaml:6:20: identification.measured.from: error: modes can be computed from the model only "
           "(got 'memory')\n"
           "  write 'from: model'"},
    Broken{"ModesFromNoModel",
           "  model:\n    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}\n    material: {young: 210 "
           "MPa, poisson: 0.3, density: 2600}\n",
           "",
           "frame.yaml:31:21: identification.reference.from: error: there is no model to take modes from "
           "(got 'model')\n"
           "  add the section 'model'"},
    Broken{"FileMissing", "file: test.csv", "file: tests.csv",
           "frame.yaml:6:20: identification.measured.file: error: there is no file tests_nodes.csv (got "
           "'tests.csv')\n"
           "  names are relative to the file that they stand in"},
    Broken{"FileOfUnknownFormat", "file: test.csv", "file: notes.txt",
           "frame.yaml:6:20: identification.measured.file: notes.txt: error: no format of modal data has "
           "this extension (got .txt)\n"
           "  the extensions are .h5, .hdf5, .unv, .uff, .csv"},
    Broken{"FileMalformed", "file: test.csv", "file: words.h5",
           "words.h5: error: this is not an HDF5 file\n"
           "  give a file written by wishbone (.h5)"},
    Broken{"MoreModesThanThereAre", "modes: = modes}", "modes: 37}",
           "frame.yaml:6:37: identification.measured.modes: error: a whole number from 1 to 36 is wanted "
           "here (got '37')\n"
           "  give one of them"},
    Broken{"NoModeInTheRange", "modes: = modes}", "modes: {above: 10 MHz}}",
           "frame.yaml:6:30: identification.measured.modes: error: no mode is chosen\n"
           "  there are 36 modes"},
    Broken{"FrequencyAsLength", "modes: = modes}", "modes: {above: 10 m}}",
           "frame.yaml:6:45: identification.measured.modes.above: error: wrong dimension: frequency [Hz] is "
           "wanted, this is length [m] (got '10 m')\n"
           "  give it in Hz, or in a unit that converts to it"},
    Broken{"ModeListedTwice", "modes: = modes}", "modes: [1, 2, 1]}",
           "frame.yaml:6:30: identification.measured.modes: error: a mode is listed twice\n"
           "  list each mode once"},
    Broken{"ModeZero", "modes: = modes}", "modes: [0]}",
           "frame.yaml:6:38: identification.measured.modes[1]: error: a whole number from 1 to 36 is wanted "
           "here (got '0')\n"
           "  give one of them"},
    Broken{"SpringOnUnknownNode", "{node: 3, stiffness: [", "{node: 13, stiffness: [",
           "frame.yaml:10:16: identification.support.springs[2].node: error: the structure has no such node "
           "(got '13')\n"
           "  its nodes are 1 to 12"},
    Broken{"SpringOnUnknownNodeOfAList", "[1, 2, 11, 12]", "[1, 2, 11, 112]",
           "frame.yaml:9:28: identification.support.springs[1].nodes[4]: error: the structure has no such "
           "node (got '112')\n"
           "  its nodes are 1 to 12"},
    Broken{"JointOnUnknownNode", "{node: 9, axes", "{node: 0, axes",
           "frame.yaml:13:16: identification.support.joints[1].node: error: the structure has no such node "
           "(got '0')\n"
           "  its nodes are 1 to 12"},
    Broken{"MassOnUnknownNode", "{node: 5, mass", "{node: 55, mass",
           "frame.yaml:16:16: identification.support.masses[1].node: error: the structure has no such node "
           "(got '55')\n"
           "  its nodes are 1 to 12"},
    Broken{"SpringNowhere", "{node: 3, stiffness: [", "{stiffness: [",
           "frame.yaml:10:9: identification.support.springs[2]: error: either 'node' or 'nodes' says where "
           "it is\n"
           "  write 'node: 3' or 'nodes: [3, 4]'"},
    Broken{"SpringOnNoNodes", "[1, 2, 11, 12]", "[]",
           "frame.yaml:9:10: identification.support.springs[1].nodes: error: there are no nodes in the list\n"
           "  name at least one"},
    Broken{"SpringWithoutStiffness", "{node: 3, stiffness: [0, 0, 2 kN/m]}", "{node: 3}",
           "frame.yaml:10:9: identification.support.springs[2]: error: the key 'stiffness' is missing\n"
           "  add 'stiffness: ...' here"},
    Broken{"NegativeStiffness", "stiffness: 47 kN/m", "stiffness: -47 kN/m",
           "frame.yaml:9:44: identification.support.springs[1].stiffness: error: the stiffness must be "
           "positive (got '-47 kN/m')\n"
           "  give a value above zero"},
    Broken{"StiffnessesAllZero", "[0, 0, 2 kN/m]", "[0, 0, 0]",
           "frame.yaml:10:19: identification.support.springs[2].stiffness: error: the stiffnesses of a "
           "spring must not be negative, nor all zero\n"
           "  write [kx, ky, kz]"},
    Broken{"StiffnessInNewtons", "stiffness: 47 kN/m", "stiffness: 47 kN",
           "frame.yaml:9:44: identification.support.springs[1].stiffness: error: wrong dimension: stiffness "
           "[N/m] is wanted, this is force [N] (got '47 kN')\n"
           "  give it in N/m, or in a unit that converts to it"},
    Broken{"DirectionOfZeroLength", "direction: [0, 3, 4]", "direction: [0, 0, 0]",
           "frame.yaml:11:38: identification.support.springs[3].direction: error: the direction has zero "
           "length\n"
           "  give at least one component that is not zero"},
    Broken{"JointOfUnknownAxis", "axes: xz", "axes: xw",
           "frame.yaml:13:25: identification.support.joints[1].axes: error: the axes of a joint are letters "
           "out of x, y, z, each once (got 'xw')\n"
           "  write 'xyz', 'z', ..."},
    Broken{"JointOfRepeatedAxis", "axes: xz", "axes: xx",
           "frame.yaml:13:25: identification.support.joints[1].axes: error: the axes of a joint are letters "
           "out of x, y, z, each once (got 'xx')\n"
           "  write 'xyz', 'z', ..."},
    Broken{"JointWithoutAxes", "{node: 9, axes: xz}", "{node: 9}",
           "frame.yaml:13:9: identification.support.joints[1]: error: the key 'axes' is missing\n"
           "  add 'axes: ...' here"},
    Broken{
        "JointOfAxesAndDirection", "{node: 9, axes: xz}", "{node: 9, axes: xz, direction: [1, 0, 0]}",
        "frame.yaml:13:9: identification.support.joints[1]: error: a joint has either axes or a direction\n"
        "  remove one of the two"},
    Broken{"NegativeSupportMass", "mass: 0.5 kg", "mass: -0.5 kg",
           "frame.yaml:16:25: identification.support.masses[1].mass: error: the mass must not be negative "
           "(got '-0.5 kg')\n"
           "  give zero or a value above it"},
    Broken{"MassesFromNowhere", "{file: masses.csv}", "{}",
           "frame.yaml:17:3: identification.mass: error: masses come from a table, a matrix or the mass data "
           "of the body\n"
           "  write one of 'file: NAME', 'matrix: NAME' and 'total, centre, inertia'"},
    Broken{"MassesFromTwoPlaces", "{file: masses.csv}", "{file: masses.csv, matrix: dM.mtx}",
           "frame.yaml:17:3: identification.mass: error: masses come from a table, a matrix or the mass data "
           "of the body\n"
           "  write one of 'file: NAME', 'matrix: NAME' and 'total, centre, inertia'"},
    Broken{"MassTableMissing", "masses.csv", "mass.csv",
           "frame.yaml:17:16: identification.mass.file: error: there is no file mass.csv (got 'mass.csv')\n"
           "  names are relative to the file that they stand in"},
    Broken{"MassOfUnknownNode", "masses.csv", "strange.csv",
           "strange.csv:3 (byte 14): error: the structure has no such node (got '99')\n"
           "  its nodes are 1 to 12"},
    Broken{"NegativeMass", "masses.csv", "negative.csv",
           "negative.csv:2 (byte 12): error: a mass must not be negative (got '-5')\n"
           "  give the lumped mass of the node"},
    Broken{"MassTableWithoutMasses", "masses.csv", "nodes.csv",
           "nodes.csv:1 (byte 0): error: there is no column 'mass'\n"
           "  the columns are: node, x, y, z"},
    Broken{"BodyWithoutCentre", "{file: masses.csv}", "{total: 3 kg, inertia: [1, 1, 1]}",
           "frame.yaml:17:3: identification.mass: error: the key 'centre' is missing\n"
           "  add 'centre: ...' here"},
    Broken{"BodyWithoutMass", "{file: masses.csv}", "{total: 0, centre: [0, 0, 0], inertia: [1, 1, 1]}",
           "frame.yaml:17:17: identification.mass.total: error: the mass must be positive (got '0')\n"
           "  give a value above zero"},
    Broken{"ImpossibleInertia", "{file: masses.csv}", "{total: 3 kg, centre: [0, 0, 0], inertia: [1, 1, 3]}",
           "frame.yaml:17:42: identification.mass.inertia: error: no body can have this inertia: its "
           "principal values are 1, 1, 3 kg m2\n"
           "  the largest must not exceed the sum of the two others"},
    Broken{"MassMatrixOblong", "{file: masses.csv}", "{matrix: oblong.mtx}",
           "frame.yaml:17:18: identification.mass.matrix: error: the matrix must be square, this one has 36 "
           "x 9 (got 'oblong.mtx')\n"
           "  give a row and a column for every freedom"},
    Broken{"MassMatrixUnsymmetric", "{file: masses.csv}", "{matrix: skew.mtx}",
           "frame.yaml:17:18: identification.mass.matrix: error: the matrix must be symmetric, its asymmetry "
           "is 1.4 (got 'skew.mtx')\n"
           "  take its symmetric part if the difference is noise"},
    Broken{"MassMatrixCutShort", "{file: masses.csv}", "{matrix: cut.mtx}",
           "cut.mtx:4 (byte 60): error: the file ends after 1 of 2 entries\n"
           "  was the file cut short?"},
    Broken{"UnknownGoal", "find: changed", "find: change",
           "frame.yaml:18:9: identification.find: error: not one of the goals (got 'change')\n"
           "  did you mean 'changed'?"},
    Broken{"ChangeOfNothingAsked", "find: changed", "find: free",
           "frame.yaml:19:3: identification.change: error: 'change' belongs to 'find: changed'\n"
           "  remove it, or find that"},
    Broken{"NewSupportMissing", "find: changed", "find: held",
           "frame.yaml:5:1: identification: error: the key 'new_support' is missing\n"
           "  add 'new_support: ...' here"},
    Broken{"EmptyChange",
           "    masses:\n      - {nodes: [6, 7], mass: -1 kg}\n    springs:\n      - {nodes: [1, 2], "
           "stiffness: 5 kN/m}\n      - {nodes: [3, 8], stiffness: -6 kN/m, direction: [0, 0, 2]}\n    "
           "mass_matrix: dM.mtx\n    stiffness_matrix: dK.mtx\n",
           "    {}\n",
           "frame.yaml:19:3: identification.change: error: there is no change\n"
           "  name masses, springs or matrices"},
    Broken{"ChangeOnUnknownNode", "[6, 7], mass", "[6, 77], mass",
           "frame.yaml:21:21: identification.change.masses[1].nodes[2]: error: the structure has no such "
           "node (got '77')\n"
           "  its nodes are 1 to 12"},
    Broken{"ConnectionToUnknownNode", "nodes: [1, 2], stiffness: 5", "nodes: [1, 22], stiffness: 5",
           "frame.yaml:23:21: identification.change.springs[1].nodes[2]: error: the structure has no such "
           "node (got '22')\n"
           "  its nodes are 1 to 12"},
    Broken{"ConnectionAlongDirectionToUnknownNode", "nodes: [3, 8]", "nodes: [3, 88]",
           "frame.yaml:24:21: identification.change.springs[2].nodes[2]: error: the structure has no such "
           "node (got '88')\n"
           "  its nodes are 1 to 12"},
    Broken{"ConnectionOfThree", "nodes: [1, 2], stiffness: 5", "nodes: [1, 2, 3], stiffness: 5",
           "frame.yaml:23:10: identification.change.springs[1].nodes: error: a spring of a design change "
           "joins two nodes\n"
           "  write nodes: [a, b]"},
    Broken{"ConnectionOfANodeWithItself", "nodes: [1, 2], stiffness: 5", "nodes: [2, 2], stiffness: 5",
           "frame.yaml:23:10: identification.change.springs[1].nodes: error: the two nodes are in one place, "
           "so that a direction must be given\n"
           "  add 'direction: [x, y, z]'"},
    Broken{"ChangeMatrixMissing", "dK.mtx", "dk.mtx",
           "frame.yaml:26:23: identification.change.stiffness_matrix: error: there is no file dk.mtx (got "
           "'dk.mtx')\n"
           "  names are relative to the file that they stand in"},
    Broken{"ModelOfTwoKinds", "    block: {size", "    nodes: nodes.csv\n    block: {size",
           "frame.yaml:28:5: identification.model: error: unknown key 'nodes'\n"
           "  the keys here are: block, material"},
    Broken{"ModelWithoutMaterial", "    material: {young: 210 MPa, poisson: 0.3, density: 2600}\n", "",
           "frame.yaml:27:3: identification.model: error: the key 'material' is missing\n"
           "  add 'material: ...' here"},
    Broken{"ModelOfTooManyElements", "elements: [2, 1, 1]", "elements: [40, 40, 40]",
           "frame.yaml:28:36: identification.model.block.elements: error: the block has 68921 nodes, more "
           "than the 40000 whose modes can be computed\n"
           "  take fewer elements"},
    Broken{"ModelWithoutMasses",
           "    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}\n    material: {young: 210 MPa, poisson: "
           "0.3, density: 2600}\n",
           "    nodes: nodes.csv\n    stiffness: small.mtx\n",
           "frame.yaml:27:3: identification.model: error: the masses of the model are not known\n"
           "  add 'mass: M.mtx', or a column 'mass' to the nodes"},
    Broken{"ModelOfAnotherSize",
           "    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}\n    material: {young: 210 MPa, poisson: "
           "0.3, density: 2600}\n",
           "    nodes: nodes.csv\n    stiffness: dK.mtx\n",
           "frame.yaml:29:16: identification.model.stiffness: error: 3 nodes have 9 freedoms, this matrix "
           "has 36 rows (got 'dK.mtx')\n"
           "  give three freedoms to every node, in the order of the table"},
    Broken{"ModelUnsymmetric",
           "    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}\n    material: {young: 210 MPa, poisson: "
           "0.3, density: 2600}\n",
           "    nodes: nodes.csv\n    stiffness: skew.mtx\n",
           "frame.yaml:29:16: identification.model.stiffness: error: the matrix must be symmetric, its "
           "asymmetry is 1.4 (got 'skew.mtx')\n"
           "  take its symmetric part if the difference is noise"},
    Broken{"SupportLeavesMotionFree",
           "  measured: {file: test.csv, modes: = modes}\n  support:\n    springs:\n      - {nodes: [1, 2, "
           "11, 12], stiffness: 47 kN/m}\n      - {node: 3, stiffness: [0, 0, 2 kN/m]}\n      - {node: 4, "
           "stiffness: 1 kN/m, direction: [0, 3, 4]}\n    joints:\n      - {node: 9, axes: xz}\n      - "
           "{nodes: [10], direction: [0, 1, 0]}\n",
           "  measured: {from: model}\n  support:\n    springs:\n      - {nodes: [1, 2, 11], stiffness: [0, "
           "0, 1 kN/m]}\n",
           "frame.yaml:7:3: identification.support: error: the support leaves rigid-body motion of the model "
           "free (got 3 of 6 motions are held)\n"
           "  hold all of them, or name no support"},
    Broken{
        "UnknownExpansion", "expansion: none", "expansion: guess",
        "frame.yaml:30:14: identification.expansion: error: not one of the kinds of expansion (got 'guess')\n"
        "  the kinds of expansion are: none, serep, static, guyan"},
    Broken{"ExpansionWithMassTable", "expansion: none", "expansion: serep",
           "frame.yaml:17:16: identification.mass.file: error: the nodal masses are those of the model that "
           "the modes are expanded to (got 'masses.csv')\n"
           "  remove the table, or write the masses into the model"},
    Broken{"UnknownSpace", "space: modal", "space: outer",
           "frame.yaml:31:10: identification.space: error: not one of the spaces (got 'outer')\n"
           "  the spaces are: modal, physical"},
    Broken{"KeepNothing", "keep: 20", "keep: 0",
           "frame.yaml:32:9: identification.keep: error: a whole number from 1 to 2147483647 is wanted here "
           "(got '0')\n"
           "  give one of them"},
    Broken{"NoiseOfNothing", "{frequencies: 0.1 %, shapes: 1 %, samples: 50, seed: 7}", "{samples: 50}",
           "frame.yaml:33:3: identification.noise: error: there is no noise\n"
           "  give 'frequencies' or 'shapes' a standard deviation, as '0.1 %'"},
    Broken{"NegativeNoise", "frequencies: 0.1 %", "frequencies: -0.1 %",
           "frame.yaml:33:24: identification.noise.frequencies: error: the ratio must not be negative (got "
           "'-0.1 %')\n"
           "  give zero or a value above it"},
    Broken{"OneSample", "samples: 50", "samples: 1",
           "frame.yaml:33:53: identification.noise.samples: error: a whole number from 2 to 1000000 is "
           "wanted here (got '1')\n"
           "  give one of them"},
    Broken{
        "ReferenceMissing", "{from: model, modes: 10}", "{file: truth.h5}",
        "frame.yaml:34:21: identification.reference.file: error: there is no file truth.h5 (got 'truth.h5')\n"
        "  names are relative to the file that they stand in"},
    Broken{"ReferenceWithTooManyModes", "modes: 10}", "modes: 31}",
           "frame.yaml:34:35: identification.reference.modes: error: a whole number from 1 to 30 is wanted "
           "here (got '31')\n"
           "  give one of them"},
};

INSTANTIATE_TEST_SUITE_P(Catalogue, BrokenIdentifications, testing::ValuesIn(kBrokenIdentifications),
                         [](const auto& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace wishbone

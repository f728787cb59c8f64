#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/spatial.h"

/// What a Universal File (UFF, UNV) holds, as the file says it: its own units, its own axes, its own numbers.
/// Names and record layouts are those of the SDRC universal dataset specifications
/// (https://www.ceas3.uc.edu/sdrluff/). Texts are the bytes of the file without trailing blanks, in whatever
/// encoding it uses.
namespace wishbone {

/// Dataset 151: where the file comes from.
struct UffHeader {
  std::string model;
  std::string description;
  std::string database_program;
  std::string created;  ///< date, time, versions
  std::string saved;    ///< date, time
  std::string program;  ///< that wrote the file
  std::string written;  ///< date, time
};

/// Dataset 164. The factors convert from SI to the units of the file:
///     value in SI = value in the file / factor.
struct UffUnits {
  int code = 1;              ///< 1 to 10, 9: user-defined
  std::string description;   ///< at most 20 characters
  int temperature_mode = 1;  ///< 1 absolute, 2 relative
  double length = 1;         ///< file units per m
  double force = 1;          ///< file units per N
  double temperature = 1;    ///< file units per K
  double temperature_offset = 0;
};

/// Datasets 18 and 2420: a coordinate system in another one.
struct UffCoordinateSystem {
  int number = 0;
  int type = 0;       ///< 0 Cartesian, 1 cylindrical, 2 spherical
  int reference = 0;  ///< number of the system that origin and axes refer to; 0: global
  int color = 0;
  std::string name;
  Vector3 origin = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< columns: the unit vectors x, y, z in the reference system
};

/// Datasets 15, 781 and 2411. The position is in the definition system in 15 and 781, in the part's system in 2411,
/// whatever export system that names beside it.
struct UffNode {
  int number = 0;
  int definition_system = 0;    ///< that the position is given in; 0: global, as always in 2411
  int displacement_system = 0;  ///< that measurements at the node refer to; 0: global
  int color = 0;
  Vector3 position = Vector3::Zero();
  int export_system = 0;  ///< of 2411: says nothing about the position
};

/// Dataset 82: a polyline through nodes, to draw the structure by.
struct UffTraceLine {
  int number = 0;
  int color = 0;
  std::string name;
  std::vector<int> nodes;  ///< zero lifts the pen
};

/// Dataset 2412.
struct UffElement {
  int number = 0;
  int descriptor = 0;  ///< 11 rod, 21 linear beam, 94 thin shell, 115 brick ...
  int physical_property = 0;
  int material_property = 0;
  int color = 0;
  std::vector<int> nodes;
};

/// What a shape is a result of: field 2 of record 6 of dataset 55, of record 9 of dataset 2414.
enum UffAnalysis {
  kUffUnknown = 0,
  kUffStatic = 1,
  kUffNormalMode = 2,
  kUffComplexModeFirstOrder = 3,
  kUffTransient = 4,
  kUffFrequencyResponse = 5,
  kUffBuckling = 6,
  kUffComplexModeSecondOrder = 7,
};

/// Dataset 55, or 2414 at nodes: some numbers at each node. Numbers that the kind of analysis does not know
/// are zero.
struct UffShape {
  int dataset = 55;                ///< 55 or 2414
  std::size_t line = 0;            ///< of the file, where the dataset begins
  int label = 0;                   ///< 2414 only
  std::string name;                ///< 2414 only
  std::array<std::string, 5> ids;  ///< identification lines

  int model = 1;           ///< 1 structural
  int analysis = 2;        ///< UffAnalysis
  int characteristic = 2;  ///< 2: three translations, 3: three translations and three rotations
  int quantity = 8;        ///< 8 displacement, 11 velocity, 12 acceleration ...
  int values_per_node = 3;
  bool is_complex = false;

  int load_case = 0;
  int number = 0;                       ///< of the mode, frequency or time step
  double time = 0;                      ///< [s]
  double frequency = 0;                 ///< [Hz]
  std::complex<double> eigenvalue = 0;  ///< complex modes: s [rad/s]; of normal modes (2414): omega^2
  double modal_mass = 0;                ///< of normal modes
  double viscous_damping = 0;           ///< of normal modes, fraction of critical
  double hysteretic_damping = 0;        ///< of normal modes, loss factor
  std::complex<double> modal_a = 0;     ///< of complex modes
  std::complex<double> modal_b = 0;     ///< of complex modes

  std::vector<int> nodes;
  std::vector<double> values;  ///< node by node; of complex ones real and imaginary part in turn
};

/// Unit exponents and names of one axis of a function (records 8 to 11 of dataset 58).
struct UffAxis {
  int quantity = 0;
  int length_exponent = 0;
  int force_exponent = 0;
  int temperature_exponent = 0;
  std::string label = "NONE";
  std::string unit = "NONE";
};

/// One end of a function: where and along what it was measured.
struct UffFreedom {
  std::string entity = "NONE";
  int node = 0;
  int direction = 0;  ///< +-1, 2, 3 translation along x, y, z; +-4, 5, 6 rotation; 0 scalar
};

/// Dataset 58, or 58b: a function of time or frequency.
struct UffFunction {
  bool is_binary = false;
  bool is_big_endian = false;      ///< of binary ones
  std::array<std::string, 5> ids;  ///< identification lines

  int type = 0;  ///< 1 time response, 4 frequency response ...
  int number = 0;
  int version = 0;
  int load_case = 0;
  UffFreedom response;
  UffFreedom reference;

  bool is_complex = false;
  bool is_even = true;        ///< abscissae at start + k step; else listed in `abscissa`
  double abscissa_start = 0;  ///< zero when uneven
  double abscissa_step = 0;   ///< zero when uneven
  double z_value = 0;
  UffAxis abscissa_axis, ordinate_axis, denominator_axis, z_axis;

  std::vector<double> abscissa;  ///< empty when even
  /// In the precision of the file; of complex functions real and imaginary part in turn.
  std::variant<std::vector<float>, std::vector<double>> values = std::vector<double>();

  bool is_double() const { return values.index() == 1; }
  std::size_t value_count() const {
    return std::visit([](const auto& numbers) { return numbers.size(); }, values);
  }
  std::size_t point_count() const { return value_count() / (is_complex ? 2 : 1); }
};

/// A dataset that was met and left out; number 0: text between datasets.
struct UffUnused {
  int dataset = 0;
  std::size_t line = 0;  ///< where it begins
  std::string why;
};

/// Which dataset nodes are written as: 2411 and 781 keep 17 digits of positions, 15 keeps 6; 2411 knows no definition
/// systems.
enum class UffNodeDataset { k2411, k781, k15 };

struct UffFile {
  std::optional<UffHeader> header;
  std::optional<UffUnits> units;
  std::vector<UffCoordinateSystem> coordinate_systems;  ///< each number once
  std::vector<UffNode> nodes;                           ///< each number once
  std::vector<UffNode> repeated_nodes;  ///< of `nodes`, once more in another definition system
  UffNodeDataset node_dataset = UffNodeDataset::k2411;  ///< for the writer; readers take either and leave it
  std::vector<UffTraceLine> trace_lines;
  std::vector<UffElement> elements;
  std::vector<UffShape> shapes;
  std::vector<UffFunction> functions;
  std::vector<UffUnused> unused;
};

}  // namespace wishbone

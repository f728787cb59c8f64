#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "identification/formats/uff/uff_reader.h"
#include "identification/formats/uff/uff_writer.h"
#include "temporary_folder.h"
#include "text_files.h"

/// What is written comes back, to the digits that the standard's formats keep.
namespace wishbone {
namespace {

const TextFiles kFiles;

UffFile written_and_read(const UffFile& file) {
  write_uff(kFiles / "file.unv", file);
  return read_uff(kFiles / "file.unv");
}

void expect_six_digits(double actual, double expected) {
  EXPECT_NEAR(actual, expected, 5.0001e-6 * std::abs(expected));
}

TEST(UffRoundTrip, OfHeaderAndUnitsIsExact) {
  UffFile file;
  file.header = {"model",  "description with blanks", "database", "01-Jan-26 10:00:00", "saved", "program",
                 "written"};
  file.units = {9, "furlongs", 1, 1 / 201.168, 1 / 0.138254954376, 1.8, 459.67};
  const UffFile back = written_and_read(file);
  EXPECT_EQ(back.header->model, "model");
  EXPECT_EQ(back.header->description, "description with blanks");
  EXPECT_EQ(back.header->created, "01-Jan-26 10:00:00");
  EXPECT_EQ(back.header->written, "written");
  EXPECT_EQ(back.units->code, 9);
  EXPECT_EQ(back.units->description, "furlongs");
  EXPECT_EQ(back.units->length, file.units->length);
  EXPECT_EQ(back.units->force, file.units->force);
  EXPECT_EQ(back.units->temperature, 1.8);
  EXPECT_EQ(back.units->temperature_offset, 459.67);
}

TEST(UffRoundTrip, OfNodesElementsAndLinesIsExact) {
  UffFile file;
  file.nodes = {{7, 0, 3, 11, {1.0 / 3, -2e-17, 1e101}},
                {2000000000, 0, 0, 1, {-1.2345678901234567e-101, 0, -5}, 3}};
  file.elements = {{1, 11, 2, 3, 4, {7, 2000000000}}, {2, 116, 1, 1, 8, std::vector<int>(20, 7)}};
  file.trace_lines = {{1, 5, "a line", {7, 2000000000, 0, 7, 7, 7, 7, 7, 7, 7}}};
  const UffFile back = written_and_read(file);
  ASSERT_EQ(back.nodes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.nodes[i].number, file.nodes[i].number);
    EXPECT_EQ(back.nodes[i].definition_system, 0);
    EXPECT_EQ(back.nodes[i].export_system, file.nodes[i].export_system);
    EXPECT_EQ(back.nodes[i].displacement_system, file.nodes[i].displacement_system);
    EXPECT_EQ(back.nodes[i].position, file.nodes[i].position);
    EXPECT_EQ(back.elements[i].nodes, file.elements[i].nodes);
    EXPECT_EQ(back.elements[i].descriptor, file.elements[i].descriptor);
    EXPECT_EQ(back.elements[i].physical_property, file.elements[i].physical_property);
  }
  ASSERT_EQ(back.trace_lines.size(), 1u);
  EXPECT_EQ(back.trace_lines[0].name, "a line");
  EXPECT_EQ(back.trace_lines[0].nodes, file.trace_lines[0].nodes);
}

TEST(UffRoundTrip, OfNodesInDataset781KeepsTheirSystemsAndAllDigits) {
  UffFile file;
  file.nodes = {{7, 1, 3, 11, {1.0 / 3, -2e-17, 12345.678}}};
  file.node_dataset = UffNodeDataset::k781;
  const UffFile back = written_and_read(file);
  ASSERT_EQ(back.nodes.size(), 1u);
  EXPECT_EQ(back.nodes[0].definition_system, 1);
  EXPECT_EQ(back.nodes[0].displacement_system, 3);
  EXPECT_EQ(back.nodes[0].position, file.nodes[0].position);
}

TEST(UffRoundTrip, OfNodesInDataset15KeepsSixDigits) {
  UffFile file;
  file.nodes = {{7, 0, 3, 11, {1.0 / 3, -2e-17, 12345.678}}, {8, 1, 2, 4, {0, -1e5, 3e-4}}};
  file.node_dataset = UffNodeDataset::k15;
  const UffFile back = written_and_read(file);
  ASSERT_EQ(back.nodes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.nodes[i].number, file.nodes[i].number);
    EXPECT_EQ(back.nodes[i].definition_system, file.nodes[i].definition_system);
    EXPECT_EQ(back.nodes[i].displacement_system, file.nodes[i].displacement_system);
    for (int axis = 0; axis < 3; ++axis)
      expect_six_digits(back.nodes[i].position[axis], file.nodes[i].position[axis]);
  }
}

TEST(UffRoundTrip, OfCoordinateSystemsKeepsSixDigits) {
  UffFile file;
  const Matrix3 axes = Quaternion(0.5, 0.1, -0.7, 0.3).normalized().toRotationMatrix();
  file.coordinate_systems = {{4, 0, 2, 8, "skew", {1, -2, 0.5}, axes}};
  const UffFile back = written_and_read(file);
  ASSERT_EQ(back.coordinate_systems.size(), 1u);
  EXPECT_EQ(back.coordinate_systems[0].number, 4);
  EXPECT_EQ(back.coordinate_systems[0].reference, 2);
  EXPECT_EQ(back.coordinate_systems[0].origin, Vector3(1, -2, 0.5));
  EXPECT_TRUE(back.coordinate_systems[0].axes.isApprox(axes, 1e-4));
}

UffShape example_shape(int dataset, int analysis, bool is_complex) {
  UffShape shape;
  shape.dataset = dataset;
  shape.label = dataset == 2414 ? 12 : 0;
  shape.name = dataset == 2414 ? "twelfth" : "";
  shape.ids = {"one", "two", "three", "four", "five"};
  shape.analysis = analysis;
  shape.is_complex = is_complex;
  shape.values_per_node = 6;
  shape.characteristic = 3;
  shape.load_case = 3;
  shape.number = 4;
  shape.nodes = {5, 1, 99999};
  for (int k = 0; k < 3 * 6 * (is_complex ? 2 : 1); ++k)
    shape.values.push_back((k % 2 ? -1 : 1) * std::pow(10, 7 * k % 11 - 5) / 3);
  return shape;
}

void expect_same(const UffShape& back, const UffShape& shape) {
  EXPECT_EQ(back.dataset, shape.dataset);
  EXPECT_EQ(back.label, shape.label);
  EXPECT_EQ(back.name, shape.name);
  EXPECT_EQ(back.ids, shape.ids);
  EXPECT_EQ(back.analysis, shape.analysis);
  EXPECT_EQ(back.characteristic, shape.characteristic);
  EXPECT_EQ(back.is_complex, shape.is_complex);
  EXPECT_EQ(back.load_case, shape.load_case);
  EXPECT_EQ(back.number, shape.number);
  EXPECT_EQ(back.nodes, shape.nodes);
  ASSERT_EQ(back.values.size(), shape.values.size());
  for (std::size_t k = 0; k < shape.values.size(); ++k) expect_six_digits(back.values[k], shape.values[k]);
  expect_six_digits(back.time, shape.time);
  expect_six_digits(back.frequency, shape.frequency);
  expect_six_digits(back.eigenvalue.real(), shape.eigenvalue.real());
  expect_six_digits(back.eigenvalue.imag(), shape.eigenvalue.imag());
  expect_six_digits(back.modal_mass, shape.modal_mass);
  expect_six_digits(back.viscous_damping, shape.viscous_damping);
  expect_six_digits(back.hysteretic_damping, shape.hysteretic_damping);
  expect_six_digits(back.modal_a.imag(), shape.modal_a.imag());
  expect_six_digits(back.modal_b.real(), shape.modal_b.real());
}

TEST(UffRoundTrip, OfNodalShapesKeepsSixDigits) {
  for (const int dataset : {55, 2414}) {
    SCOPED_TRACE(dataset);
    UffShape normal = example_shape(dataset, kUffNormalMode, false);
    normal.frequency = 100.0 / 7;
    normal.modal_mass = 1.0 / 3;
    normal.viscous_damping = 0.0123456789;
    normal.hysteretic_damping = 0.03;
    UffShape complex = example_shape(dataset, kUffComplexModeFirstOrder, true);
    complex.eigenvalue = {-1.0 / 3, 2000.0 / 3};
    complex.modal_a = {1, -2.0 / 3};
    complex.modal_b = {4.0 / 3, 5};
    UffShape response = example_shape(dataset, kUffFrequencyResponse, true);
    response.frequency = 12.5;
    UffShape transient = example_shape(dataset, kUffTransient, false);
    transient.time = 1.0 / 9;
    const std::vector<UffShape> shapes = {normal, complex, response, transient};
    UffFile file;
    file.shapes = shapes;
    const UffFile back = written_and_read(file);
    ASSERT_EQ(back.shapes.size(), shapes.size());
    for (std::size_t k = 0; k < shapes.size(); ++k) expect_same(back.shapes[k], shapes[k]);
  }
}

template <class T>
UffFunction example_function(std::size_t points, bool is_complex, bool is_even) {
  UffFunction f;
  f.ids = {"run 1", "NONE", "date", "NONE", "NONE"};
  f.type = 4;
  f.number = 17;
  f.version = 2;
  f.load_case = 3;
  f.response = {"hub left", 1234567890, -3};
  f.reference = {"shaker", 5, 6};
  f.is_complex = is_complex;
  f.is_even = is_even;
  if (is_even) f.abscissa_start = 1.5, f.abscissa_step = 0.25;
  f.z_value = -2;
  f.abscissa_axis = {18, 1, -2, 3, "Frequency", "Hz"};
  f.ordinate_axis = {12, 0, 0, 0, "a label of 20 bytes!", "m/s2"};
  f.denominator_axis = {13, 0, 1, 0, "force", "N"};
  std::vector<T> values;
  for (std::size_t k = 0; k < points * (is_complex ? 2 : 1); ++k)
    values.push_back(static_cast<T>((k % 3 ? -1 : 1) * std::exp2(static_cast<double>(k % 40) - 20) / 3));
  f.values = values;
  for (std::size_t k = 0; !is_even && k < points; ++k)
    f.abscissa.push_back(0.5 + 0.25 * static_cast<double>(k * k));
  return f;
}

template <class T>
void expect_same_function(const UffFunction& back, const UffFunction& f, double digits) {
  EXPECT_EQ(back.ids, f.ids);
  EXPECT_EQ(back.is_binary, f.is_binary);
  EXPECT_EQ(back.is_big_endian, f.is_big_endian);
  EXPECT_EQ(back.type, f.type);
  EXPECT_EQ(back.number, f.number);
  EXPECT_EQ(back.version, f.version);
  EXPECT_EQ(back.load_case, f.load_case);
  EXPECT_EQ(back.response.entity, f.response.entity);
  EXPECT_EQ(back.response.node, f.response.node);
  EXPECT_EQ(back.response.direction, f.response.direction);
  EXPECT_EQ(back.reference.entity, f.reference.entity);
  EXPECT_EQ(back.reference.node, f.reference.node);
  EXPECT_EQ(back.abscissa_start, f.abscissa_start);
  EXPECT_EQ(back.abscissa_step, f.abscissa_step);
  EXPECT_EQ(back.z_value, f.z_value);
  EXPECT_EQ(back.abscissa_axis.force_exponent, -2);
  EXPECT_EQ(back.ordinate_axis.label, f.ordinate_axis.label);
  EXPECT_EQ(back.denominator_axis.unit, "N");
  EXPECT_EQ(back.z_axis.label, "NONE");
  EXPECT_EQ(back.is_complex, f.is_complex);
  EXPECT_EQ(back.abscissa.size(), f.abscissa.size());
  for (std::size_t k = 0; k < f.abscissa.size(); ++k) expect_six_digits(back.abscissa[k], f.abscissa[k]);
  ASSERT_EQ(back.values.index(), f.values.index());
  ASSERT_EQ(back.value_count(), f.value_count());
  const auto &a = std::get<std::vector<T>>(back.values), &b = std::get<std::vector<T>>(f.values);
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k], b[k], digits * std::abs(static_cast<double>(b[k]))) << k;
}

template <class T>
void check_functions(double text_digits) {
  for (const bool is_complex : {false, true})
    for (const bool is_even : {false, true})
      for (const std::size_t points : {0u, 1u, 2u, 7u, 100u}) {
        SCOPED_TRACE(testing::Message()
                     << "complex " << is_complex << " even " << is_even << " points " << points);
        UffFunction text = example_function<T>(points, is_complex, is_even), little = text, big = text;
        little.is_binary = big.is_binary = big.is_big_endian = true;
        UffFile file;
        file.functions = {text, little, big};
        const UffFile back = written_and_read(file);
        ASSERT_EQ(back.functions.size(), 3u);
        expect_same_function<T>(back.functions[0], text, text_digits);
        expect_same_function<T>(back.functions[1], little, 0);
        expect_same_function<T>(back.functions[2], big, 0);
      }
}

TEST(UffRoundTrip, OfFunctionsInSinglePrecisionKeepsAllBitsInBinaryAndSixDigitsInText) {
  check_functions<float>(5.1e-6);
}

TEST(UffRoundTrip, OfFunctionsInDoublePrecisionKeepsAllBitsInBinaryAndThirteenDigitsInText) {
  check_functions<double>(5.1e-13);
}

TEST(UffWriter, RefusesWhatDoesNotFitTogether) {
  UffFile file;
  file.shapes = {example_shape(55, kUffNormalMode, false)};
  file.shapes[0].values.pop_back();
  EXPECT_THROW(write_uff(kFiles / "bad.unv", file), InputError);
  file.shapes = {};
  file.functions = {example_function<float>(3, true, false)};
  file.functions[0].abscissa.pop_back();
  EXPECT_THROW(write_uff(kFiles / "bad.unv", file), InputError);
  file.functions = {};
  file.header = {"two\nlines", "", "", "", "", "", ""};
  EXPECT_THROW(write_uff(kFiles / "bad.unv", file), InputError);
  file.header = {};
  file.nodes = {{1, 0, 0, 0, {0, 0, std::numeric_limits<double>::infinity()}}};
  EXPECT_THROW(write_uff(kFiles / "bad.unv", file), InputError);
}

TEST(UffWriter, SaysThatAFileCannotBeWritten) {
  EXPECT_THROW(write_uff(kFiles / "no such folder" / "file.unv", {}), NumericsError);
  const TemporaryFolder folder;
  UffFile file;
  file.header.emplace();
  std::filesystem::create_symlink("/dev/full", folder / "device");  // never by its own name: it can be lost
  EXPECT_THROW(write_uff(folder / "device", file), NumericsError);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "device"));

  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const rlimit one_byte{1, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &one_byte);
  EXPECT_THROW(write_uff(folder / "file.unv", file), NumericsError);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  EXPECT_FALSE(std::filesystem::exists(folder / "file.unv"));
}

}  // namespace
}  // namespace wishbone

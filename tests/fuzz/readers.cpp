#include "fuzz/readers.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "identification/formats/calculix_matrices.h"
#include "identification/formats/csv_frequencies.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/matrix_market.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/uff/uff_modal_data.h"
#include "identification/formats/uff/uff_reader.h"
#include "models/identification_loader.h"
#include "models/scene_loader.h"
#include "solver/recorder.h"
#include "solver/result_file.h"

namespace wishbone::fuzz {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  return (std::ostringstream() << std::ifstream(file, std::ios::binary).rdbuf()).str();
}

/// Of a large Universal File only the beginning: the rest says nothing more, and takes time.
std::string beginning_of(const fs::path& file) {
  constexpr std::size_t kMost = 4000;
  const std::string bytes = bytes_of(file);
  return bytes.size() <= kMost ? bytes : bytes.substr(0, bytes.find('\n', kMost) + 1) + "    -1\n";
}

/// Input with the bytes that its file has now.
Input input(const fs::path& file, std::function<void()> read) {
  return {file, std::move(read), bytes_of(file)};
}

fs::path put(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

std::vector<fs::path> files_below(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

ModalData small_structure() {
  ModalData data;
  data.title = "beam";
  data.node_ids = {1, 2, 7};
  data.node_position = Matrix3X::Identity(3, 3);
  data.node_mass = Vector3(1, 2, 3);
  data.freedoms = all_freedoms(data.node_ids);
  data.omega = Vector3(10, 20, 30);
  data.damping_ratio = Vector3(0.01, 0.02, 0);
  data.modal_mass = Vector3(1, 2, 3);
  data.shapes = MatrixX::Ones(9, 3);
  data.support.springs = {{1, Vector3::UnitX(), 47e3}};
  data.support.joints = {{2, Vector3::UnitZ()}};
  data.support.masses = {{7, 0.05}};
  data.lines = {{1, 2}, {2, 7}};
  data.provenance = {"measured", "turned"};
  return data;
}

Reader scenes(const fs::path& models) {
  Reader reader{"scene", 3, {}};
  for (const fs::path& file : files_below(models / "scenes", ".yaml")) {
    const fs::path main = file.filename() == "car.yaml" ? models / "scenes/impulse_steer.yaml" : file;
    reader.inputs.push_back(input(file, [main] { load_scene(main); }));
  }
  return reader;
}

/// Whether a block is meshed with more elements than any of the intact files has, but not more than a block may have. Its modes are
/// computed while the file is read, for minutes if need be (kMostDenseFreedoms): that is the work asked for, not the reader's.
bool asks_for_a_large_model(const std::string& text) {
  constexpr int kMany = 16, kMostOfAnEdge = 100;
  static const std::regex elements(R"(elements:\s*\[\s*(\d{1,3})\s*,\s*(\d{1,3})\s*,\s*(\d{1,3})\s*\])");
  for (std::sregex_iterator block(text.begin(), text.end(), elements), end; block != end; ++block) {
    const int x = std::stoi((*block)[1]), y = std::stoi((*block)[2]), z = std::stoi((*block)[3]);
    if (x * y * z > kMany && std::max({x, y, z}) <= kMostOfAnEdge) return true;
  }
  return false;
}

Reader identifications(const fs::path& models) {
  Reader reader{"identification", 3, {}};
  for (const fs::path& file : files_below(models / "identification", ".yaml"))
    reader.inputs.push_back(input(file, [file] {
      if (!asks_for_a_large_model(bytes_of(file))) load_identification(file);
    }));
  const fs::path test = models / "identification/examples";
  reader.inputs.push_back(
      input(test / "chassis_masses.csv", [test] { load_identification(test / "chassis_test.yaml"); }));
  return reader;
}

Reader universal_files(const fs::path& folder) {
  Reader reader{"uff", 6, {}};
  fs::create_directories(folder);
  write_uff_modal_data(folder / "written.uff", small_structure());
  for (const fs::path& file : files_below(WISHBONE_TEST_DATA "/uff", ".uff"))
    put(folder / file.filename(), beginning_of(file));
  for (const fs::path& file : files_below(folder, ".uff")) {
    reader.inputs.push_back(input(file, [file] { read_uff(file); }));
    reader.inputs.push_back(input(file, [file] { read_uff_modal_data(file); }));
  }
  return reader;
}

Reader tables(const fs::path& folder) {
  Reader reader{"csv", 5, {}};
  const CsvModalFiles files{
      put(folder / "n.csv",
          "# frame\nnode,x[mm],y[mm],z,mass[g]\n1,0,0,0.5,10\n2,1e3,0,0,20\n3,0,\"1000\",0,0\n"),
      put(folder / "f.csv", "mode;frequency;damping[%];modal_mass\n7;17.35;1.5;1\n8;20.66;0;\n"),
      put(folder / "s.csv", "node,axis,mode_7,mode_8\n1,x,1,0.5\n1,-z,-0.25,1e-3\n2,x,1,1\n3,2,0,-1\n")};
  for (const fs::path& file : {files.nodes, files.frequencies, files.shapes})
    reader.inputs.push_back(input(file, [files] { read_csv_modal_data(files); }));
  for (const char* name : {"chassis_free_free.csv", "chassis_on_joints.csv"}) {
    const fs::path file = put(folder / name, bytes_of(fs::path(WISHBONE_TEST_DATA) / name));
    reader.inputs.push_back(input(file, [file] { read_csv_frequencies(file); }));
  }
  return reader;
}

Reader matrices(const fs::path& folder) {
  Reader reader{"matrix_market", 4, {}};
  for (const auto& [name, text] : std::vector<std::pair<const char*, std::string>>{
           {"symmetric",
            "%%MatrixMarket matrix coordinate real symmetric\n% K\n4 4 6\n1 1 2.5\n2 1 -1.25\n2 2 2.125\n"
            "3 2 -1e3\n3 3 4.875e-2\n4 4 0.0625\n"},
           {"skew",
            "%%MatrixMarket matrix coordinate integer skew-symmetric\n300 300 4\n2 1 5235\n3 2 -7254\n"
            "200 100 123456\n212 2 43567\n"},
           {"general", "%%MatrixMarket matrix coordinate real general\n2 3 3\n1 1 1\n2 3 -1.5\n1 2 7e300\n"},
           {"array",
            "%%MatrixMarket matrix array real general\n3 "
            "2\n1.537\n-2.125\n0.0125\n4.876e2\n5.987\n6.0123\n"}}) {
    const fs::path file = put(folder / name, text);
    reader.inputs.push_back(input(file, [file] { read_matrix_market(file); }));
  }
  return reader;
}

Reader calculix(const fs::path& folder) {
  Reader reader{"calculix", 3, {}};
  put(folder / "job.dof", "1.1\n1.2\n1.3\n2.1\n2.2\n2.3\n");
  put(folder / "job.sti", "1 1 2.5e3\n1 4 -2.5e3\n4 4 2.5e3\n2 2 1\n3 3 1\n5 5 1\n6 6 1\n");
  put(folder / "job.mas", "1 1 1.5\n2 2 1.5\n3 3 1.5\n4 4 1.5\n5 5 1.5\n6 6 1.5\n1 4 0.25\n");
  put(folder / "job.inp",
      "** beam\n*NODE,NSET=NALL\n1,0.0,0.0,0.0\n2,0.25,0.0,0.0\n*ELEMENT,TYPE=C3D8\n1,1,2,1,2,1,2,1,2\n");
  put(folder / "job.frd",
      "    1C\n    2C                         2                                     1\n"
      " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n"
      " -1         2 2.50000E-01 0.00000E+00 0.00000E+00\n -3\n 9999\n");
  for (const char* name : {"job.dof", "job.sti", "job.mas", "job.inp"})
    reader.inputs.push_back(
        input(folder / name, [folder] { read_calculix_matrices(folder / "job", folder / "job.inp"); }));
  reader.inputs.push_back(
      input(folder / "job.frd", [folder] { read_calculix_matrices(folder / "job", folder / "job.frd"); }));
  return reader;
}

Reader mode_files(const fs::path& folder) {
  Reader reader{"modes.h5", 1, {}};
  fs::create_directories(folder);
  write_mode_file((folder / "modes.h5").string(), small_structure());
  put(folder / "latest.h5", bytes_of(WISHBONE_FUZZ_CORPUS "/modes_latest.h5"));
  for (const char* name : {"modes.h5", "latest.h5"}) {
    const fs::path file = folder / name;
    reader.inputs.push_back(input(file, [file] { read_mode_file(file.string()); }));
  }
  return reader;
}

void read_result(const std::string& path) {
  const ResultFile file(path);
  for (const Signal& signal : file.signals()) file.read(signal.path);
  file.meta();
  file.run_meta();
  file.status();
}

Reader results(const fs::path& folder) {
  Reader reader{"result.h5", 1, {}};
  fs::create_directories(folder);
  {
    Recorder recorder((folder / "result.h5").string(),
                      {{"/bodies/arm/position", {3}, "m", "world", "where it is", {}},
                       {"/flexible/arm/deflection", {2, 3}, "m", "arm", "", {{"nodes", {"1", "2"}}}},
                       {"/energy", {}, "J", "", "sum", {}}});
    recorder.set_meta("scene", "bodies: {}");
    recorder.set_meta("steps", 12.0);
    recorder.set_run_meta("host", "here");
    for (int i = 0; i < 300; ++i) recorder.append(0.01 * i, std::vector<double>(10, i));
    recorder.close(Outcome::kComplete);
  }
  put(folder / "latest.h5", bytes_of(WISHBONE_FUZZ_CORPUS "/result_latest.h5"));
  for (const char* name : {"result.h5", "latest.h5"}) {
    const fs::path file = folder / name;
    reader.inputs.push_back(input(file, [file] { read_result(file.string()); }));
  }
  return reader;
}

}  // namespace

std::vector<Reader> readers(const fs::path& folder) {
  const fs::path models = folder / "models";
  fs::create_directories(models);
  fs::copy(WISHBONE_MODELS "/scenes", models / "scenes", fs::copy_options::recursive);
  fs::copy(WISHBONE_MODELS "/identification", models / "identification", fs::copy_options::recursive);
  return {scenes(models),
          identifications(models),
          universal_files(folder / "uff"),
          tables(folder / "csv"),
          matrices(folder / "matrices"),
          calculix(folder / "calculix"),
          mode_files(folder / "modes"),
          results(folder / "results")};
}

}  // namespace wishbone::fuzz

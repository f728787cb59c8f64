#pragma once

#include <string>
#include <string_view>

#include "identification/formats/csv_modal_data.h"
#include "identification/formats/matrix_market.h"
#include "models/identification_loader.h"
#include "text_files.h"

namespace wishbone {

/// Has every key of an identification but those that exclude others.
inline constexpr std::string_view kGoodIdentification = R"(wishbone: 1
title: Frame on springs
parameters:
  modes: 30
identification:
  measured: {file: test.csv, modes: = modes}
  support:
    springs:
      - {nodes: [1, 2, 11, 12], stiffness: 47 kN/m}
      - {node: 3, stiffness: [0, 0, 2 kN/m]}
      - {node: 4, stiffness: 1 kN/m, direction: [0, 3, 4]}
    joints:
      - {node: 9, axes: xz}
      - {nodes: [10], direction: [0, 1, 0]}
    masses:
      - {node: 5, mass: 0.5 kg}
  mass: {file: masses.csv}
  find: changed
  change:
    masses:
      - {nodes: [6, 7], mass: -1 kg}
    springs:
      - {nodes: [1, 2], stiffness: 5 kN/m}
      - {nodes: [3, 8], stiffness: -6 kN/m, direction: [0, 0, 2]}
    mass_matrix: dM.mtx
    stiffness_matrix: dK.mtx
  model:
    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
    material: {young: 210 MPa, poisson: 0.3, density: 2600}
  expansion: none
  space: modal
  keep: 20
  noise: {frequencies: 0.1 %, shapes: 1 %, samples: 50, seed: 7}
  reference: {from: model, modes: 10}
)";

/// The files that the good identification names, and some that are of no use to it.
class IdentificationFiles : public TextFiles {
 public:
  IdentificationFiles() {
    const ModalData data = load_identification(write("model.yaml", R"(wishbone: 1
identification:
  measured: {from: model}
  model:
    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
    material: {young: 210 MPa, poisson: 0.3, density: 2600}
  support: {springs: [{nodes: [1, 2, 11, 12], stiffness: 47 kN/m}]}
)"))
                               .task.measured;
    write_csv_modal_data(csv_modal_files(*this / "test.csv"), data);
    std::string masses = "node,mass [g]\n";
    for (const int node : data.node_ids)
      masses += std::to_string(node) + "," + std::to_string(1000 + node) + "\n";
    write("masses.csv", masses);
    write("nodes.csv", "node,x,y,z\n1,0,0,0\n2,1,0,0\n3,0,1,0\n");
    SparseMatrix one(36, 36);
    one.insert(0, 0) = 1;
    write_matrix_market(*this / "dM.mtx", one, true);
    write_matrix_market(*this / "dK.mtx", one, true);
    write("small.mtx", "%%MatrixMarket matrix coordinate real symmetric\n9 9 1\n1 1 5\n");
    write("oblong.mtx", "%%MatrixMarket matrix coordinate real general\n36 9 1\n1 1 5\n");
    write("skew.mtx", "%%MatrixMarket matrix coordinate real general\n9 9 1\n1 2 5\n");
    write("cut.mtx", "%%MatrixMarket matrix coordinate real symmetric\n9 9 2\n1 1 5\n");
    write("strange.csv", "node,mass\n1,5\n99,5\n");
    write("negative.csv", "node,mass\n1,-5\n");
    write("notes.txt", "measured on a Monday\n");
    write("words.h5", "not HDF5\n");
  }
};

}  // namespace wishbone

#include <cmath>
#include <numbers>

#include "identification/formats/csv_modal_data.h"
#include "identification/formats/text_writer.h"

namespace wishbone {
namespace {

void write_nodes(TextWriter& out, const ModalData& data) {
  out.print("node,x[m],y[m],z[m]{}\n", data.has_masses() ? ",mass[kg]" : "");
  for (int i = 0; i < data.node_count(); ++i) {
    const Vector3 s = data.node_position.col(i);
    out.print("{},{},{},{}", data.node_ids[static_cast<std::size_t>(i)], s.x(), s.y(), s.z());
    if (data.has_masses()) out.print(",{}", data.node_mass[i]);
    out.print("\n");
  }
}

void write_frequencies(TextWriter& out, const ModalData& data) {
  out.print("mode,frequency[Hz],omega[rad/s],damping_ratio,modal_mass[kg]\n");
  for (int j = 0; j < data.mode_count(); ++j) {
    out.print("{},{},{},{},", j + 1, data.omega[j] / (2 * std::numbers::pi), data.omega[j],
              data.damping_ratio[j]);
    if (!std::isnan(data.modal_mass[j])) out.print("{}", data.modal_mass[j]);
    out.print("\n");
  }
}

void write_shapes(TextWriter& out, const ModalData& data) {
  out.print("node,axis");
  for (int j = 0; j < data.mode_count(); ++j) out.print(",mode_{}", j + 1);
  out.print("\n");
  for (int k = 0; k < data.freedom_count(); ++k) {
    const Freedom& freedom = data.freedoms[static_cast<std::size_t>(k)];
    out.print("{},{}", freedom.node, "xyz"[freedom.axis]);
    for (int j = 0; j < data.mode_count(); ++j) out.print(",{}", data.shapes(k, j));
    out.print("\n");
  }
}

}  // namespace

void write_csv_modal_data(const CsvModalFiles& files, const ModalData& data) {
  data.validate();
  TextWriter nodes(files.nodes), frequencies(files.frequencies), shapes(files.shapes);
  write_nodes(nodes, data);
  write_frequencies(frequencies, data);
  write_shapes(shapes, data);
  nodes.close();
  frequencies.close();
  shapes.close();
}

}  // namespace wishbone

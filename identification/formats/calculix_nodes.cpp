#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

#include "core/error.h"
#include "identification/formats/calculix_matrices.h"
#include "identification/formats/line_reader.h"

namespace wishbone {
namespace {

using NodePlaces = std::map<int, Vector3>;

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

int node_id(const LineReader& reader, std::string_view token) {
  const std::int64_t id = reader.integer(token);
  if (id < 1 || id > std::numeric_limits<int>::max())
    reader.reject(token, "node numbers are positive", "number the node from 1 to 2147483647");
  return static_cast<int>(id);
}

void add(const LineReader& reader, std::string_view token, const Vector3& place, NodePlaces& nodes) {
  if (!nodes.emplace(node_id(reader, token), place).second)
    reader.reject(token, "the node has a place already", "give each node once");
}

/// The keyword of a card without its parameters: "*NODE" of "*Node, NSET=Nall".
std::string keyword(std::string_view line) {
  return in_capitals(without_blanks(line.substr(0, line.find(','))));
}

/// "id, x, y, z"; coordinates that are not there are zero.
void read_data_line(const LineReader& reader, NodePlaces& nodes) {
  std::string_view rest = reader.line();
  const auto next_field = [&] {
    const std::size_t comma = rest.find(',');
    const std::string_view field = without_blanks(rest.substr(0, comma));
    rest = comma == std::string_view::npos ? rest.substr(rest.size()) : rest.substr(comma + 1);
    return field;
  };
  const std::string_view id = next_field();
  Vector3 place = Vector3::Zero();
  for (double& coordinate : place)
    if (const std::string_view field = next_field(); !field.empty()) coordinate = reader.number(field);
  add(reader, id, place, nodes);
}

NodePlaces read_deck(const std::filesystem::path& path) {
  LineReader reader(path);
  NodePlaces nodes;
  bool in_nodes = false;
  while (reader.next()) {
    const std::string_view line = without_blanks(reader.line());
    if (line.empty() || line.starts_with("**")) continue;
    if (!line.starts_with('*')) {
      if (in_nodes) read_data_line(reader, nodes);
      continue;
    }
    const std::string card = keyword(line);
    in_nodes = card == "*NODE";
    if (card == "*INCLUDE" || (in_nodes && in_capitals(line).find("INPUT") != std::string::npos))
      reader.reject(line, "nodes of other files are not read", "name a result file: 'nodes: JOB.frd'");
    if (card == "*TRANSFORM")
      reader.reject(line, "freedoms along other axes are not understood",
                    "remove the card and run the deck again");
  }
  if (nodes.empty())
    reader.reject(reader.line(), "there are no nodes (*NODE)", "name the file that has them");
  return nodes;
}

/// Fixed columns: " -1", node I10, coordinates 3E12.5.
void read_result_line(const LineReader& reader, NodePlaces& nodes) {
  const std::string_view line = reader.line();
  constexpr std::size_t kId = 3, kIdWidth = 10, kNumberWidth = 12;
  if (line.size() < kId + kIdWidth + 3 * kNumberWidth)
    reader.reject(line, "the line of a node is too short", "write the file with *NODE FILE, not as binary");
  Vector3 place;
  for (std::size_t axis = 0; axis < 3; ++axis)
    place[static_cast<Eigen::Index>(axis)] =
        reader.number(without_blanks(line.substr(kId + kIdWidth + axis * kNumberWidth, kNumberWidth)));
  add(reader, without_blanks(line.substr(kId, kIdWidth)), place, nodes);
}

NodePlaces read_results(const std::filesystem::path& path) {
  LineReader reader(path);
  NodePlaces nodes;
  bool in_nodes = false;
  while (reader.next()) {
    const std::string_view line = reader.line();
    if (line.starts_with("    2C")) in_nodes = true;
    if (in_nodes && line.starts_with(" -3")) break;
    if (in_nodes && line.starts_with(" -1")) read_result_line(reader, nodes);
  }
  if (nodes.empty())
    reader.reject(reader.line(), "there is no block of nodes (2C)", "name the input deck: 'nodes: JOB.inp'");
  return nodes;
}

}  // namespace

CalculixNodes read_calculix_nodes(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".inp" && extension != ".frd")
    throw InputError({path.string(), "nodes are read from input decks (.inp) and result files (.frd)",
                      extension.empty() ? "no extension" : extension, "name one of these"});
  const NodePlaces places = extension == ".inp" ? read_deck(path) : read_results(path);
  CalculixNodes nodes;
  nodes.position.resize(3, static_cast<Eigen::Index>(places.size()));
  for (const auto& [id, place] : places) {
    nodes.position.col(static_cast<Eigen::Index>(nodes.ids.size())) = place;
    nodes.ids.push_back(id);
  }
  return nodes;
}

}  // namespace wishbone

#include "identification/formats/calculix_matrices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "core/error.h"
#include "identification/formats/line_reader.h"

namespace wishbone {
namespace {

constexpr std::int64_t kLargest = std::numeric_limits<int>::max();

int small_integer(const LineReader& reader, std::string_view token) {
  const std::int64_t value = reader.integer(token);
  if (value < 0 || value > kLargest)
    reader.reject(token, "the number is out of range", "use 0 to 2147483647");
  return static_cast<int>(value);
}

using Place = std::map<std::pair<int, int>, int>;

Place places_of(const std::vector<Freedom>& freedoms) {
  Place place;
  for (const Freedom& f : freedoms) place.emplace(std::pair(f.node, f.axis), static_cast<int>(place.size()));
  return place;
}

/// The nodes of the rows, ascending; refuses nodes that are not free in x, y and z.
std::vector<int> free_nodes(const std::filesystem::path& path, const std::vector<Freedom>& rows) {
  std::map<int, std::array<bool, 3>> axes;
  for (const Freedom& row : rows) axes[row.node][static_cast<std::size_t>(row.axis)] = true;
  std::vector<int> ids;
  for (const auto& [node, has] : axes) {
    for (int axis = 0; axis < 3; ++axis)
      if (!has[static_cast<std::size_t>(axis)])
        throw InputError({path.string(), "the structure must be free in every direction of its nodes",
                          to_string(Freedom{node, axis}) + " is missing",
                          "remove *BOUNDARY and equations from the deck, and run it again"});
    ids.push_back(node);
  }
  return ids;
}

}  // namespace

std::vector<Freedom> read_calculix_freedoms(const std::filesystem::path& path) {
  LineReader reader(path);
  std::vector<Freedom> freedoms;
  std::map<std::pair<int, int>, bool> seen;
  while (reader.next()) {
    const std::string_view line = without_blanks(reader.line());
    if (line.empty()) continue;
    const std::size_t dot = line.find('.');
    if (dot == std::string_view::npos)
      reader.reject(line, "a row is named by node and direction", "was this file written by CalculiX?");
    const Freedom freedom{small_integer(reader, line.substr(0, dot)),
                          small_integer(reader, line.substr(dot + 1)) - 1};
    if (freedom.axis < 0 || freedom.axis > 2)
      reader.reject(line, "a direction must be 1, 2 or 3", "use solid elements, which have no rotations");
    if (!seen.emplace(std::pair(freedom.node, freedom.axis), true).second)
      reader.reject(line, "this row is named twice", "was this file written by CalculiX?");
    freedoms.push_back(freedom);
  }
  if (freedoms.empty()) reader.reject(reader.line(), "there are no rows", "did CalculiX fail?");
  return freedoms;
}

SparseMatrix read_calculix_matrix(const std::filesystem::path& path, const std::vector<Freedom>& rows,
                                  const std::vector<Freedom>& freedoms) {
  const Place place = places_of(freedoms);
  std::vector<int> moved;  // place of each row
  for (const Freedom& row : rows) {
    const auto found = place.find({row.node, row.axis});
    moved.push_back(found == place.end() ? -1 : found->second);
  }
  LineReader reader(path);
  const auto index = [&](std::string_view word) {
    const std::int64_t row = reader.integer(word);
    if (row < 1 || row > static_cast<std::int64_t>(rows.size()))
      reader.reject(word, fmt::format("there are {} rows", rows.size()),
                    "take the .dof file of the same run");
    const int at = moved[static_cast<std::size_t>(row - 1)];
    if (at < 0) reader.reject(word, "its freedom is not wanted", "take the .dof file of the same run");
    return at;
  };
  std::vector<Eigen::Triplet<double>> entries;
  while (reader.next()) {
    std::string_view rest = without_blanks(reader.line());
    if (rest.empty()) continue;
    std::array<std::string_view, 3> words;
    for (std::string_view& word : words) {
      word = rest.substr(0, rest.find_first_of(" \t"));
      rest = without_blanks(rest.substr(word.size()));
    }
    if (words[2].empty() || !rest.empty())
      reader.reject(without_blanks(reader.line()), "a line must be row, column, value",
                    "was this file written by CalculiX?");
    const int i = index(words[0]), j = index(words[1]);
    const double value = reader.number(words[2]);
    if (value == 0) continue;
    entries.emplace_back(i, j, value);
    if (i != j) entries.emplace_back(j, i, value);
  }
  const auto n = static_cast<Eigen::Index>(freedoms.size());
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

CalculixMatrices read_calculix_matrices(const std::filesystem::path& job,
                                        const std::filesystem::path& nodes) {
  const auto file = [&](const char* extension) { return std::filesystem::path(job.string() + extension); };
  const std::vector<Freedom> rows = read_calculix_freedoms(file(".dof"));
  CalculixMatrices model;
  model.node_ids = free_nodes(file(".dof"), rows);
  const CalculixNodes all = read_calculix_nodes(nodes);
  model.node_position.resize(3, static_cast<Eigen::Index>(model.node_ids.size()));
  for (std::size_t i = 0; i < model.node_ids.size(); ++i) {
    const auto found = std::lower_bound(all.ids.begin(), all.ids.end(), model.node_ids[i]);
    if (found == all.ids.end() || *found != model.node_ids[i])
      throw InputError({nodes.string(), "the place of a node is not known",
                        fmt::format("node {}", model.node_ids[i]),
                        "name the deck or result file of the same model"});
    model.node_position.col(static_cast<Eigen::Index>(i)) = all.position.col(found - all.ids.begin());
  }
  const std::vector<Freedom> freedoms = all_freedoms(model.node_ids);
  model.K = read_calculix_matrix(file(".sti"), rows, freedoms);
  model.M = read_calculix_matrix(file(".mas"), rows, freedoms);
  return model;
}

}  // namespace wishbone

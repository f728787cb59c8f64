#include "identification/calculix/calculix_files.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string_view>

#include "core/error.h"

namespace wishbone {
namespace {

/// Lines of a file, with its name and their number for messages.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), file_(path) {
    if (!file_) throw InputError({path_, "the file cannot be read", "", "see what CalculiX said"});
  }
  bool next() {
    ++number_;
    return static_cast<bool>(std::getline(file_, line_));
  }
  const std::string& line() const { return line_; }
  bool starts_with(std::string_view text) const { return line_.starts_with(text); }
  [[noreturn]] void reject(std::string what) const {
    throw InputError(
        {fmt::format("{}:{}", path_, number_), std::move(what), line_, "see what CalculiX said"});
  }

  /// The number in the fixed columns [first, first + width), blanks around it.
  template <class Number>
  Number number(std::size_t first, std::size_t width) const {
    const std::string_view field =
        first < line_.size() ? std::string_view(line_).substr(first, width) : std::string_view();
    return parse<Number>(field);
  }

  /// The words of the line.
  std::vector<std::string> words() const {
    std::istringstream in(line_);
    return {std::istream_iterator<std::string>(in), {}};
  }

  template <class Number>
  Number parse(std::string_view field) const {
    const std::size_t start = field.find_first_not_of(' ');
    Number value{};
    if (start == std::string_view::npos) reject("a number is missing");
    const char* end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data() + start, end, value);
    if (error != std::errc() || std::string_view(stop, end).find_first_not_of(' ') != std::string_view::npos)
      reject(fmt::format("'{}' is not a number", field));
    return value;
  }

 private:
  std::string path_;
  std::ifstream file_;
  std::string line_;
  int number_ = 0;
};

}  // namespace

VectorX read_dat_eigenvalues(const std::string& path) {
  Lines lines(path);
  std::vector<double> eigenvalues;
  bool in_table = false;
  while (lines.next()) {
    if (lines.line().find("E I G E N V A L U E   O U T P U T") != std::string::npos) in_table = true;
    if (lines.line().find("P A R T I C I P A T I O N") != std::string::npos) break;
    const std::vector<std::string> words = lines.words();
    if (!in_table || words.size() != 5 || words[0] == "MODE") continue;
    if (lines.parse<int>(words[0]) != static_cast<int>(eigenvalues.size()) + 1)
      lines.reject("modes must be numbered from 1");
    eigenvalues.push_back(lines.parse<double>(words[1]));
  }
  if (eigenvalues.empty()) lines.reject("there is no table of eigenvalues");
  return Eigen::Map<const VectorX>(eigenvalues.data(), static_cast<Eigen::Index>(eigenvalues.size()));
}

MatrixX read_frd_shapes(const std::string& path, const std::vector<int>& node_ids) {
  std::map<int, Eigen::Index> row;
  for (const int id : node_ids) row.emplace(id, 3 * static_cast<Eigen::Index>(row.size()));
  Lines lines(path);
  std::vector<VectorX> shapes;
  while (lines.next()) {
    if (!lines.starts_with("  100CL") || lines.line().find("MODAL") == std::string::npos) continue;
    VectorX shape = VectorX::Constant(3 * static_cast<Eigen::Index>(node_ids.size()), std::nan(""));
    while (lines.next() && !lines.starts_with(" -3")) {
      if (!lines.starts_with(" -1")) continue;
      const auto found = row.find(lines.number<int>(3, 10));
      if (found == row.end()) lines.reject("this node was not given");
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        shape[found->second + axis] = lines.number<double>(13 + 12 * static_cast<std::size_t>(axis), 12);
    }
    if (!shape.allFinite()) lines.reject("the shape does not cover every node");
    shapes.push_back(shape);
  }
  if (shapes.empty()) lines.reject("there are no modes");
  MatrixX all(shapes[0].size(), static_cast<Eigen::Index>(shapes.size()));
  for (std::size_t j = 0; j < shapes.size(); ++j) all.col(static_cast<Eigen::Index>(j)) = shapes[j];
  return all;
}

}  // namespace wishbone

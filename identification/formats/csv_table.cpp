#include "identification/formats/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/did_you_mean.h"
#include "core/error.h"

namespace wishbone {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// The separator of a header: what its names are least likely to contain decides.
char separator_of(std::string_view header) {
  bool quotes = false;
  std::string bare;
  for (const char c : header) {
    if (c == '"') quotes = !quotes;
    if (!quotes) bare += c;
  }
  for (const char c : {';', '\t'})
    if (bare.find(c) != std::string::npos) return c;
  return ',';
}

std::string unit_of(std::string_view text) {
  return text == "-" ? std::string() : std::string(text);
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : reader_(path) {
  read_header();
  read_units();
}

bool CsvTable::next_content() {
  while (reader_.next()) {
    const std::string_view content = without_blanks(reader_.line());
    if (!content.empty() && content.front() != '#') return true;
  }
  return false;
}

void CsvTable::read_header() {
  if (!next_content())
    throw InputError({reader_.where(), "the table is empty", "", "begin with a line that names the columns"});
  separator_ = separator_of(reader_.line());
  split();
  if (looks_like_number(fields_.front()))
    reject(0, "the first line must name the columns", "write a line such as 'node,x,y,z' above the numbers");
  for (const std::string_view field : fields_) {
    const auto bracket = field.ends_with(']') ? field.find('[') : std::string_view::npos;
    const std::string where = reader_.where(field);
    CsvColumn column{lower_case(without_blanks(field.substr(0, bracket))), "", where, where};
    if (bracket != std::string_view::npos)
      column.unit = unit_of(without_blanks(field.substr(bracket + 1, field.size() - bracket - 2)));
    if (column.name.empty())
      reader_.reject(field, "a column has no name", "name it, or remove its separator");
    if (find(column.name)) reader_.reject(field, "two columns have the same name", "rename or remove one");
    columns_.push_back(std::move(column));
  }
}

void CsvTable::read_units() {
  if (!next_content()) return;
  split();
  const bool header_has_units =
      std::any_of(columns_.begin(), columns_.end(), [](const CsvColumn& c) { return !c.unit.empty(); });
  at_first_row_ = header_has_units || std::any_of(fields_.begin(), fields_.end(), looks_like_number);
  if (at_first_row_) return;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    columns_[i].unit = unit_of(fields_[i]);
    columns_[i].unit_where = reader_.where(fields_[i]);
  }
}

bool CsvTable::next_row() {
  if (std::exchange(at_first_row_, false)) return true;
  if (!next_content()) return false;
  split();
  return true;
}

std::string_view CsvTable::take_quoted(std::string_view& rest) const {
  const std::string_view opening = rest.substr(0, 1);
  std::size_t end = 1;
  for (;; end += 2) {  // "" is a quote inside the text
    end = rest.find('"', end);
    if (end == std::string_view::npos)
      reader_.reject(opening, "a quoted field does not end on its line", "close the quotes");
    if (rest.substr(end + 1, 1) != "\"") break;
  }
  const std::string_view field = rest.substr(1, end - 1);
  rest = rest.substr(end + 1);
  const std::string_view behind = without_blanks(rest.substr(0, rest.find(separator_)));
  if (!behind.empty())
    reader_.reject(behind, "text follows a quoted field",
                   "quote the whole field; write \"\" for a quote in it");
  return field;
}

std::string_view CsvTable::take_plain(std::string_view& rest) const {
  const std::string_view field = without_blanks(rest.substr(0, rest.find(separator_)));
  if (const auto quote = field.find('"'); quote != std::string_view::npos)
    reader_.reject(field.substr(quote), "a quote inside a field that does not begin with one",
                   "quote the whole field");
  return field;
}

void CsvTable::split() {
  fields_.clear();
  std::string_view rest = reader_.line();
  for (bool more = true; more;) {
    // a tab that separates is not a blank that leads
    const auto first = rest.find_first_not_of(separator_ == '\t' ? " " : " \t");
    rest = rest.substr(std::min(first, rest.size()));
    fields_.push_back(rest.starts_with('"') ? take_quoted(rest) : take_plain(rest));
    if (!columns_.empty() && fields_.size() > columns_.size())
      reader_.reject(fields_.back(),
                     fmt::format("the row has more than the {} fields of the header", columns_.size()),
                     "remove the field, or name its column");
    const auto separator = rest.find(separator_);
    more = separator != std::string_view::npos;
    if (more) rest = rest.substr(separator + 1);
  }
  if (fields_.size() < columns_.size())
    reader_.reject(reader_.line().substr(reader_.line().size()),
                   fmt::format("the row has {} fields, the header has {}", fields_.size(), columns_.size()),
                   fmt::format("give a value for '{}'", columns_[fields_.size()].name));
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns_.begin(), columns_.end(), [&](const CsvColumn& c) { return c.name == name; });
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::column(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  std::vector<std::string> names;
  for (const CsvColumn& c : columns_) names.push_back(c.name);
  throw InputError({columns_.front().where, fmt::format("there is no column '{}'", name), "",
                    did_you_mean(name, names, "the columns")});
}

void CsvTable::allow_only(const std::vector<std::string>& names) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (std::find(names.begin(), names.end(), columns_[i].name) == names.end())
      reject_column(i, "this column means nothing here",
                    did_you_mean(columns_[i].name, names, "the columns"));
}

void CsvTable::reject_column(std::size_t column, std::string what, std::string remedy) const {
  const CsvColumn& c = columns_[column];
  throw InputError({c.where, std::move(what), in_quotes(c.name), std::move(remedy)});
}

double CsvTable::si_factor(std::size_t column, const Dimension& dimension) const {
  const std::string& unit = columns_[column].unit;
  if (unit.empty()) return 1;
  try {
    return parse_quantity("1 " + unit, dimension);
  } catch (const InputError& e) {
    throw InputError(
        {columns_[column].unit_where, e.diagnostic().what, in_quotes(unit), e.diagnostic().remedy});
  }
}

std::string CsvTable::text(std::size_t column) const {
  std::string text(fields_[column]);
  for (auto at = text.find("\"\""); at != std::string::npos; at = text.find("\"\"", at + 1))
    text.erase(at, 1);
  return text;
}

int CsvTable::integer(std::size_t column) const {
  const std::int64_t value = reader_.integer(fields_[column]);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    reject(column, "the integer is too large", "use one below 2^31");
  return static_cast<int>(value);
}

}  // namespace wishbone

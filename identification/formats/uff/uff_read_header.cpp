#include <algorithm>
#include <string>
#include <vector>

#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {

/// Seven lines of 80 characters; programs leave out the last ones.
void read_uff_header(UffInput& in, UffContents& contents) {
  UffHeader header;
  const std::vector<std::string*> lines = {&header.model,   &header.description, &header.database_program,
                                           &header.created, &header.saved,       &header.program,
                                           &header.written};
  for (std::size_t k = 0; in.advance_in_dataset(); ++k)
    if (k < lines.size()) *lines[k] = without_trailing_blanks(in.text());
  if (!contents.file.header) contents.file.header = header;
}

/// I10,20A1,I10 / 3D25.17 / D25.17. The description may stand right behind the code, the temperature mode be
/// left out.
void read_uff_units(UffInput& in, UffContents& contents) {
  UffUnits units;
  const std::string_view line = in.require_filled("the units code");
  const std::string_view code = trimmed(line);
  const std::size_t code_begin = static_cast<std::size_t>(code.data() - line.data());
  const std::size_t code_end = std::min(line.find_first_not_of("0123456789", code_begin), line.size());
  units.code = integer_field(in, line.substr(code_begin, code_end - code_begin), "the units code");
  if (units.code < 1 || units.code > 10)
    in.fail_line("the units code must be 1 to 10", "use 1 for SI, 9 for units of one's own");
  units.description = trimmed(columns(line, code_end, std::max<std::size_t>(30, code_end) - code_end));
  units.temperature_mode = integer_in(columns(line, 30, 10)).value_or(1);

  std::vector<double> factors;
  while (in.advance_in_dataset()) append_reals(in, 25, "a unit factor", factors);
  if (factors.size() < 2 || factors.size() > 4)
    in.fail("expected factors of length, force and temperature and a temperature offset",
            std::to_string(factors.size()) + " numbers", "write the three records of dataset 164");
  if (!(factors[0] > 0 && factors[1] > 0))
    in.fail("the factors of length and force must be positive",
            std::to_string(std::min(factors[0], factors[1])), "write how many file units make one SI unit");
  units.length = factors[0];
  units.force = factors[1];
  if (factors.size() > 2) units.temperature = factors[2];
  if (factors.size() > 3) units.temperature_offset = factors[3];
  if (contents.file.units &&
      (contents.file.units->length != units.length || contents.file.units->force != units.force))
    in.fail("the file has two units datasets that differ", "", "write all of it in one system of units");
  contents.file.units = units;
}

}  // namespace wishbone

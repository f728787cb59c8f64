#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/yaml.h"
#include "identification/identify.h"

namespace wishbone {

/// An identification as the user asked for it, its data read.
struct LoadedIdentification {
  IdentificationTask task;
  std::vector<std::string> files;  ///< that it came from
  Source where;                    ///< the section
};

/// Reads a file whose section `identification` is described in docs/identification.md; includes, parameters and
/// expressions are those of scenes.
/// @throws InputError for the first thing that is wrong, in it or in the files that it names
LoadedIdentification load_identification(const std::filesystem::path& path,
                                         const std::vector<std::string>& overrides = {});

/// Reads such a section of a larger document; names of files are relative to the file that it stands in.
/// `own_model`: model of the structure unless the section has its own; may be null.
LoadedIdentification read_identification(const Value& section, const AnalyticalModel* own_model);

}  // namespace wishbone

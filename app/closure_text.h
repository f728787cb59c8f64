#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/run_scene.h"

namespace wishbone {

/// "0.001 m, 2e-05 rad"; "closed" when nothing is left of it but rounding.
std::string text_of(const ClosureGap& gap);

/// Whether there is more than rounding.
bool is_open(const ClosureGap& gap);

/// Before and after assembling, for programs.
nlohmann::ordered_json json_of(const ClosureGap& given, const ClosureGap& closed);

/// Lines on how the initial pose was closed: which closures were open, by how much, and what is left.
std::vector<std::string> assembly_lines(const AssemblyReport& assembly);

/// Lines on the singular positions that a run went through; of many, the first ones.
std::vector<std::string> passage_lines(const std::vector<NamedPassage>& passages);

}  // namespace wishbone

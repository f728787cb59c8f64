#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/hdf5.h"

namespace wishbone {

/// An attribute as a person reads it: numbers in shortest form, lists separated by commas.
std::string text_of(const hdf5::Value& value);

/// An attribute as JSON: number, text or list of texts.
nlohmann::json json_of(const hdf5::Value& value);

/// JSON as text, indented unless that is negative. A byte that is not UTF-8 (the name of a file may hold one) becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

/// A double as JSON: NaN and infinities, which JSON lacks, as the texts "nan", "inf" and "-inf".
nlohmann::json json_number(double value);

}  // namespace wishbone

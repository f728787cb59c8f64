#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// Reads a Universal File: datasets 15, 18, 55, 58, 58b, 82, 151, 164, 2411, 2412, 2414 (at nodes) and 2420;
/// names the others in `unused`. Reads through a small buffer: memory is that of the contents.
///
/// Takes the dialects of programs in the field: lines that end with LF, CR LF or CR, exponents with D or
/// three digits, columns of the standard or numbers separated by blanks, numbers that touch, rows that are
/// not full, byte counts of binary blocks that are wrong, a delimiter right behind a binary block or on a
/// line of its own, texts that are not ASCII, a byte order mark in front, text between datasets (named in
/// `unused` as dataset 0).
///
/// Throws InputError whose place is "FILE:LINE (byte OFFSET)" (a binary block counts as part of the line in
/// front) for a file that is missing, cut off or not a Universal File, counts that do not fit, numbers that
/// are malformed, infinite or not a number, and nodes or coordinate systems that are defined twice,
/// differently.
UffFile read_uff(const std::filesystem::path& path);
/// The same from a stream that can be repositioned; errors call it `name`.
UffFile read_uff(std::istream& stream, const std::string& name);

}  // namespace wishbone

#pragma once

#include <span>
#include <string>

namespace wishbone {

/// Base64 (RFC 4648, section 4, with padding) of bytes.
std::string base64(std::span<const unsigned char> bytes);

/// Base64 of numbers in single precision, little endian: what `new Float32Array` reads in a browser.
std::string base64_of_floats(std::span<const double> values);

}  // namespace wishbone

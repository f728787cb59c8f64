#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace wishbone {

/// Fills the places {{name}} of a page in one pass, so that what is filled in is not searched again. Every
/// place of the page must be given.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& places);

}  // namespace wishbone

#pragma once

#include <string>
#include <string_view>

namespace wishbone {

/// Text as it may stand in the text or in a quoted attribute of XML and HTML: & < > " become entities.
std::string escape_markup(std::string_view text);

}  // namespace wishbone

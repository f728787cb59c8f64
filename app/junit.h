#pragma once

#include <string>
#include <vector>

#include "app/regression.h"

namespace wishbone {

/// Verdicts as JUnit XML, one test case per signal: what CI systems show as a list of tests.
std::string junit_xml(const std::string& suite, const std::vector<Verdict>& verdicts);

}  // namespace wishbone

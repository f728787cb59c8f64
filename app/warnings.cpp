#include "app/warnings.h"

#include <cstdio>

namespace wishbone {

void print_warnings(const Warnings& warnings) {
  for (const Diagnostic& warning : warnings) std::fputs((warning.warning() + "\n").c_str(), stderr);
}

}  // namespace wishbone

// make_synthetic_run rigid|flexible OUT.h5: a result file to look at the report page with.
#include <string>

#include "app/synthetic_run.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  wishbone::SyntheticRun run;
  run.flexible = std::string(argv[1]) == "flexible";
  wishbone::write_synthetic_run(argv[2], run);
  return 0;
}

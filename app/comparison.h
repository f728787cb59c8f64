#pragma once

#include <string>
#include <vector>

#include "app/difference.h"
#include "solver/result_file.h"

namespace wishbone {

/// Channels that belong under one heading of a report.
struct Section {
  std::string heading;
  struct Entry {
    std::string title;  ///< "front left", "Side slip"
    Channel channel;
  };
  std::vector<Entry> entries;
};

/// What to compare.
struct Choice {
  std::vector<std::string> globs;  ///< signals by path; empty: what a report on a vehicle shows
  bool all = false;                ///< every signal, whatever `globs` say
};

/// What a report shows of two files: without globs the path of the chassis, roll, yaw and side slip,
/// steering, tire deflections, and the two nodes of each flexible body that deflect most. Channels that only
/// one file has are kept. When neither file is a vehicle (nothing of this exists), everything is shown.
std::vector<Section> choose_sections(const ResultFile& a, const ResultFile& b, const Choice& choice);

/// Two files side by side.
struct Comparison {
  CommonTime common_time;
  std::vector<Section> sections;
  std::vector<Difference> differences;    ///< channels of the sections that both files have, in order
  std::vector<std::string> only_in_a;     ///< signals (of the choice) that B lacks
  std::vector<std::string> only_in_b;     ///< signals (of the choice) that A lacks
  std::vector<std::string> incomparable;  ///< signals whose shape or unit differs, and how
};

/// Throws InputError when the files have no time in common or when the globs match nothing.
Comparison compare(const ResultFile& a, const ResultFile& b, const Choice& choice);

}  // namespace wishbone

#pragma once

#include <string>
#include <vector>

#include "app/difference.h"
#include "app/svg/peak_chart_svg.h"
#include "solver/result_file.h"

namespace wishbone {

/// Channels that belong under one heading of a report.
struct Section {
  std::string heading;
  struct Entry {
    std::string title;  ///< "front left", "Side slip"
    Channel channel;
    bool plotted = true;  ///< otherwise in the table only
  };
  std::vector<Entry> entries;
  std::vector<PeakChart> charts;  ///< of the energies of modes
};

/// What to compare.
struct Choice {
  std::vector<std::string> globs;  ///< signals by path; empty: what a report on a vehicle shows
  bool all = false;                ///< every signal, whatever `globs` say
};

/// What a report shows of two files: without globs the path of the chassis, roll, yaw and side slip,
/// steering, tire deflections, and of each flexible body the two nodes that deflect most, its energies with those of its
/// strongest modes, its largest interface forces and recovered quantities. Channels that only one file has are kept. When
/// neither file is a vehicle (nothing of this exists), everything is shown. With globs, or all signals, the largest components
/// alone of signals with many (wide_signal.h) are plotted.
std::vector<Section> choose_sections(const ResultFile& a, const ResultFile& b, const Choice& choice);

}  // namespace wishbone

#pragma once

#include <string>

#include "app/comparison.h"
#include "solver/result_file.h"

namespace wishbone {

/// A file under the name that the report calls it.
struct ReportedFile {
  const ResultFile& file;
  std::string title;
};

/// A page that shows a comparison: overlaid plots by section (zoom by dragging, all time axes move together),
/// the table of differences, and the facts about both runs. Complete in itself: styles, program and data are
/// inside, nothing is loaded. Angles are shown in degrees and small lengths in millimetres; plots carry
/// single precision.
std::string report_html(const ReportedFile& a, const ReportedFile& b, const Comparison& comparison);

}  // namespace wishbone

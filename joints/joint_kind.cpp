#include "joints/joint_kind.h"

#include <array>

namespace wishbone {
namespace {

const JointCoordinateKind kAngle{"angle", true, true, {Gauge::Kind::rotation, 2}};
const JointCoordinateKind kTravel{"travel", false, true, {Gauge::Kind::translation, 2}};
const JointCoordinateKind kX{"x", false, true, {Gauge::Kind::translation, 0}};
const JointCoordinateKind kY{"y", false, true, {Gauge::Kind::translation, 1}};
const JointCoordinateKind kFirst{"first", true, true, {Gauge::Kind::universal_first, 2}};
const JointCoordinateKind kSecond{"second", true, true, {Gauge::Kind::universal_second, 2}};
const JointCoordinateKind kBend1{"bend_x", true, false, {}};
const JointCoordinateKind kBend2{"bend_y", true, false, {}};

/// In the order of JointKind.
const std::array<JointKindInfo, 10>& all_kinds() {
  static const std::array<JointKindInfo, 10> kAll{{{"fixed", 6, {}},
                                                   {"revolute", 5, {kAngle}},
                                                   {"prismatic", 5, {kTravel}},
                                                   {"cylindrical", 4, {kAngle, kTravel}},
                                                   {"screw", 5, {kAngle}},
                                                   {"universal", 4, {kFirst, kSecond}},
                                                   {"constant_velocity", 4, {kBend1, kBend2}},
                                                   {"spherical", 3, {}},
                                                   {"planar", 3, {kX, kY, kAngle}},
                                                   {"free", 0, {}}}};
  return kAll;
}

}  // namespace

const JointKindInfo& info(JointKind kind) {
  return all_kinds()[static_cast<std::size_t>(kind)];
}

const JointKindInfo* find_info(std::string_view name) {
  for (const JointKindInfo& kind : all_kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace wishbone

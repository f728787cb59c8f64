#pragma once

#include "core/yaml.h"
#include "models/scene.h"

/// What a scene says without being wrong, but is most likely not meant: a value in another unit, the same element twice. The
/// evidence must be strong, for an ordinary scene has no doubts.
namespace wishbone::scene_sections {

/// Of a scene that has been read.
Warnings doubts_of(const Scene& scene);

/// Of an angle of an orientation: a plain number beyond a turn. With a unit, or by an expression, it is meant.
void doubt_angle(const Value& angle, Warnings& warnings);

/// Of the position of a joint, which may be many turns: a plain number of 15, 30, 45 ...
void doubt_joint_angle(const Value& angle, Warnings& warnings);

/// Of a damping ratio of modes, or a list of them: a plain number above one. With a unit, as 500 %, or by an expression it is meant.
void doubt_damping(const Value& damping, Warnings& warnings);

}  // namespace wishbone::scene_sections

#pragma once
/// Robot files say what is alike once. Before anybody reads a file it is expanded here into what it would be
/// with everything typed out; each value keeps the line where it was typed. The words, for people:
/// docs/your_robot.md.
///
///   joints:
///     - all: {armature: 0.3 kg m^2}                # first in a list, or a key in a map of maps
///     - {name: fl_hip, ...}
///     - {name: fl_knee, like: fl_hip, ...}         # begins with what another entry of the same list or map
///     says
///   mirror: {leg: fl, left_right: fr}              # at the top of the file: robots/mirror_image.h
///
/// "{name}" in any text of a list's entry is what the entry is called.
/// What an entry says itself wins over what it is like or an image of, and that over `all`; maps are merged
/// key by key, lists and texts replaced.
///
/// What `sprung identify` found of one joint is of no other: where an entry has `identified`, its `friction`,
/// `uncertainty`, `identified` and `torsion` do not go over to what is like it.
#include "robots/yaml_tree.h"

namespace sprung {

/// @param path stands for the file in messages.
/// @throws ConfigError with file and line: `like` a name that there is not, in a circle, `all` that is no map
/// or stands beside what is none, `mirror` a leg that has nothing, `flips` without a mirror, and entries that
/// repeat each other without an end that a robot could have.
void expand(YamlTree& file, const std::string& path);

}  // namespace sprung

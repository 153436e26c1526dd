#pragma once
/// The rule by which one leg of a robot stands for its mirror images. What it does is told in
/// docs/your_robot.md, "Mirrored legs".
#include <string>
#include <vector>

#include "robots/yaml_tree.h"

namespace sprung {

/// One leg that is typed nowhere, or in part: it is `of` seen in a mirror.
struct MirrorImage {
  std::string of;   ///< name of the leg that is typed: "fl"
  std::string leg;  ///< "fr"
  bool left_right = false;
  bool front_hind = false;
  int line = 0;
};

/// Takes the key `mirror` out of the top of a file: {leg: fl, left_right: fr, front_hind: hl, both: hr}, or a
/// list of such maps. @return images as typed; none where the key is missing. @throws ConfigError
std::vector<MirrorImage> take_mirror(YamlTree& file, const std::string& path);

/// Is this the leg's own name, or the name of something of it: "fl" and "fl_hip" of "fl"?
bool is_of_leg(const std::string& name, const std::string& leg) noexcept;

/// The same entry in the image's leg: every word that is of the leg is of the other leg then, and what a
/// mirror turns round is turned round:
///   side, hip_in_trunk    of a leg, by where the image stands
///   direction, link_encoder              of an actuator or drive that says `flips:` in this mirror
///   position, stops, initial, lying      of a joint that does
/// A link encoder that turns the other way round counts from its other end: its offset is one turn further,
/// given to as many decimals as typed, four at least. @throws ConfigError where a value that must be turned
/// round is no number.
YamlTree mirrored(const YamlTree& entry, const MirrorImage& image, const std::string& path);

}  // namespace sprung

#pragma once
/// overlay.yaml beside robot.yaml: numbers that were changed while the robot ran, and kept by `sprung param
/// save`. It says what robot.yaml would say there with everything typed out, and nothing but parameters
/// (robots/parameters.h), in their range:
///
///   presets: {best: {compliance: {stiffness: {z: 3500 N/m}}}}
///   gaits: {trot: {lift: 0.03 m}}
///
/// So what a preset gets by `like:` or `all:` is overridden for that preset alone.
#include <string>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung {

inline constexpr const char* kOverlayFile = "overlay.yaml";
/// Environment variable with another file in its place: the overlay with which a run began (`sprung up`), for
/// all of its processes, also for one that is started again after the file was changed.
inline constexpr const char* kOverlayVariable = "SPRUNG_OVERLAY";

/// Of the robot in that folder; need not be there.
std::string overlay_path(const std::string& folder);

/// Replaces the robot's numbers, and notes them in its `overlay`.
/// @throws ConfigError naming file, line, key and what was expected; what is no parameter is refused.
void apply_overlay(const YamlMap& overlay, RobotConfig& robot);

/// The file of these numbers, that apply_overlay() reads back to the bit.
std::string overlay_text(const std::vector<OverlaidNumber>& numbers);

/// robot.yaml with the overlay beside it as its key `overlay`: one text that is the whole robot, as logs hold
/// it and read_robot_text() takes it. @throws ConfigError where robot.yaml cannot be read.
std::string robot_text(const std::string& folder);
/// robot.yaml alone, of such a text.
std::string without_overlay(const std::string& robot_text);

/// "overlay.yaml: presets.best.stand_length is 0.5 m, robot.yaml: 0.525 m".
std::string overlaid_text(const OverlaidNumber& number);

/// With as many digits as it takes to read the same number back.
std::string exact_text(double value);

}  // namespace sprung

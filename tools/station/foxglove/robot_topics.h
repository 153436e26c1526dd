#pragma once
/// What lets a robot stand in 3-D panels that know Foxglove's messages, beside a log's own channels in an
/// MCAP file: `/tf` (transforms of all bodies, world, and the trunk in it), `/robot` (its shapes, once, each
/// fixed to its body), `/forces` (arrows at the feet: estimated, and the simulation's truth),
/// `/joint_states`, `/wrenches` of the feet, `/imu`. Pure.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "robots/robot_config.h"
#include "tools/logs/log/mcap_export.h"

namespace sprung::station {

/// @param scene of that robot, scene.h; not null. @param model_xml attached; "" = none.
/// Messages are kMost_Hz a second at most.
std::unique_ptr<log::McapAdditions> make_robot_topics(const RobotConfig& robot, const nlohmann::json& scene,
                                                      const std::string& model_xml);

}  // namespace sprung::station

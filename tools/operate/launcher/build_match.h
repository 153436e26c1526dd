#pragma once
/// Whether a process may run together with this launcher: same version, build, message types, robot.yaml and
/// preset. Pure.
#include <cstdint>
#include <string>

#include "sprung_msgs/process_status_t.hpp"

namespace sprung {

/// What every process of a run has in common.
struct BuildIdentity {
  std::string version;
  std::string git_hash;
  std::int64_t types_hash = 0;
  std::int64_t configuration_hash = 0;
  std::string robot;
  std::string clock;
};

BuildIdentity identity_of(const sprung_msgs::process_status_t& status);

/// One sentence that names process, host, what differs, both values and what to do; empty where nothing
/// differs.
/// @param mixed_builds two builds of one version with the same messages and configuration are let through:
/// for developers.
std::string why_not_together(const BuildIdentity& ours, const sprung_msgs::process_status_t& theirs,
                             bool mixed_builds);

}  // namespace sprung

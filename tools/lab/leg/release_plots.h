#pragma once
/// Plots that every foot return has: the error of each pull, and the foot's path and distance from home after
/// the strongest pull of each direction.
#include <string>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/leg/foot_return_score.h"

namespace sprung {

/// One case. Pulls come by direction, kPullsADirection each, the strongest last; traces in the same order.
struct ReleasedFoot {
  std::string name;
  std::vector<PullResult> pulls;
  const std::vector<PullTrace>* traces = nullptr;
};
inline constexpr std::size_t kPullsADirection = 5;

/// @param pulls_axis what the pulls are, e.g. "pull, eight directions of five forces".
report::Plot release_error_plot(const std::vector<ReleasedFoot>& cases, const std::string& pulls_axis);
report::Plot release_path_plot(const ReleasedFoot& foot);
/// @param time_axis what time counts from.
report::Plot release_distance_plot(const ReleasedFoot& foot, const std::string& time_axis);

}  // namespace sprung

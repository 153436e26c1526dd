#include "tools/lab/leg/release_plots.h"

#include <cmath>

namespace sprung {
namespace {

using report::Plot;
using report::Series;
using report::Style;

constexpr double kDegreesPerRad = 180.0 / 3.14159265358979323846;

std::string direction_name(const PullResult& pull) {
  return report::number_text(std::round(pull.pull.direction_rad * kDegreesPerRad)) + " degrees";
}

/// A series for the strongest pull of each direction.
template <class Fill>
void add_strongest(const ReleasedFoot& foot, Plot& plot, Fill fill) {
  for (std::size_t i = kPullsADirection - 1; i < foot.traces->size(); i += kPullsADirection) {
    Series series{direction_name(foot.pulls[i]), {}, {}};
    fill((*foot.traces)[i], series);
    plot.series.push_back(series);
  }
}

}  // namespace

Plot release_error_plot(const std::vector<ReleasedFoot>& cases, const std::string& pulls_axis) {
  Plot out{"Foot return error of every pull", {pulls_axis, ""}, {"error", "mm"}};
  int colour = 0;
  for (const ReleasedFoot& foot : cases) {
    Series series{foot.name, {}, {}, Style::kPoints, colour++};
    for (std::size_t i = 0; i < foot.pulls.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(foot.pulls[i].error_mm);
    }
    out.series.push_back(series);
  }
  return out;
}

Plot release_path_plot(const ReleasedFoot& foot) {
  Plot out{"Path of the foot, " + foot.name, {"forward", "mm"}, {"up", "mm"}};
  out.equal_axes = true;
  add_strongest(foot, out, [](const PullTrace& trace, Series& series) {
    for (const PlanePoint& at : trace.foot_m) {
      series.x.push_back(1e3 * at.x_m);
      series.y.push_back(1e3 * at.z_m);
    }
  });
  return out;
}

Plot release_distance_plot(const ReleasedFoot& foot, const std::string& time_axis) {
  Plot out{"Distance from home, " + foot.name, {time_axis, "s"}, {"distance", "mm"}};
  add_strongest(foot, out, [](const PullTrace& trace, Series& series) {
    series.x = trace.time_s;
    for (const PlanePoint& at : trace.foot_m) series.y.push_back(1e3 * std::hypot(at.x_m, at.z_m));
  });
  return out;
}

}  // namespace sprung

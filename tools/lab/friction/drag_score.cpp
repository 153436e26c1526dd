#include "tools/lab/friction/drag_score.h"

#include <algorithm>
#include <cmath>

namespace sprung {

DragSample between(const DragSample& before, const DragSample& after, double time_s) {
  const double share = (time_s - before.time_s) / (after.time_s - before.time_s);
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {time_s, mix(before.reference_Nm, after.reference_Nm), mix(before.estimate_Nm, after.estimate_Nm),
          mix(before.bound_Nm, after.bound_Nm), mix(before.paper_Nm, after.paper_Nm)};
}

DragScore drag_score(const std::vector<DragSample>& samples) {
  DragScore out;
  out.samples = samples.size();
  double squares = 0.0, paper_squares = 0.0, reference_squares = 0.0, within = 0.0;
  for (const DragSample& s : samples) {
    const double error_Nm = s.estimate_Nm - s.reference_Nm;
    squares += error_Nm * error_Nm;
    paper_squares += (s.paper_Nm - s.reference_Nm) * (s.paper_Nm - s.reference_Nm);
    reference_squares += s.reference_Nm * s.reference_Nm;
    out.max_Nm = std::max(out.max_Nm, std::abs(error_Nm));
    out.mean_Nm += error_Nm;
    within += std::abs(error_Nm) <= s.bound_Nm ? 1.0 : 0.0;
    out.half_width_Nm += s.bound_Nm;
  }
  const auto n = static_cast<double>(samples.size());
  out.rms_Nm = std::sqrt(squares / n);
  out.paper_rms_Nm = std::sqrt(paper_squares / n);
  out.reference_rms_Nm = std::sqrt(reference_squares / n);
  out.mean_Nm /= n;
  out.coverage = within / n;
  out.half_width_Nm /= n;
  return out;
}

}  // namespace sprung

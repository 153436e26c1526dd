#pragma once
/// The result as a page with plots: tools/common/report draws it. Pure.
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// A section for each joint: models compared, parameters, friction over speed with the fit, residuals of the
/// scored part over time, speed, load and position.
report::Report result_report(const std::vector<IdentifiedJoint>& joints, const Provenance& provenance);

}  // namespace sprung::identify

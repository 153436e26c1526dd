#pragma once
/// The result as JSON for scripts. Pure.
#include <string>
#include <vector>

#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// One object. The result of a single joint lies in it; of several each in "joints".
std::string result_json(const std::vector<IdentifiedJoint>& joints, const Provenance& provenance);

}  // namespace sprung::identify

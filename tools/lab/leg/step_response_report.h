#pragma once
/// A step response for people: a table of times and the torques around each step. Pure.
#include "tools/common/report/report.h"
#include "tools/lab/leg/step_response.h"

namespace sprung {

report::Section step_response_section(const StepResponseResult& result);

}  // namespace sprung

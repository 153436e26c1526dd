#pragma once
/// A step response for people: a table of times and the torques around each step. Pure.
#include "tools/experiments/step_response.h"
#include "tools/report/report.h"

namespace sprung {

report::Section step_response_section(const StepResponseResult& result);

}  // namespace sprung

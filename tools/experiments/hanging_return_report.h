#pragma once
#include "tools/experiments/hanging_return.h"
#include "tools/report/report.h"

namespace sprung {

report::Section hanging_return_section(const HangingReturnResult& result);

}  // namespace sprung

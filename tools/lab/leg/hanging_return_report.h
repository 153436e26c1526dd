#pragma once
#include "tools/common/report/report.h"
#include "tools/lab/leg/hanging_return.h"

namespace sprung {

report::Section hanging_return_section(const HangingReturnResult& result);

}  // namespace sprung

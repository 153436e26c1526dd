#pragma once
#include "tools/experiments/stand_push.h"
#include "tools/report/report.h"

namespace sprung {

report::Section stand_push_section(const StandPushResult& result);

}  // namespace sprung

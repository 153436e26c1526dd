#pragma once
#include "tools/common/report/report.h"
#include "tools/lab/gait/stand_push.h"

namespace sprung {

report::Section stand_push_section(const StandPushResult& result);

}  // namespace sprung

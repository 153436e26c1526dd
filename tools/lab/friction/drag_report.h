#pragma once
/// A drag for people: estimate and reference with the stated bound, phase by phase. Pure.
#include "tools/common/report/report.h"
#include "tools/lab/friction/drag.h"

namespace sprung {

report::Section drag_section(const DragResult& result);
/// Scores of every phase, for a terminal.
std::string drag_table(const DragResult& result);

}  // namespace sprung

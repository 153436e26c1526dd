#pragma once
/// A foot return for people: where the foot stops after every pull, with and without compensation, and how it
/// gets there. Pure.
#include "tools/common/report/report.h"
#include "tools/lab/leg/foot_return.h"

namespace sprung {

report::Section foot_return_section(const FootReturnResult& result);

}  // namespace sprung

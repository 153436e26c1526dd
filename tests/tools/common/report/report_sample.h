#pragma once
/// A report with everything that reports can show, of made-up curves.
#include "tools/common/report/report.h"

namespace sprung::report {

/// Six plots; the first one's curves have `samples` samples.
Report sample_report(std::size_t samples);

}  // namespace sprung::report

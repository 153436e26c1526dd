#pragma once
/// Writes a report to disk; the only file of this folder that does.
#include <string>

#include "tools/common/report/report.h"

namespace sprung::report {

/// Makes missing folders and replaces an older file. @throws std::runtime_error naming the path and why it
/// failed.
void write_text(const std::string& text, const std::string& path);
/// Makes missing folders and replaces an older file. @throws std::runtime_error naming the path and why it
/// failed.
void write_report(const Report& report, const std::string& path);

}  // namespace sprung::report

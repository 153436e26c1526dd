#pragma once
/// Text that is safe inside HTML, and numbers as short as they may be.
#include <string>
#include <string_view>
#include <vector>

namespace sprung::report {

/// Between tags and inside quoted attributes.
std::string escape_html(std::string_view text);

/// JSON inside a <script>: "</script>" in a name must not end it.
std::string escape_script(std::string_view json);

/// Each value with six significant digits, and more where the values lie close together far from zero: a plot
/// zooms in on what they span. NaN and infinity stay as they are.
std::vector<double> rounded_for_plot(const std::vector<double>& values);

/// Whether a cell is a number, perhaps with a short unit, or the "-" of a missing one: such columns are set
/// flush right.
bool looks_numeric(std::string_view text);

}  // namespace sprung::report

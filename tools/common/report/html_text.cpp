#include "tools/common/report/html_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "signals/number_text.h"
#include "tools/common/report/report.h"

namespace sprung::report {

namespace {
constexpr std::size_t kLongestUnit = 5;  ///< " Nm/s"
}  // namespace

double hundredths(double value) { return 0.01 * std::round(100.0 * value); }

std::string number_text(double value) { return std::isfinite(value) ? sprung::number_text(value, 5) : "-"; }

std::string escape_html(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

std::string escape_script(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      safe += "\\u003c";
    } else {
      safe += letter;
    }
  }
  return safe;
}

std::vector<double> rounded_for_plot(const std::vector<double>& values) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double value : values) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  const double offset = high > low ? std::max(std::fabs(low), std::fabs(high)) / (high - low) : 1.0;
  const int digits = std::clamp(6 + static_cast<int>(std::floor(std::log10(offset))), 6, 17);
  std::vector<double> rounded;
  rounded.reserve(values.size());
  char text[40];
  for (const double value : values) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    rounded.push_back(std::strtod(text, nullptr));
  }
  return rounded;
}

bool looks_numeric(std::string_view text) {
  if (text == "-") return true;
  if (text.empty() || std::string_view("+-.0123456789").find(text[0]) == std::string_view::npos) return false;
  const std::string owned(text);
  char* end = nullptr;
  std::strtod(owned.c_str(), &end);
  return end != owned.c_str() && std::string_view(end).size() <= kLongestUnit;
}

}  // namespace sprung::report

#pragma once
/// Numbers for people.
#include <cstdio>
#include <string>

namespace sprung {

/// With so many significant digits (1..17) and no zeros behind them: "0.02", "1e-06", "nan", "inf".
inline std::string number_text(double value, int digits = 6) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace sprung

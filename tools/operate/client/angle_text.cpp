#include "tools/operate/client/angle_text.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "signals/angles.h"

namespace sprung {
namespace {

constexpr double kDegree_rad = kPi / 180.0;

}  // namespace

double parse_angle_rad(const std::string& text, const std::string& per) {
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [after, error] = std::from_chars(text.data(), end, value);
  std::string unit(after, end);
  unit.erase(0, unit.find_first_not_of(' '));
  const bool number = error == std::errc() && std::isfinite(value);
  if (number && unit == "rad" + per) return value;
  if (number && unit == "deg" + per) return kDegree_rad * value;
  throw std::invalid_argument("found '" + text + "', expected a number and its unit, as in 0.5rad" + per +
                              " or 30deg" + per);
}

}  // namespace sprung

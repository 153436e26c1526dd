#include "tools/lab/tune/tune_space.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <stdexcept>

#include "robots/preset_section.h"

namespace sprung {

namespace {

double four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::strtod(text, nullptr);
}

std::string ten_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

YamlMap preset_map(const RobotConfig& robot, const std::string& preset) {
  robot.preset(preset);  // refuses a name that is not there
  return YamlMap::load(robot.folder + "/robot.yaml").map("presets").map(preset);
}

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream in(key);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

}  // namespace

double TuneParameter::at(double share) const {
  const double value = logarithmic() ? low * std::pow(high / low, share) : low + share * (high - low);
  return std::clamp(four_digits(value), low, high);
}

double TuneParameter::share_of(double value) const {
  const double inside = std::clamp(value, low, high);
  return logarithmic() ? std::log(inside / low) / std::log(high / low) : (inside - low) / (high - low);
}

TuneParameter parse_vary(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals != std::string::npos && equals > 0 && colon != std::string::npos) {
    char* low_end = nullptr;
    char* high_end = nullptr;
    const double low = std::strtod(text.c_str() + equals + 1, &low_end);
    const double high = std::strtod(text.c_str() + colon + 1, &high_end);
    const bool numbers = colon > equals + 1 && low_end == text.c_str() + colon &&
                         high_end != text.c_str() + colon + 1 && !*high_end;
    if (numbers && std::isfinite(low) && std::isfinite(high) && low < high)
      return {text.substr(0, equals), low, high};
  }
  throw std::invalid_argument(
      "--vary " + text +
      ": expected a key of the preset and a range, as in hybrid_landing.stiffness.z=400:3000");
}

TuneSpace::TuneSpace(const RobotConfig& robot, const std::string& preset,
                     std::vector<TuneParameter> parameters)
    : robot_(robot), preset_(preset), parameters_(std::move(parameters)), map_(preset_map(robot, preset)) {
  if (parameters_.empty())
    throw std::invalid_argument("nothing to tune: give at least one --vary KEY=LOW:HIGH");
  std::set<std::string> keys;
  for (const TuneParameter& parameter : parameters_) {
    if (!keys.insert(parameter.key).second)
      throw std::invalid_argument("--vary " + parameter.key + " is given twice");
    map_.quantity_at(parameter.key);
  }
}

std::vector<double> TuneSpace::present() const {
  std::vector<double> values;
  for (const TuneParameter& parameter : parameters_) values.push_back(map_.quantity_at(parameter.key).first);
  return values;
}

std::string TuneSpace::unit(std::size_t parameter) const {
  return map_.quantity_at(parameters_[parameter].key).second;
}

RobotConfig TuneSpace::with(const std::vector<double>& values) const {
  YamlMap map = map_;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    map = map.with_number_at(parameters_[i].key, values[i]);
  RobotConfig robot = robot_;
  for (PresetConfig& preset : robot.presets) {
    if (preset.name == preset_) preset = robot_sections::read_preset(preset_, map);
  }
  return robot;
}

std::string TuneSpace::fragment(const std::vector<double>& values, const std::string& comment) const {
  std::string text = "# " + comment + "\npresets:\n  " + preset_ + ":\n";
  std::vector<std::string> open;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const std::vector<std::string> parts = parts_of(parameters_[i].key);
    std::size_t common = 0;
    while (common + 1 < parts.size() && common < open.size() && open[common] == parts[common]) ++common;
    for (std::size_t depth = common; depth + 1 < parts.size(); ++depth)
      text += std::string(4 + 2 * depth, ' ') + parts[depth] + ":\n";
    open.assign(parts.begin(), parts.end() - 1);
    const std::string unit_text = unit(i).empty() ? "" : " " + unit(i);
    text += std::string(2 + 2 * parts.size(), ' ') + parts.back() + ": " + ten_digits(values[i]) + unit_text +
            "\n";
  }
  return text;
}

}  // namespace sprung

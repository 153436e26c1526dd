#include "robots/overlay.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "robots/parameters.h"
#include "robots/text_hash.h"
#include "robots/yaml_text.h"
#include "signals/number_text.h"
#include "signals/spelling.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKey = "\noverlay:\n";  // in a robot's whole text

struct OverlaidPlace {
  std::size_t preset = 0;
  Parameter parameter;
};

/// What may stand in an overlay, by its way from the top.
std::map<std::string, OverlaidPlace> places_of(const RobotConfig& robot) {
  std::map<std::string, OverlaidPlace> out;
  for (std::size_t i = 0; i < robot.presets.size(); ++i)
    for (const Parameter& one : parameters_of(robot, robot.presets[i]))
      out.emplace(path_of(one, robot.presets[i].name), OverlaidPlace{i, one});
  return out;
}

std::vector<std::string> names_of_places(const std::map<std::string, OverlaidPlace>& places) {
  std::vector<std::string> out;
  out.reserve(places.size());
  for (const auto& [path, place] : places) out.push_back(path);
  return out;
}

class Overlaying {
 public:
  explicit Overlaying(RobotConfig& robot) : robot_(robot), places_(places_of(robot)) {}

  void apply(const YamlMap& map, const std::string& prefix) {
    for (const YamlKey& key : map.tree().keys) {
      const std::string path = prefix + key.name;
      if (map.tree().find(key.name)->is_map()) {
        apply(map.map(key.name), path + ".");
      } else {
        replace(map, key.name, path);
      }
    }
  }

 private:
  void replace(const YamlMap& map, const std::string& key, const std::string& path) {
    const auto found = places_.find(path);
    if (found == places_.end())
      map.fail(key, "'" + path + "' is no parameter that an overlay may change" +
                        did_you_mean(path, names_of_places(places_)) + "; all of them: sprung param list");
    const auto& [preset, parameter] = found->second;
    const double value = map.quantity(key, parameter.unit, parameter.least, parameter.most);
    AdjustableConfig config = adjustable_of(robot_, robot_.presets[preset]);
    parameter.at(config) = value;
    robot_.presets[preset] = config.preset;
    robot_.gaits = config.gaits;
    robot_.body = config.body;
    note({path, parameter.unit, parameter.file, value});
  }

  void note(const OverlaidNumber& number) {
    for (OverlaidNumber& known : robot_.overlay)
      if (known.path == number.path) return void(known = number);
    robot_.overlay.push_back(number);
  }

  RobotConfig& robot_;
  std::map<std::string, OverlaidPlace> places_;
};

YamlTree& branch(YamlTree& tree, const std::string& key) {
  tree.kind = YamlTree::Kind::kMap;
  if (YamlTree* found = tree.find(key)) return *found;
  tree.keys.push_back({key, 0});
  return tree.items.emplace_back();
}

std::string exact_quantity(double value, const std::string& unit) {
  return exact_text(value) + (unit.empty() ? "" : " ") + unit;
}

std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += "  " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return out;
}

}  // namespace

void apply_overlay(const YamlMap& overlay, RobotConfig& robot) {
  Overlaying(robot).apply(overlay, "");
  if (robot.overlay.empty()) return;
  std::string all;
  for (const OverlaidNumber& one : robot.overlay) all += overlaid_text(one);
  robot.overlay_hash = hash_text(all);
}

std::string overlay_text(const std::vector<OverlaidNumber>& numbers) {
  YamlTree top;
  for (const OverlaidNumber& number : numbers) {
    YamlTree* at = &top;
    for (std::size_t begin = 0; begin <= number.path.size();) {
      const std::size_t end = std::min(number.path.find('.', begin), number.path.size());
      at = &branch(*at, number.path.substr(begin, end - begin));
      begin = end + 1;
    }
    at->text = exact_quantity(number.value, number.unit);
  }
  return "# Kept by `sprung param save`: replaces these numbers of robot.yaml. Without this file "
         "robot.yaml's "
         "own hold.\n" +
         (numbers.empty() ? std::string("{}\n") : yaml_text(top));
}

std::string overlay_path(const std::string& folder) {
  const char* const of_run = std::getenv(kOverlayVariable);
  return of_run != nullptr ? std::string(of_run) : (fs::path(folder) / kOverlayFile).string();
}

std::string robot_text(const std::string& folder) {
  std::string robot = text_of_file(fs::path(folder) / "robot.yaml");
  const fs::path overlay = overlay_path(folder);
  if (!fs::exists(overlay)) return robot;
  return robot + kKey + indented(text_of_file(overlay));
}

std::string without_overlay(const std::string& robot_text) {
  return robot_text.substr(0, robot_text.rfind(kKey));
}

std::string overlaid_text(const OverlaidNumber& number) {
  return kOverlayFile + (": " + number.path) + " is " + exact_quantity(number.value, number.unit) +
         ", robot.yaml: " + exact_quantity(number.file, number.unit);
}

std::string exact_text(double value) {
  for (int digits = 6; digits < 17; ++digits) {
    std::string text = number_text(value, digits);
    if (std::strtod(text.c_str(), nullptr) == value) return text;
  }
  return number_text(value, 17);
}

}  // namespace sprung

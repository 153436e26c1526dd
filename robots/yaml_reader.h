#pragma once
/// Strict reading of YAML: every value is asked for with its unit and range, every key must be asked for, and
/// a mistake is named with file, line, key, what was found and what was expected. Start-up only: throws and
/// allocates.
///
///   YamlMap file = YamlMap::load("robots/single_leg/robot.yaml");
///   double ratio = file.quantity("gear_ratio", "", 1, 1000);        // 100
///   double mass = file.quantity("mass", "kg", 0, 100);              // 4.13 kg
///   file.finish();                                                  // refuses keys that nobody asked for
///
/// What a file says by `all`, `like` and `mirror` (robots/yaml_expansion.h) is typed out before anybody asks.
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "robots/yaml_tree.h"

namespace sprung {

/// What a file was asked for so far.
struct YamlQuestions {
  /// Every number with its path, "joints[3].position.min"; optional ones also where they are not there.
  std::set<std::string> numbers;
  /// Optional keys that are not there, by the prefix of their map, "actuators[3].": key, and what was taken
  /// instead; "" where that is nothing, or the reader's own affair.
  std::map<std::string, std::map<std::string, std::string>> defaults;
};

/// @throws ConfigError where it cannot be read.
std::string text_of_file(const std::string& path);

class YamlMap {
 public:
  /// @throws ConfigError when the file cannot be read, is no YAML, or is no map.
  static YamlMap load(const std::string& path);
  /// The same from text; `name` stands for the path in messages.
  static YamlMap parse(const std::string& text, const std::string& name);

  bool has(const std::string& key) const;
  /// "0.26 m": a number, a blank, the unit; unit "" = a bare number. Milliseconds are accepted where "s" is
  /// asked for ("20 ms").
  double quantity(const std::string& key, const std::string& unit, double low, double high) const;
  double quantity_or(const std::string& key, const std::string& unit, double low, double high,
                     double otherwise) const;
  std::vector<double> quantities(const std::string& key, const std::string& unit, double low,
                                 double high) const;
  /// Decimal or 0x hexadecimal.
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high) const;
  std::int64_t integer_or(const std::string& key, std::int64_t low, std::int64_t high,
                          std::int64_t otherwise) const;
  bool flag(const std::string& key) const;
  std::string text(const std::string& key) const;
  std::vector<std::string> texts(const std::string& key) const;
  std::vector<std::vector<double>> matrix(const std::string& key, double low, double high) const;
  YamlMap map(const std::string& key) const;
  std::vector<YamlMap> list(const std::string& key) const;       ///< of maps
  std::vector<std::pair<std::string, YamlMap>> entries() const;  ///< every key as a map, for named sets

  /// Number and unit as they stand at a dotted path below this map, whatever they are: "stiffness.z",
  /// "lengths.4".
  /// @throws ConfigError where the path leads to no number.
  std::pair<double, std::string> quantity_at(const std::string& path) const;
  /// A copy in which that number is another one; its unit stays. @throws ConfigError as quantity_at().
  YamlMap with_number_at(const std::string& path, double value) const;

  /// "robots/x/robot.yaml:12", where the value at this path was typed; entries of lists by place or by name:
  /// "legs[0].links[2].length", "joints[fl_hip].armature". What is not there: its map's place.
  std::string place(const std::string& path) const;

  /// Of the whole file.
  const YamlQuestions& questions() const;
  /// This map, expanded.
  const YamlTree& tree() const;

  /// @throws ConfigError naming the first key that nobody asked for, the nearest known one and all of them.
  void finish() const;
  /// @throws ConfigError at this key's line.
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  struct State;
  explicit YamlMap(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

}  // namespace sprung

#pragma once
/// Which numbers of a preset are varied, and the robot with other numbers. Reads robot.yaml.
#include <string>
#include <utility>
#include <vector>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"

namespace sprung {

/// A key below a preset of robot.yaml and the range in which it is looked for, in the unit that the file
/// gives it.
struct TuneParameter {
  std::string key;  ///< "hybrid_landing.stiffness.z", "jump_curve.lengths.4" (from 0)
  double low = 0.0;
  double high = 0.0;

  /// Ratios count, not differences: a range above zero whose ends are a factor of 4 or more apart.
  bool logarithmic() const { return low > 0.0 && high >= 4.0 * low; }
  /// @param share 0 ... 1 of the range. Four significant digits, so that robot.yaml holds what was tried.
  double at(double share) const;
  double share_of(double value) const;  ///< the reverse, within 0 ... 1
};

/// "hybrid_landing.stiffness.z=400:3000". @throws std::invalid_argument saying what is expected.
TuneParameter parse_vary(const std::string& text);

class TuneSpace {
 public:
  /// @throws ConfigError for a key that is no number of the preset, std::invalid_argument for none or one
  /// twice.
  TuneSpace(const RobotConfig& robot, const std::string& preset, std::vector<TuneParameter> parameters);

  const std::vector<TuneParameter>& parameters() const { return parameters_; }
  const std::string& preset() const { return preset_; }
  std::vector<double> present() const;  ///< as robot.yaml has them
  std::string unit(std::size_t parameter) const;
  /// @throws ConfigError where robot.yaml may not hold these values.
  RobotConfig with(const std::vector<double>& values) const;
  /// The keys as robot.yaml would hold them, nested; each line below `comment`.
  std::string fragment(const std::vector<double>& values, const std::string& comment) const;

 private:
  RobotConfig robot_;
  std::string preset_;
  std::vector<TuneParameter> parameters_;
  YamlMap map_;
};

}  // namespace sprung

#pragma once
/// Zeros that `sprung home` found, kept over a restart: one YAML file a robot. Only an absolute motor encoder
/// keeps its count without power, so only such an actuator gets its stored zero back, and only when
/// everything that it hangs on still stands in robot.yaml as it did then. A drive that was swapped is noticed
/// only where robot.yaml names serials. Not for the loop.
///
///   robot: pegasus
///   robot_hash: 1234            # of robot.yaml, for the record
///   actuators:
///     - name: front_left_knee
///       date: 2026-11-21T06:00:00Z
///       method: link
///       offset: 0.1234 rad      # actuator position = encoder position + offset
///       counts: 4321            # encoder counts then, for the record
///       device: ...             # bus, node, profile, identity, gear, encoders, offset, reference
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/bridge/bridge_core.h"
#include "robots/robot_config.h"

namespace sprung {

/// $SPRUNG_STATE_DIR, else ~/.local/state/sprung. A simulated robot has a file of its own, so that it never
/// gives a real one its zero. @return "" when neither variable nor home is known.
std::string reference_file(const std::string& robot, bool simulation);

class ReferenceStore {
 public:
  /// Reads the file; none is no mistake. Says in the log which of its zeros are not used.
  /// @throws ConfigError naming file, line, mistake and remedy. Nothing is restored then.
  ReferenceStore(std::string path, const RobotConfig& robot);

  /// @return the zero to restore, if there is a good one.
  std::optional<Reference> good_for(std::size_t actuator) const;
  /// "" when the stored zero is used, or there is none.
  std::string why_not_used(std::size_t actuator) const;
  /// How many days ago a zero that is used was found, where that is more than its `max_age_days`; else 0.
  /// @param today beginning with YYYY-MM-DD.
  long doubtful_days(std::size_t actuator, const std::string& today) const;
  void record(std::size_t actuator, const Reference& reference, std::int64_t counts,
              const std::string& date_utc);
  /// Writes a new file and puts it in the old one's place, so that a power cut leaves one of the two.
  /// @throws std::runtime_error naming the file and the reason.
  void save() const;
  const std::string& path() const { return path_; }

 private:
  struct Entry {
    std::string date_utc;
    std::string device;
    ReferenceSource source = ReferenceSource::kConfigured;
    double offset_rad = 0.0;
    std::int64_t counts = 0;
  };
  void read();
  std::string text() const;

  std::string path_;
  const RobotConfig& robot_;
  std::vector<std::optional<Entry>> entries_;  ///< by actuator
};

}  // namespace sprung

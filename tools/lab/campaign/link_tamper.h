#pragma once
/// Does on the links of a robot in this process what injections of the classes message, field and foreign
/// say.
#include <cstdint>
#include <random>
#include <vector>

#include "simulation/in_process/in_process_links.h"
#include "tools/lab/campaign/injection.h"

namespace sprung::campaign {

/// How many numbers of a message a field injection chooses between.
int fields_of(Link link) noexcept;

class LinkTamper : public InProcessLinks {
 public:
  /// @param seed of shares that are drawn message by message.
  LinkTamper(const RobotConfig& robot, std::uint64_t seed);

  /// From now on too; its at_seq is set.
  void add(const Injection& injection) { injections_.push_back(injection); }
  /// Cycle that runs now.
  void at(std::int64_t seq) noexcept { seq_ = seq; }

  bool pass(DriveState& message) noexcept override;
  bool pass(JointState& message) noexcept override;
  bool pass(LegCommand& message) noexcept override;
  bool pass(DriveCommand& message) noexcept override;
  bool pass(Imu& message) noexcept override;
  void add_foreign(FrameBatch& frames) noexcept override;

 private:
  static constexpr std::size_t kHistory = 64;
  template <class Signal>
  struct History {
    std::vector<Signal> ring = std::vector<Signal>(kHistory);
    std::int64_t count = 0;
    Signal first;  ///< of a repetition
    std::int64_t repeats_since = -1;
  };
  template <class Signal>
  bool pass_by(Link link, Signal& message, History<Signal>& history) noexcept;
  template <class Signal>
  static bool take_back(std::int64_t cycles, Signal& message, const History<Signal>& history) noexcept;
  template <class Signal>
  bool disturb(const Injection& injection, Signal& message, History<Signal>& history) noexcept;
  void add_foreign(const Injection& injection, FrameBatch& frames) noexcept;

  const RobotConfig& robot_;
  std::vector<Injection> injections_;
  std::mt19937_64 random_;
  std::int64_t seq_ = -1;
  History<DriveState> drive_states_;
  History<JointState> joint_states_;
  History<LegCommand> leg_commands_;
  History<DriveCommand> drive_commands_;
  History<Imu> imus_;
};

}  // namespace sprung::campaign

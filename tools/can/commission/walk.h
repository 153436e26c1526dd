#pragma once
/// The checked walk from a factory drive to `home`, one drive at a time: what can be read comes first, then
/// what needs a hand, then little current. What differs ends the walk before power, since torque rests on all
/// of it. Only what the bus and the person say is known here.
///
/// With power, whatever happens (Ctrl-C, a lost drive, a wrong way): power off, and what was written for the
/// drive's own supervision is put back. The drive watches this master's heartbeat meanwhile.
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/canopen/eds.h"
#include "drivers/profiles/drive_profile.h"
#include "robots/robot_config.h"
#include "tools/can/commission/current_step.h"
#include "tools/can/commission/drive_port.h"
#include "tools/can/commission/protocol.h"
#include "tools/can/commission/travel_probe.h"

namespace sprung::commission {

struct WalkOptions {
  bool write = false;     ///< offers to write what differs and may be written
  bool power = true;      ///< false: ends before the first current
  double turn_rad = 0.2;  ///< that the joint is asked to be turned by hand
};

class Walk {
 public:
  /// Of the cap on torque: robot.yaml's breakaway friction of the joint, then the measured one.
  static constexpr double kCapShare = 1.35;
  static constexpr double kBound_rad = 0.045;  ///< of motion under power

  /// @throws std::invalid_argument on values that a profile cannot hold. All must outlive the walk.
  Walk(const RobotConfig& robot, int actuator, const DriveTiming& timing, const WalkOptions& options,
       DrivePort& port, Person& person);
  Protocol run();

 private:
  struct DriveLost : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  struct Ended {};  ///< what differs leaves no sense in going on
  struct Sample {
    double position_rad = 0.0, current_A = 0.0;
    std::uint16_t status = 0;
  };
  struct Backup {
    canopen::ObjectId object;
    std::vector<std::uint8_t> bytes;
  };

  // walk.cpp
  void step(const char* name, void (Walk::*work)());
  void all_steps();
  void begin_step(const char* name);
  void end_step();
  void finding(Finding one) { current_.findings.push_back(std::move(one)); }
  void check_drive();
  bool any_difference() const;
  SdoAnswer ask_drive(canopen::ObjectId object);
  std::optional<std::int64_t> number(canopen::ObjectId object, bool is_signed);
  bool write(canopen::ObjectId object, std::int64_t value, int size);
  std::string value_text(canopen::ObjectId object, std::int64_t value, int size) const;
  std::string named(canopen::ObjectId object) const;
  double ask(Ask what, std::string text, double suggested);

  // walk_reading.cpp
  void node_id();
  void identity();
  void errors();
  void reset_fault();
  void supply();
  void stored();
  void motor() { topic(CommissioningTopic::kMotor); }
  void encoder() { topic(CommissioningTopic::kEncoder); }
  void current_gains() { topic(CommissioningTopic::kCurrentLoop); }
  void limits() { topic(CommissioningTopic::kLimits); }
  void bus_settings();
  void topic(CommissioningTopic which);
  void compare(const CommissioningObject& wanted);
  bool offer_to_write(const CommissioningObject& wanted, const std::string& found);
  void store_written();

  // walk_hand.cpp
  void brake();
  void emergency_input();
  std::optional<bool> emergency_level();
  void turned_by_hand();
  void judge_turn(const char* what, double moved_rad, double told_rad, const char* remedy);
  std::optional<double> link_rad();
  double position_rad();

  // walk_power.cpp
  void power();
  void current_step();
  void commutation();
  void torque_constant();
  void switch_on();
  void switch_off() noexcept;
  bool take_power();
  void put_back(bool off);
  void set_for_now(canopen::ObjectId object, std::int64_t value, int size);
  void set_torque(double torque_Nm);
  double measured_A();
  Sample sample();
  void require_enabled(const Sample& now);
  void require_bounded(double current_A);
  TravelProbe travel(double direction, double cap_Nm);
  void judge_travel(const TravelProbe& probe, double direction, double cap_Nm);
  TravelProbe against_load(double direction, const TravelProbe& other, double& cap_Nm);
  void compare_link(std::optional<double> before, double motor_moved_rad);
  std::vector<CurrentSample> record_current(double seconds);
  bool moves_both_ways(double cap_Nm, double& mean_Nm);

  const RobotConfig& robot_;
  const ActuatorConfig& actuator_;
  const JointConfig& joint_;
  WalkOptions options_;
  DrivePort& port_;
  Person& person_;
  std::unique_ptr<DriveProfile> profile_;
  CommissioningPlan plan_;
  canopen::Eds eds_;
  Protocol protocol_;
  Step current_;
  int boot_ups_ = 0;
  std::vector<Backup> backups_;
  std::vector<std::string> values_written_;
  bool powered_ = false;
  double powered_from_rad_ = 0.0;
  double friction_Nm_ = 0.0;  ///< breakaway: robot.yaml's, then measured
  double mean_Nm_ = 0.0;      ///< sliding torque of both ways, without the weight
  double hardest_Nm_ = 0.0;   ///< breakaway of the way that takes more
};

}  // namespace sprung::commission

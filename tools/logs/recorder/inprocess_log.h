#pragma once
/// The log of a robot in this process, as the recorder would have written it: the same messages, each cycle
/// in the order in which they are made. Shell: writes a file.
#include <cstdint>
#include <memory>
#include <string>

#include "signals/operator.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tools/logs/recorder/recording.h"

namespace sprung {

class InProcessLog : public InProcessObserver {
 public:
  /// Messages are stamped with the robot's own time, so the same run gives the same bytes.
  /// @param command_line for LOG_METADATA. @throws log::WriteError where the file cannot be made.
  InProcessLog(const std::string& path, const RobotConfig& robot, const std::string& preset,
               const std::string& command_line);
  ~InProcessLog() override;  ///< ends the log

  void on_command(const OperatorCommand& command) override;
  void on_cycle(const InProcessRobot& robot) override;
  void on_reply(const OperatorReply& reply) override;

 private:
  template <class Signal>
  void write(const char* channel, const Signal& signal);

  std::int64_t time_us_ = 0;
  std::vector<std::uint8_t> bytes_;
  Recording recording_;
};

/// One log for each robot that is made: FOLDER/ROBOT-000.lcm, -001, ...; makes the folder. Where robots run
/// in several threads, their numbers are in no order.
/// @param command_line for LOG_METADATA; the words of the robot's plant follow it.
InProcessRobot::ObserverSource logs_into(const std::string& folder, const std::string& command_line);

}  // namespace sprung

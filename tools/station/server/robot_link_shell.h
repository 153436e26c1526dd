#pragma once
/// The live page's end of a robot's LCM network: an ordinary operator with the run's key. It keeps the newest
/// message of each channel, and decodes what is asked for when it is asked for: 25 of some 4000 a second.
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/operator.h"
#include "tools/operate/client/status_report.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/frames/frames.h"
#include "tools/station/server/request_desk.h"

namespace sprung::station {

/// As this run has it: its preset, and what maintenance allows. @throws ConfigError as load_robot().
RobotConfig robot_of(const RunInfo& info);

/// The newest message of a channel, as it came.
class NewestBytes {
 public:
  void put(const std::uint8_t* data, std::size_t size);
  /// @param version of what the caller has; set. @return false where there is nothing newer.
  bool get(std::int64_t& version, std::vector<std::uint8_t>& out) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::uint8_t> bytes_;
  std::int64_t version_ = 0;
};

class RobotLink {
 public:
  /// Listens from here on. @throws std::runtime_error where key or network cannot be had, saying what to do.
  RobotLink(const RunInfo& info, const RobotConfig& robot);
  ~RobotLink() { node_.stop(); }
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  std::int64_t utime_us() const noexcept { return node_.utime_us(); }
  /// Stamped with now: a command that is said again is a new message.
  void say(OperatorCommand command);

  std::vector<RobotAnswer> take_answers();
  /// The newest; false where it is the one of before.
  bool drives(DriveState& out);
  bool joints(JointState& out);
  /// What `sprung status` tells, of now.
  const HeardRobot& hear();
  /// One row of what is to be drawn, of now; nullptr where nothing has come since.
  const Frame* frame();
  const std::vector<FrameField>& frame_fields() const noexcept { return frames_.fields(); }

  /// Who has read what of a channel.
  struct Reader {
    std::string channel;
    std::int64_t version = 0;
  };
  /// What the reader has not had yet: the channel's newest message; nullptr where there is nothing newer.
  /// Valid until the next call of any function.
  const std::vector<std::uint8_t>* newest(Reader& reader) { return newer(reader) ? &bytes_ : nullptr; }
  /// Each with the name of its type.
  static const std::vector<std::pair<std::string, std::string>>& channels_heard();

 private:
  /// @param rest_us as Node::on_bytes().
  template <class M>
  void listen_to(const char* channel, std::int64_t rest_us, const CountLimits& limits);
  /// What the reader has not had yet. @return whether there is.
  bool newer(Reader& reader);
  template <class M>
  bool newer(Reader& reader, M& out);

  std::map<std::string, NewestBytes> newest_;
  std::vector<std::uint8_t> bytes_;
  Frames frames_;
  std::vector<Reader> frame_readers_;
  Reader drive_reader_, joint_reader_, motion_reader_, safety_reader_, bus_reader_, auxiliary_reader_,
      heard_joint_reader_;
  sprung_msgs::drive_state_t drive_message_;
  sprung_msgs::joint_state_t joint_message_;
  InputQueue<sprung_msgs::process_status_t> processes_{256};
  InputQueue<sprung_msgs::operator_reply_t> replies_{256};
  HeardRobot heard_;
  Node node_;
  Publisher<OperatorCommand> commands_;
};

}  // namespace sprung::station

#pragma once
/// One row of numbers for each cycle from the messages of a robot, of a log or of a network alike. Pure:
/// bytes in, numbers out.
///
///   Frames frames(robot);
///   if (const Frame* done = frames.add(channel, data, size, time_s)) send(*done);
///   if (const Frame* last = frames.finish()) send(*last);   // at the end of a log
///
/// A frame is finished when the first message of a later cycle comes in. A channel's message that is not
/// newer than its last one (a repeat) is left out, and so is what was sent before cycle 0. What no message of
/// this session has said is NaN; what comes less often than once a cycle stays as it was last said.
/// A message of another version of its type is counted (sources()), and is as if it had not come.
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/leg_kinematics.h"
#include "robots/robot_config.h"
#include "tools/logs/fields/decoder.h"
#include "tools/station/frames/frame_fields.h"
#include "tools/station/frames/trunk_pose.h"

namespace sprung::station {

struct Frame {
  double time_s = 0.0;    ///< as handed in with the cycle's first message
  std::int64_t seq = -1;  ///< cycle
  std::int64_t session = 0;
  std::vector<float> values;  ///< one for each of frame_fields(), NaN = not measured
};

class Frames {
 public:
  /// A channel that fields come from.
  struct Source {
    std::string channel;
    bool every_cycle = true;   ///< false: SAFETY_STATE, AUXILIARY_STATE, BODY_STATE, whose messages begin no
                               ///< cycle
    std::int64_t seq = -1;     ///< of its newest message
    std::int64_t decoded = 0;  ///< messages
    std::int64_t not_decoded = 0;  ///< whose type is none of this version's nor of one before
  };

  explicit Frames(const RobotConfig& robot);

  const std::vector<FrameField>& fields() const noexcept { return fields_; }
  /// @param time_s of the message, by any clock that goes forward.
  /// @return the finished frame of the cycle before, valid until the next call; else nullptr.
  const Frame* add(std::string_view channel, const std::uint8_t* data, std::size_t size, double time_s);
  /// The frame that is begun, finished as it is; nullptr where there is none.
  const Frame* finish();
  const std::vector<Source>& sources() const noexcept { return sources_; }
  /// Whether it says where any joint is; without that nothing may be drawn.
  bool has_pose(const Frame& frame) const;

 private:
  /// Where the fields of one shape of one channel's messages go.
  struct Shape {
    std::shared_ptr<const fields::Layout> layout;  ///< kept, so that no other gets its address
    std::vector<std::pair<int, int>> moves;        ///< index in the message, index in the frame
  };
  struct Leg {
    std::unique_ptr<LegKinematics> kinematics;
    std::vector<int> joints;
    int foot = -1;  ///< index of estimated_foot_in_hip_m.x; y and z follow
    int desired_foot = -1, desired_joint = -1, control_mode = -1;
  };

  Source* source_of(std::string_view channel);
  const Shape& shape_of(const std::string& channel);
  bool is_news(Source& source, const Stamp& stamp);
  void begin_session(std::int64_t session);
  void read(const Source& source);
  const Frame* close();
  void place_trunk();
  void place_ghost();
  std::optional<JointVector> desired_of(const Leg& leg) const;
  double value(int field) const { return working_[static_cast<std::size_t>(field)]; }
  Eigen::Vector3d vector(int field) const { return {value(field), value(field + 1), value(field + 2)}; }
  Eigen::Quaterniond quaternion(int field) const;

  std::vector<FrameField> fields_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::unordered_map<const fields::Layout*, Shape> shapes_;
  std::vector<Source> sources_;
  std::vector<Leg> legs_;
  TrunkPose trunk_;
  int true_position_, true_attitude_, attitude_, velocity_, height_;  ///< indices of their first field
  int odometry_, odometry_attitude_;
  int trunk_field_, ghost_field_;
  std::vector<int> position_fields_;  ///< of each joint
  std::vector<double> working_;       ///< of the cycle that is being filled
  bool open_ = false;
  double time_s_ = 0.0;
  std::optional<double> last_time_s_;  ///< of the frame before, of this session
  std::int64_t seq_ = -1;
  std::int64_t session_ = 0;
  Frame done_;
};

}  // namespace sprung::station

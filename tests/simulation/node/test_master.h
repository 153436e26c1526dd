#pragma once
/// A minimal CANopen master by hand, for tests of the simulated drives: it boots them with the PDO map of
/// design section 5 and keeps what they answer. Independent of the bridge on purpose.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "signals/simulation.h"
#include "simulation/sim_core.h"
#include "tests/support/paths.h"

namespace sprung::sim {

inline RobotConfig shipped(const std::string& name) {
  return load_robot(test::source_dir() + "/robots/" + name);
}
inline RobotConfig single_leg() { return shipped("single_leg"); }

struct DriveAnswer {
  std::int32_t position_counts = 0;
  int torque_per_mille = 0;
  int status_word = 0;
  int mode = 0;
  int tpdo1_count = 0;
  int tpdo2_count = 0;
  std::vector<int> emergencies;
  std::vector<int> nmt_states;  ///< boot-up and heartbeats
  bool operator==(const DriveAnswer& other) const {
    return position_counts == other.position_counts && torque_per_mille == other.torque_per_mille &&
           status_word == other.status_word && mode == other.mode;
  }
};

struct SetPoint {
  int torque_per_mille = 0;
  std::int32_t position_counts = 0;
  int mode = 10;
};

class SimMaster {
 public:
  /// @param config a robot of Gold drives on one bus.
  explicit SimMaster(const SimOptions& options = {}, const RobotConfig& config = single_leg())
      : robot(config), sim(robot, options) {}

  void queue(const CanFrame& frame) { burst_.push(0, frame); }
  /// One 1 ms tick: what is queued, the heartbeat, SYNC, and the answers.
  void tick() {
    if (heartbeat) queue(canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational));
    queue(canopen::sync_frame());
    const std::int64_t sync_us = time_us + 1000;
    sim.receive_burst(burst_, time_us, sync_us);
    burst_.clear();
    out_.clear();
    sim.advance_to(sync_us, out_);
    time_us = sync_us;
    for (const BusFrame& entry : out_) {
      entry.frame.error ? error_frames.push_back(entry.frame) : note(entry.frame);
    }
  }
  void ticks(int count) {
    while (count-- > 0) tick();
  }
  /// Sends set-points for every drive each tick.
  void drive(int count, const std::map<int, SetPoint>& set_points) {
    while (count-- > 0) {
      for (const auto& [node, point] : set_points) queue(rpdo1(node, point));
      tick();
    }
  }

  /// SDO download. @return 0 or the abort code.
  std::uint32_t write(int node, std::uint16_t index, int sub, std::uint32_t value, int size) {
    queue(canopen::sdo_write_request(node, {index, static_cast<std::uint8_t>(sub)}, value, size));
    return transfer().kind == canopen::SdoKind::kAbort ? reply_.value : 0;
  }
  /// SDO upload. @return the value, or the abort code with kind kAbort in last_reply().
  std::uint32_t read(int node, std::uint16_t index, int sub = 0) {
    queue(canopen::sdo_read_request(node, {index, static_cast<std::uint8_t>(sub)}));
    return transfer().value;
  }
  const canopen::SdoMessage& last_reply() const { return reply_; }

  void map_pdo(int node, std::uint16_t communication, std::uint32_t cob_id, int type,
               const std::vector<std::uint32_t>& entries) {
    const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
    EXPECT_EQ(write(node, communication, 1, cob_id | canopen::kPdoInvalid, 4), 0U);
    EXPECT_EQ(write(node, communication, 2, static_cast<std::uint32_t>(type), 1), 0U);
    EXPECT_EQ(write(node, mapping, 0, 0, 1), 0U);
    int sub = 0;
    for (const std::uint32_t entry : entries) EXPECT_EQ(write(node, mapping, ++sub, entry, 4), 0U);
    EXPECT_EQ(write(node, mapping, 0, static_cast<std::uint32_t>(sub), 1), 0U);
    if (sub > 0) {
      EXPECT_EQ(write(node, communication, 1, cob_id, 4), 0U);
    }
  }
  void configure(int node) {
    const auto id = static_cast<std::uint32_t>(node);
    map_pdo(node, 0x1800, 0x180 + id, 1, {0x60640020, 0x60770010, 0x60410010});
    map_pdo(node, 0x1801, 0x280 + id, 1, {0x60610008});
    map_pdo(node, 0x1802, 0x380 + id, 255, {});
    map_pdo(node, 0x1803, 0x480 + id, 255, {});
    map_pdo(node, 0x1400, 0x200 + id, 255, {0x60710010, 0x607A0020, 0x60600008});
    map_pdo(node, 0x1401, 0x300 + id, 255, {0x60400010});
    EXPECT_EQ(write(node, canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4), 0U);
    EXPECT_EQ(write(node, canopen::kHeartbeatProducer, 0, 5, 2), 0U);
    EXPECT_EQ(write(node, canopen::kAbortConnectionOption, 0, 2, 2), 0U);
  }
  /// Both drives configured and NMT operational; power off.
  void boot() {
    ticks(2);
    for (const ActuatorConfig& actuator : robot.actuators) configure(actuator.node);
    queue(canopen::nmt_frame(canopen::NmtCommand::kStart, 0));
    ticks(2);
  }
  void control_word(int word) {
    for (const ActuatorConfig& actuator : robot.actuators) {
      CanFrame frame{canopen::rpdo_id(1, actuator.node), 2, {}, false};
      canopen::put_le(frame.data.data(), static_cast<std::uint32_t>(word), 2);
      queue(frame);
    }
    tick();
  }
  void enable() {
    for (const int word : {0x06, 0x07, 0x0F}) control_word(word);
    tick();
  }
  static CanFrame rpdo1(int node, const SetPoint& point) {
    CanFrame frame{canopen::rpdo_id(0, node), 7, {}, false};
    canopen::put_le(frame.data.data(), static_cast<std::uint32_t>(point.torque_per_mille), 2);
    canopen::put_le(frame.data.data() + 2, static_cast<std::uint32_t>(point.position_counts), 4);
    frame.data[6] = static_cast<std::uint8_t>(point.mode);
    return frame;
  }
  void control(SimControlKind kind, int actuator, double value) {
    SimControl control;
    control.kind = kind;
    control.actuator = actuator;
    control.value = value;
    sim.control(control);
  }
  /// @param actuator -1 = bus 0 and all its nodes.
  void fault(FaultKind kind, int actuator, double value = 0.0, double duration_s = 0.0) {
    SimControl control;
    control.kind = SimControlKind::kNodeFault;
    control.fault = kind;
    control.actuator = actuator;
    control.bus = 0;
    control.value = value;
    control.duration_s = duration_s;
    sim.control(control);
  }
  bool powered(int node) const { return (drives.at(node).status_word & 0x6F) == 0x27; }

  RobotConfig robot;
  SimCore sim;
  std::map<int, DriveAnswer> drives;
  std::vector<CanFrame> error_frames;
  std::int64_t time_us = 0;
  bool heartbeat = true;

 private:
  const canopen::SdoMessage& transfer() {
    reply_ = {};
    tick();
    EXPECT_NE(reply_.kind, canopen::SdoKind::kInvalid) << "no SDO reply";
    return reply_;
  }
  void note(const CanFrame& frame) {
    DriveAnswer& drive = drives[static_cast<int>(frame.id & 0x7F)];
    const std::uint8_t* data = frame.data.data();
    switch (frame.id & 0x780) {
      case 0x180:
        drive.position_counts = static_cast<std::int32_t>(canopen::get_le(data, 4));
        drive.torque_per_mille = static_cast<std::int16_t>(canopen::get_le(data + 4, 2));
        drive.status_word = static_cast<int>(canopen::get_le(data + 6, 2));
        ++drive.tpdo1_count;
        break;
      case 0x280:
        drive.mode = static_cast<std::int8_t>(data[0]);
        ++drive.tpdo2_count;
        break;
      case 0x080:
        drive.emergencies.push_back(static_cast<int>(canopen::get_le(data, 2)));
        break;
      case 0x580:
        reply_ = canopen::decode_sdo_reply(frame);
        break;
      case 0x700:
        drive.nmt_states.push_back(data[0]);
        break;
      default:
        ADD_FAILURE() << "unexpected frame " << frame.id;
    }
  }

  FrameBatch burst_;
  FrameBatch out_;
  canopen::SdoMessage reply_;
};

}  // namespace sprung::sim

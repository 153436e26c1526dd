#pragma once
/// A simulated drive whose shaft the test moves, and a minimal master by SDO.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "simulation/device_registry.h"

namespace sprung::sim {

/// Motor, gear and drive as on pegasus.
inline SimDriveSetup epos2_setup() {
  SimDriveSetup setup;
  setup.actuator.name = "motor";
  setup.actuator.profile = "epos2";
  setup.actuator.node = 4;
  setup.actuator.gear_ratio = 50.0;
  setup.actuator.torque_constant_Nm_A = 0.217;
  setup.actuator.rated_current_A = 2.12;
  setup.actuator.encoder_counts_per_turn = 16384;
  setup.actuator.speed_limit_rad_s = 4.36;
  setup.truth.torque_constant_Nm_A = 0.217;
  setup.truth.torque_loop_Hz = 146.0;
  setup.truth.peak_torque_Nm = 108.5;
  setup.truth.supply_V = 48.0;
  setup.truth.quick_stop_damping_Nm_s_rad = 40.0;
  setup.truth.absolute_encoder = false;
  setup.step_s = 0.00025;
  setup.seed = 1;
  return setup;
}

class DriveBench {
 public:
  static constexpr std::int64_t kTick_us = 250;
  /// Booted.
  explicit DriveBench(const SimDriveSetup& setup = epos2_setup(), double boot_s = 0.01)
      : drive(make_sim_drive(setup)) {
    drive->outbox().open(&out_);
    run(boot_s);
  }
  void run(double time_s, double speed_rad_s = 0.0) {
    for (std::int64_t ticks = std::llround(time_s * 4000); ticks > 0; --ticks) {
      shaft_rad += speed_rad_s * 1e-6 * kTick_us;
      drive->step(shaft_rad, time_us += kTick_us);
      note();
    }
  }
  void send(const CanFrame& frame) {
    drive->receive(frame, time_us);
    note();
  }
  /// @return 0 or the abort code.
  std::uint32_t try_write(std::uint16_t index, std::int64_t value, int size, int sub = 0) {
    reply_ = {};
    const canopen::ObjectId id{index, static_cast<std::uint8_t>(sub)};
    send(canopen::sdo_write_request(4, id, static_cast<std::uint32_t>(value), size));
    EXPECT_NE(reply_.kind, canopen::SdoKind::kInvalid) << "no answer";
    return reply_.kind == canopen::SdoKind::kAbort ? reply_.value : 0;
  }
  void write(std::uint16_t index, std::int64_t value, int size, int sub = 0) {
    EXPECT_EQ(try_write(index, value, size, sub), 0U) << std::hex << index;
  }
  std::uint32_t read(std::uint16_t index, int sub = 0) {
    reply_ = {};
    send(canopen::sdo_read_request(4, {index, static_cast<std::uint8_t>(sub)}));
    EXPECT_EQ(reply_.kind, canopen::SdoKind::kUpload) << std::hex << index;
    return reply_.value;
  }
  int read_i16(std::uint16_t index) { return static_cast<std::int16_t>(read(index)); }
  int read_i32(std::uint16_t index) { return static_cast<std::int32_t>(read(index)); }
  int status() { return static_cast<int>(read(canopen::kStatusWord)); }
  void nmt(canopen::NmtCommand command) { send(canopen::nmt_frame(command, 0)); }
  void control(std::initializer_list<int> words) {
    for (const int word : words) {
      write(canopen::kControlWord, word, 2);
      run(0.0005);
    }
  }
  void reset_fault() { control({0x00, 0x80}); }
  /// Operational, in this mode, enabled.
  void start(int mode) {
    nmt(canopen::NmtCommand::kStart);
    write(canopen::kMode, mode, 1);
    control({0x06, 0x07, 0x0F});
    run(0.05);
    EXPECT_EQ(status() & 0x6F, 0x27);
  }

  std::unique_ptr<SimDrive> drive;
  double shaft_rad = 1.0;
  std::int64_t time_us = 0;
  std::vector<int> emergencies;
  int boot_ups = 0;

 private:
  void note() {
    for (const BusFrame& entry : out_) {
      const CanFrame& frame = entry.frame;
      if (frame.id == 0x584) reply_ = canopen::decode_sdo_reply(frame);
      if (frame.id == 0x084) emergencies.push_back(static_cast<int>(canopen::get_le(frame.data.data(), 2)));
      if (frame.id == 0x704 && frame.data[0] == 0) ++boot_ups;
    }
    out_.clear();
  }
  FrameBatch out_;
  canopen::SdoMessage reply_;
};

}  // namespace sprung::sim

/// The bridge between drives that answer well, and anybody else on the bus and on the network: any frames,
/// any DRIVE_COMMAND and OPERATOR_COMMAND, at any moment.
#include <cmath>
#include <cstring>

#include "tests/fuzz/any_signal.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/bridge_bench.h"

namespace sprung::fuzz::drivers_bridge {
namespace {

constexpr int kMostTicks = 400;  ///< of one input, after the boot

class Bench {
 public:
  Bench(bool card, bool boots)
      : bench_(test::with_leg(card ? test::robot_with_card() : test::two_drive_robot())) {
    if (!boots) return;
    bench_.boot(400);
    bench_.enable();
  }
  void tick(int ticks) {
    for (; ticks > 0 && ticks_left_ > 0; --ticks, --ticks_left_) {
      bench_.tick();
      require_sane();
    }
  }
  /// Of anybody: half of them with an identifier of a node that there is.
  void hear(Input& input) {
    CanFrame frame = frame_of(input);
    constexpr std::uint32_t kNodes[] = {1, 2, 9, 127};
    if ((frame.id & 1U) != 0) frame.id = (frame.id & 0x780U) + kNodes[frame.id >> 1U & 3U];
    bench_.bridge->receive(0, frame, bench_.time_us);
  }
  void command(Input& input) {
    DriveCommand command = bench_.command;
    command.stamp.seq = bench_.state.stamp.seq + 1;
    command.valid_until_utime_us = bench_.time_us + 20'000;
    const DriveMode mode = static_cast<DriveMode>(input.byte() % 4);
    for (ActuatorCommand& actuator : command.actuators) {
      actuator.mode = mode;
      actuator.commanded_position_rad = 0.0;
    }
    if (!change(input, command)) return;
    bench_.bridge->command(command, bench_.time_us);
    bench_.command = command;
  }
  void ask(Input& input) {
    OperatorCommand command;
    command.request_id = input.byte() % 8;
    command.kind = static_cast<OperatorKind>(input.byte() % std::size(kWords<OperatorKind>));
    if (!change(input, command)) return;
    require(bench_.bridge->operator_command(command, bench_.time_us).reason != nullptr, "a reason or none");
    for (OperatorReply reply; bench_.bridge->next_reply(reply);)
      require(reply.answered_by != nullptr, "a sender");
  }
  void bend_a_drive(Input& input) {
    test::FakeDrive& drive = bench_.drives[input.byte() % bench_.drives.size()];
    const std::uint8_t bits = input.byte();
    drive.mute_samples = (bits & 1U) != 0;
    drive.mute_heartbeat = (bits & 2U) != 0;
    drive.dead = (bits & 4U) != 0;
    drive.restart_now = (bits & 8U) != 0;
    drive.stuck_in_fault = (bits & 16U) != 0;
    drive.keeps_mode = (bits & 32U) != 0;
    drive.position_counts = input.number<std::int32_t>();
    drive.torque_permille = input.number<std::int16_t>();
    drive.pending_emergency = input.number<std::uint16_t>();
    drive.objects[{input.number<std::uint16_t>(), input.byte()}] = input.number<std::uint32_t>();
  }
  void fail_to_send(Input& input) {
    bench_.bridge->send_failed(0, static_cast<SendFailure>(input.byte() % 3), bench_.time_us);
    bench_.bridge->count_overrun(bench_.time_us);
  }

 private:
  void require_sane() const {
    for (const FrameBatch* batch : {&bench_.last_begin, &bench_.last_setpoints}) {
      require(batch->overflow() == 0, "a tick's frames fit");
      for (const BusFrame& item : *batch)
        require(item.frame.length <= 8 && item.frame.id <= 0x7FF, "frames are frames");
    }
    const SafetyState& safety = bench_.bridge->safety();
    require(std::memchr(safety.detail.data(), 0, safety.detail.size()) != nullptr, "a text that ends");
    if (!bench_.in_cycle) return;
    for (const ActuatorState& actuator : bench_.state.actuators)
      require(!std::isinf(actuator.measured_position_rad) && !std::isinf(actuator.measured_current_A),
              "finite or none");
  }

  test::BridgeBench bench_;
  int ticks_left_ = kMostTicks;
};

std::vector<std::string> bridge_seeds() {
  const auto tick = [](int ticks) { return Output().byte(0).byte(ticks).bytes(); };
  const auto hear = [](const CanFrame& frame) { return Output().byte(1).text(frame_bytes(frame)).bytes(); };
  const auto ask = [](OperatorKind kind) {
    return Output().byte(3).byte(1).byte(static_cast<int>(kind)).byte(0).bytes();
  };
  const auto command = [](DriveMode mode) {
    return Output().byte(2).byte(static_cast<int>(mode)).byte(0).bytes();
  };
  CanFrame sample;
  sample.id = canopen::tpdo_id(0, 1);
  sample.length = 8;
  std::vector<std::string> seeds;
  for (const int head : {0, 1, 2, 3}) {
    const std::string begin(1, static_cast<char>(head));
    seeds.push_back(begin + tick(200) + hear(canopen::heartbeat_frame(1, canopen::NmtState::kBootUp)) +
                    tick(100));
    seeds.push_back(begin + tick(5) + hear(canopen::emergency_frame(1, {0x8130, 0x11, {}})) + tick(50) +
                    ask(OperatorKind::kClear) + tick(100));
    seeds.push_back(begin + command(DriveMode::kPosition) + tick(20) + command(DriveMode::kTorque) +
                    tick(20) + ask(OperatorKind::kEstop) + tick(20));
    seeds.push_back(begin + hear(sample) + hear(canopen::sync_frame()) +
                    hear(canopen::nmt_frame(canopen::NmtCommand::kStop, 0)) + tick(30));
    seeds.push_back(begin + ask(OperatorKind::kHome) + tick(100) + Output().byte(4).byte(0).byte(1).bytes() +
                    tick(30));
  }
  return seeds;
}

}  // namespace

/// First byte: an encoder card (1), a robot that has not booted (2). Then what happens.
SPRUNG_FUZZ(drivers_bridge, bridge_seeds) {
  const std::uint8_t head = input.byte();
  Bench bench((head & 1U) != 0, (head & 2U) == 0);
  while (!input.done()) {
    switch (input.byte() % 6) {
      case 0:
        bench.tick(input.byte());
        break;
      case 1:
        bench.hear(input);
        break;
      case 2:
        bench.command(input);
        break;
      case 3:
        bench.ask(input);
        break;
      case 4:
        bench.bend_a_drive(input);
        break;
      default:
        bench.fail_to_send(input);
    }
  }
  bench.tick(20);
}

}  // namespace sprung::fuzz::drivers_bridge

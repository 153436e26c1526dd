/// Any frames to the simulated devices, all makes: their SDO servers, object dictionaries, mappings, power
/// states.
#include <cmath>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "simulation/device_registry.h"
#include "simulation/plant/sim_config.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::simulation_device {
namespace {

constexpr int kDevices = 3;
constexpr int kNode = 1;

struct Device {
  std::unique_ptr<sim::SimDrive> drive;  ///< one of both
  std::unique_ptr<sim::SimCard> card;
  sim::SimDevice& any() { return drive ? static_cast<sim::SimDevice&>(*drive) : *card; }
};

sim::SimDriveSetup drive_setup(const std::string& robot_name) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/" + robot_name);
  sim::SimDriveSetup setup;
  setup.actuator = robot.actuators[0];
  setup.actuator.node = kNode;
  setup.truth = sim::load_sim_config(robot, {}).drives[0];
  setup.step_s = 0.00025;
  return setup;
}

Device make_device(int which) {
  static const sim::SimDriveSetup gold = drive_setup("single_leg"), epos2 = drive_setup("pegasus");
  Device device;
  sim::SimCardSetup card;
  card.card.profile = "encoder_card";
  card.card.node = kNode;
  if (which == 0) device.drive = sim::make_sim_drive(gold);
  if (which == 1) device.drive = sim::make_sim_drive(epos2);
  if (which == 2) device.card = sim::make_sim_card(card);
  return device;
}

class Bench {
 public:
  explicit Bench(int which) : device_(make_device(which)) {
    device_.any().outbox().open(&out_);
    step(1, 0.0);
  }
  /// Half of the frames are to this node, by the services that there are.
  void hear(Input& input) {
    CanFrame frame = frame_of(input);
    if ((frame.id & 1U) != 0) frame.id = (frame.id & 0x780U) + kNode;
    if ((frame.id & 6U) == 6) frame.id = canopen::sdo_client_id(kNode);
    hear(frame);
  }
  /// The shortest way into the dictionary: an expedited write.
  void write(Input& input) {
    const canopen::ObjectId object{input.number<std::uint16_t>(), input.byte()};
    hear(canopen::sdo_write_request(kNode, object, input.number<std::uint32_t>(), 1 + input.byte() % 4));
  }
  void step(int steps, double shaft_rad) {
    for (int i = 0; i < steps; ++i) {
      time_us_ += 250;
      if (device_.drive) device_.drive->step(shaft_rad, time_us_);
      if (device_.card) device_.card->step(time_us_);
      check();
    }
  }
  void sync(double shaft_rad) {
    if (device_.drive) device_.drive->sample(shaft_rad, ++cycle_);
    if (device_.card) device_.card->sample(0, shaft_rad, ++cycle_);
    hear(canopen::sync_frame());
  }
  void fault(Input& input) {
    const auto kind = static_cast<FaultKind>(input.byte() % std::size(kWords<FaultKind>));
    const double value = input.number<float>();
    const bool on = (input.byte() & 1U) != 0;
    if (!(std::abs(value) <= 65535.0)) return;  // from_message(SimControl) lets no others through
    device_.any().outbox().set_fault(kind, value, on);
    device_.any().set_fault(kind, value, on);
  }

 private:
  void hear(const CanFrame& frame) {
    if (device_.any().outbox().hears()) device_.any().receive(frame, time_us_);
    check();
  }
  void check() {
    for (const BusFrame& item : out_)
      require(item.frame.length <= 8 && item.frame.id <= 0x7FF, "frames are frames");
    out_.clear();
    if (device_.drive) require(std::isfinite(device_.drive->motor_torque_Nm()), "a torque");
  }

  Device device_;
  FrameBatch out_;
  std::int64_t time_us_ = 0;
  std::int64_t cycle_ = -1;
};

std::vector<std::string> device_seeds() {
  using namespace canopen;
  const auto hear = [](const CanFrame& frame) { return Output().byte(0).text(frame_bytes(frame)).bytes(); };
  const auto write = [](std::uint16_t index, int sub, std::uint32_t value, int size) {
    return Output().byte(1).number(index).byte(sub).number(value).byte(size - 1).bytes();
  };
  const auto step = [](int steps) { return Output().byte(2).byte(steps).number(0.1F).bytes(); };
  const std::string sync = Output().byte(3).number(0.2F).bytes();
  const std::string map = write(kTpdoCommunication, 1, 0xC0000181, 4) + write(kTpdoMapping, 0, 0, 1) +
                          write(kTpdoMapping, 1, 0x60640020, 4) + write(kTpdoMapping, 0, 1, 1) +
                          write(kTpdoCommunication, 2, 1, 1) + write(kTpdoCommunication, 1, 0x40000181, 4);
  const std::string enable = write(kMode, 0, 10, 1) + write(kControlWord, 0, 6, 2) + step(4) +
                             write(kControlWord, 0, 7, 2) + step(4) + write(kControlWord, 0, 15, 2) +
                             step(4) + write(kTargetTorque, 0, 100, 2) + step(40);
  std::vector<std::string> seeds;
  for (int device = 0; device < kDevices; ++device) {
    const std::string head(1, static_cast<char>(device));
    seeds.push_back(head + map + hear(nmt_frame(NmtCommand::kStart, kNode)) + sync + step(4) + sync);
    seeds.push_back(head + hear(nmt_frame(NmtCommand::kStart, 0)) + enable + sync);
    seeds.push_back(head + write(kStoreParameters, 1, 0x65766173, 4) +
                    hear(nmt_frame(NmtCommand::kResetNode, 0)) + step(8));
    seeds.push_back(head + write(kHeartbeatConsumer, 1, (127U << 16U) + 20, 4) +
                    hear(heartbeat_frame(127, NmtState::kOperational)) + step(200));
    seeds.push_back(head + hear(sdo_read_request(kNode, {0x1008, 0})) +
                    hear(sdo_read_segment_request(kNode, false)) + hear(guard_request(kNode)));
    for (int kind = 0; kind < 21; kind += 3)
      seeds.push_back(head + enable + Output().byte(4).byte(kind).number(0.5F).byte(1).bytes() + step(20) +
                      sync);
  }
  return seeds;
}

}  // namespace

/// Which device; then frames, writes, steps, SYNCs, faults.
SPRUNG_FUZZ(simulation_device, device_seeds) {
  Bench bench(input.byte() % kDevices);
  for (int left = 200; left > 0 && !input.done(); --left) {
    const int what = input.byte() % 5;
    if (what == 0) bench.hear(input);
    if (what == 1) bench.write(input);
    if (what == 4) bench.fault(input);
    if (what != 2 && what != 3) continue;
    const int steps = what == 2 ? input.byte() : 0;
    const double shaft_rad = input.number<float>();
    // The plant's angles are finite: it fails before they are not.
    if (!std::isfinite(shaft_rad) || std::abs(shaft_rad) > 1e6) continue;
    what == 2 ? bench.step(steps, shaft_rad) : bench.sync(shaft_rad);
  }
}

}  // namespace sprung::fuzz::simulation_device

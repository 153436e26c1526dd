/// Every frame of CANopen that has no state: emergencies, NMT, heartbeats, mapping words, status words, and
/// what the profiles read from samples.
#include <cmath>
#include <memory>

#include "drivers/canopen/protocol.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/drive_profile.h"
#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "robots/robot_loader.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::drivers_canopen_words {
namespace {

using namespace canopen;

struct Profiles {
  std::unique_ptr<DriveProfile> gold, epos2;
  std::unique_ptr<CardProfile> card;
};

const Profiles& profiles() {
  static const Profiles made = [] {
    const std::string robots = test::source_dir() + "/robots/";
    const RobotConfig single_leg = load_robot(robots + "single_leg"),
                      pegasus = load_robot(robots + "pegasus");
    const DriveTiming timing{0.002, 0.005, 0.02};
    return Profiles{make_profile(single_leg.actuators[0], timing), make_profile(pegasus.actuators[0], timing),
                    make_card_profile(pegasus.encoder_cards[0], timing)};
  }();
  return made;
}

void read_services(const CanFrame& frame, int node) {
  Emergency emergency;
  if (decode_emergency(frame, emergency)) {
    require(emergency_text(emergency.code) != nullptr, "a text for each code");
    require(error_register_text(emergency.error_register).back() == '\0', "a text that ends");
    Emergency again;
    require(decode_emergency(emergency_frame(node, emergency), again) && again.code == emergency.code,
            "comes back");
  }
  NmtCommand command;
  if (decode_nmt(frame, node, command)) require(nmt_text(command) != nullptr, "a text");
  require(nmt_text(heartbeat_state(frame)) != nullptr, "a text");
  require(nmt_text(decode_guard_reply(frame).state) != nullptr, "a text");
}

void read_words(Input& input) {
  const auto word = input.number<std::uint32_t>();
  if (pdo_valid(word) && pdo_cob_id_allowed(word)) require(pdo_id_allowed(word & 0x1FFFFFFF), "allowed");
  require(encode_map_entry(decode_map_entry(word)) == word, "a mapping word comes back");
  require(abort_text(word) != nullptr, "a text");
  const auto status = static_cast<std::uint16_t>(word);
  const PowerState state = cia402::decode_status(status);
  for (const auto target :
       {cia402::PowerTarget::kOff, cia402::PowerTarget::kEnabled, cia402::PowerTarget::kQuickStop})
    cia402::apply_control(state, cia402::next_control_word(state, target),
                          static_cast<std::uint16_t>(word >> 16));
  if (state != PowerState::kUnknown)
    require(cia402::decode_status(cia402::encode_status(state)) == state, "a state comes back");
}

void read_samples(const CanFrame& frame) {
  for (const DriveProfile* profile : {profiles().gold.get(), profiles().epos2.get()}) {
    DriveSample sample;
    if (profile->decode_sample(frame, sample)) {
      require(std::isfinite(sample.measured_position_rad) && std::isfinite(sample.measured_current_A),
              "finite");
    }
    std::int8_t mode = 0;
    std::uint32_t levels = 0;
    if (profile->decode_mode_display(frame, mode)) profile->shown_mode(mode);
    profile->decode_inputs(frame, levels);
  }
  CardSample sample;
  if (!profiles().card->decode_sample(frame, sample)) return;
  require(sample.channels <= CardSample::kMaxChannels, "channels fit");
  require(sample.counter < profiles().card->counter_modulus(), "a counter");
}

void write_setpoint(Input& input) {
  DriveSetpoint setpoint;
  setpoint.commanded_torque_Nm = input.number<double>();
  setpoint.commanded_position_rad = input.number<double>();
  setpoint.mode = static_cast<DriveMode>(input.byte() % 4);
  // The gates in front of it let only finite numbers through (drivers/bridge/command_gate.h).
  if (!std::isfinite(setpoint.commanded_torque_Nm) || !std::isfinite(setpoint.commanded_position_rad)) return;
  for (const DriveProfile* profile : {profiles().gold.get(), profiles().epos2.get()})
    require(profile->encode_setpoint(setpoint).length <= 8, "a frame");
}

std::vector<std::string> words_seeds() {
  CanFrame sample;
  sample.id = tpdo_id(0, 1);
  sample.length = 8;
  sample.data = {1, 2, 3, 4, 5, 6, 0x37, 0x02};
  const auto frame = [](const CanFrame& one) {
    return Output().byte(0).byte(1).text(frame_bytes(one)).bytes();
  };
  Emergency emergency;
  emergency.code = 0x8130;
  emergency.error_register = 0x11;
  return {frame(sample),
          frame(emergency_frame(1, emergency)),
          frame(nmt_frame(NmtCommand::kStart, 1)),
          frame(heartbeat_frame(1, NmtState::kOperational)),
          frame(guard_reply(1, {NmtState::kStopped, true})),
          Output().byte(1).number(encode_map_entry({{0x6064, 0}, 32})).bytes(),
          Output().byte(1).number(0x40000181U).bytes(),
          Output().byte(2).number(1e300).number(-1e300).byte(2).bytes(),
          Output().byte(2).number(12.5).number(0.5).byte(3).bytes()};
}

}  // namespace

SPRUNG_FUZZ(drivers_canopen_words, words_seeds) {
  while (!input.done()) {
    const int kind = input.byte() % 3;
    if (kind == 1) read_words(input);
    if (kind == 2) write_setpoint(input);
    if (kind != 0) continue;
    const int node = input.byte() % (kMaxNode + 1);
    const CanFrame frame = frame_of(input);
    read_services(frame, node);
    read_samples(frame);
  }
}

}  // namespace sprung::fuzz::drivers_canopen_words

/// What reaches the gateway of a robot: datagrams of anybody, and what operators say whose keys are known.
#include <stdexcept>

#include "tests/fuzz/fuzz.h"
#include "tests/tools/station/gateway/gateway_sample.h"
#include "tools/station/gateway/file_parts.h"

namespace sprung::fuzz::tools_station_gate {
namespace {

using namespace gateway;

constexpr std::int64_t kBegin_us = 60'000'000;
constexpr std::uint8_t kDriver = 1, kRobot = 9;

enum Act : std::uint8_t { kRaw, kChanged, kSaid, kTime, kPart, kRegister, kActs };

std::vector<std::string> gate_seeds() {
  const std::string stand = encoded_command(command_of(OperatorKind::kStand, 1));
  const std::string request = request_text({"log/a.lcm", 1100, 4});
  return {Output().byte(kSaid).byte(1).piece(stand).byte(kTime).number(std::int32_t{20'000}).bytes(),
          Output()
              .byte(kRaw)
              .piece("SPG1\1 not a hello")
              .byte(kChanged)
              .number(std::uint16_t{20})
              .byte(4)
              .bytes(),
          Output().byte(kSaid).byte(3).piece(request).byte(kSaid).byte(2).piece("bob").bytes(),
          Output().byte(kPart).piece(part_text({"f", 0, 5, "", "abc"})).bytes(),
          Output().byte(kRegister).piece(R"({"operators":[]})").bytes()};
}

/// A gate with one operator whose conversation is open.
struct Bench {
  Bench() : gate(robot, {{"alice", key_of_number(kDriver).public_key(), Role::kDrive, "2026-11-27", ""}}) {
    gate.robot_is_up(kSampleRun, 0);
    require(alice.welcomed(take(alice.hello())), "her hello is genuine");
  }
  Verdict take(std::string_view packet) { return gate.take("address", packet, now_us, ++session); }

  std::int64_t now_us = kBegin_us;
  std::uint64_t session = 10;
  SigningKey robot = key_of_number(kRobot);
  Gate gate;
  SampleOperator alice{kDriver, robot.public_key()};
};

/// Whatever it is, without her key it commands nothing.
void say_unsigned(Bench& bench, std::string_view packet) {
  const Verdict verdict = bench.take(packet);
  require(!verdict.command && verdict.part_asked.empty(), "nobody signed it");
}

void say_changed(Bench& bench, Input& input) {
  std::string packet = bench.alice.says(OperatorKind::kStand, bench.now_us);
  const std::size_t at = input.number<std::uint16_t>() % packet.size();
  packet[at] = static_cast<char>(packet[at] ^ (input.byte() | 1));
  say_unsigned(bench, packet);
}

void say_signed(Bench& bench, Input& input) {
  const auto kind = static_cast<SaidKind>(input.byte());
  const Verdict verdict = bench.take(bench.alice.says(kind, std::string(input.piece()), bench.now_us));
  if (!verdict.command) return;
  require(role_for(verdict.command->kind) <= Role::kDrive, "her role may say it");
  require(verdict.command->kind != OperatorKind::kNone, "it asks for something");
}

void read_part_text(std::string_view text) {
  FileAssembly assembly("f");
  if (const auto part = parse_part(text)) (void)assembly.take(*part);
  if (const auto request = parse_request(text)) require(request->parts <= kMostParts, "few at once");
  require(assembly.due(0).size() <= 64, "few at once");
}

void read_register_text(std::string_view text) {
  try {
    const auto all = parse_register(text, "register");
    require(parse_register(register_text(all), "register").size() == all.size(), "what was written is read");
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

SPRUNG_FUZZ(tools_station_gate, gate_seeds) {
  Bench bench;
  while (!input.done()) {
    switch (input.byte() % kActs) {
      case kRaw:
        say_unsigned(bench, input.piece());
        break;
      case kChanged:
        say_changed(bench, input);
        break;
      case kSaid:
        say_signed(bench, input);
        break;
      case kTime:
        bench.now_us += input.number<std::int32_t>();
        (void)bench.gate.link_is_lost(true, bench.now_us);
        (void)bench.gate.tidy(false, bench.now_us);
        break;
      case kPart:
        read_part_text(input.piece());
        break;
      default:
        read_register_text(input.piece());
    }
  }
}

}  // namespace sprung::fuzz::tools_station_gate

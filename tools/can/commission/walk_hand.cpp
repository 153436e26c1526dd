/// The steps that a hand does, without power.
#include <cmath>
#include <cstdio>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "drivers/profiles/profile_registry.h"
#include "signals/angles.h"
#include "tools/can/commission/walk.h"

namespace sprung::commission {
namespace {

constexpr double kHandError = 0.10;  ///< of an angle that a hand turned and a protractor showed
constexpr double kLinkError = 0.03;  ///< of the link encoder against the motor's, play included
constexpr double kNothing = 0.1;     ///< of the angle told: it does not count
constexpr std::uint16_t kCardSample = 0x2100;

std::string radians(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%+.4f rad", value);
  return text;
}

}  // namespace

void Walk::brake() {
  const bool wanted = actuator_.commissioning.brake;
  const double answer = ask(Ask::kBrake, "Does a brake hold the motor without power? 1 yes, 0 no",
                            wanted ? 1.0 : 0.0);
  Finding one{"brake", wanted ? "one (brake of robot.yaml)" : "none (brake of robot.yaml)", "not looked at",
              Verdict::kNeedsHand, "look, and run this again"};
  if (std::isfinite(answer)) {
    const bool found = answer != 0.0;
    one.found = found ? "one" : "none";
    one.verdict = found == wanted ? Verdict::kOk : Verdict::kDiffers;
    one.to_do = found == wanted
                    ? (found ? "open it by hand for the next steps" : "")
                    : "mend `commissioning: {brake: ...}` of robot.yaml; a brake that is not opened makes "
                      "every torque test fail";
  }
  finding(one);
}

std::optional<bool> Walk::emergency_level() {
  const auto levels = number(plan_.inputs, false);
  if (!levels) return std::nullopt;
  return ((*levels >> actuator_.emergency_input.bit) & 1) != 0;
}

void Walk::emergency_input() {
  const EmergencyInputConfig& input = actuator_.emergency_input;
  if (input.bit < 0) {
    finding({"emergency input", "", "robot.yaml names none", Verdict::kSkipped,
             "`emergency_input` of robot.yaml, if the drive has one"});
    return;
  }
  const std::string what = "bit " + std::to_string(input.bit) + " of " + named(plan_.inputs);
  const auto judge = [&](const char* when, bool pressed) {
    const auto level = emergency_level();
    const bool stops = level && *level == input.stops_high;
    Finding one{what + ", " + when, pressed ? "stops" : "does not stop",
                !level  ? "not readable"
                : stops ? "stops"
                        : "does not stop"};
    if (!level || stops != pressed) {
      one.verdict = Verdict::kDiffers;
      one.to_do = "pin, level (`stops_at` of robot.yaml) and wire of the emergency input";
    }
    finding(one);
  };
  judge("released", false);
  const double pressed = ask(Ask::kPressEmergency, "Press the emergency stop", 1.0);
  if (!std::isfinite(pressed)) {
    finding({what + ", pressed", "stops", "not tried", Verdict::kNeedsHand, "press it, and run this again"});
    return;
  }
  judge("pressed", true);
  ask(Ask::kReleaseEmergency, "Release it again", 1.0);
  judge("released again", false);
}

double Walk::position_rad() {
  const auto counts = number(plan_.position, true);
  if (!counts) throw DriveLost(named(plan_.position) + " cannot be read");
  return static_cast<double>(*counts) * plan_.rad_per_count;
}

/// By the card's own sample, asked for over SDO; nothing where there is no link encoder.
std::optional<double> Walk::link_rad() {
  const LinkEncoderConfig& encoder = actuator_.link_encoder;
  if (encoder.card < 0) return std::nullopt;
  const EncoderCardConfig& card = robot_.encoder_cards[static_cast<std::size_t>(encoder.card)];
  port_.send(canopen::nmt_frame(canopen::NmtCommand::kStart, card.node));  // a card may sample only then
  port_.wait(2.0 * DrivePort::kCycle_s);
  const SdoAnswer answer = port_.read(card.node, {kCardSample, 0});
  if (!answer.done() || answer.bytes.size() != 8)
    throw DriveLost("encoder card " + card.name + " (node " + std::to_string(card.node) +
                    ") does not answer");
  CanFrame frame;
  frame.id = canopen::tpdo_id(0, card.node);
  frame.length = 8;
  std::copy(answer.bytes.begin(), answer.bytes.end(), frame.data.begin());
  CardSample sample;
  if (!make_card_profile(card, DriveTiming{robot_.cycle_s, 0.005, 0.02})->decode_sample(frame, sample))
    return std::nullopt;
  return encoder.direction * sample.counts[static_cast<std::size_t>(encoder.channel)] * kTurn_rad /
         encoder.counts_per_turn;
}

/// @param told_rad what it should have moved.
void Walk::judge_turn(const char* what, double moved_rad, double told_rad, const char* remedy) {
  Finding one{what, radians(told_rad), radians(moved_rad)};
  const double share = moved_rad / told_rad;
  char text[160];
  if (std::abs(share) < kNothing) {
    one.to_do = "it does not count: encoder cable, brake, or the joint was not turned";
  } else if (share < 0.0) {
    std::snprintf(text, sizeof text, "the sign is wrong: %s", remedy);
    one.to_do = text;
  } else if (std::abs(share - 1.0) > kHandError) {
    std::snprintf(text, sizeof text, "%.3f times too much: encoder counts, gear ratio, or the angle told",
                  share);
    one.to_do = text;
  }
  if (!one.to_do.empty()) one.verdict = Verdict::kDiffers;
  finding(one);
}

void Walk::turned_by_hand() {
  const double motor_before = position_rad();
  const auto link_before = link_rad();
  char text[200];
  std::snprintf(
      text, sizeof text,
      "Turn %s by hand in its positive direction, by about %.2f rad (%.0f degrees), and hold it; by how many "
      "rad was it?",
      joint_.name.c_str(), options_.turn_rad, options_.turn_rad * 180.0 / kPi);
  const double told_rad = ask(Ask::kTurn, text, options_.turn_rad);
  if (!std::isfinite(told_rad) || told_rad <= 0.0) {
    finding({"signs and counts", "turned by hand", "not turned", Verdict::kNeedsHand,
             "turn it, and run this again"});
    throw Ended{};
  }
  const double motor_rad = position_rad() - motor_before;
  judge_turn("motor encoder", motor_rad, told_rad,
             "`direction` of robot.yaml, or the encoder's polarity in the drive; phases must fit it");
  if (link_before) {
    const double link_moved_rad = std::remainder(*link_rad() - *link_before, kTurn_rad);
    judge_turn("link encoder", link_moved_rad, told_rad, "`direction` of `link_encoder` in robot.yaml");
    const double share = link_moved_rad / motor_rad;
    if (std::isfinite(share) && share > 0.0 && std::abs(share - 1.0) > kLinkError) {
      std::snprintf(text, sizeof text, "%.4f", share);
      finding({"link encoder against motor encoder", "1.0000", text, Verdict::kDiffers,
               "gear_ratio, encoder_counts, or counts of the link encoder"});
    }
  }
  ask(Ask::kTurnBack, "Turn it back to where it was, and take the hands off", 1.0);
}

}  // namespace sprung::commission

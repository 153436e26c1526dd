/// The steps that only read, and write where the operator agrees.
#include <algorithm>
#include <cstdio>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "tools/can/commission/walk.h"

namespace sprung::commission {
namespace {

constexpr std::uint32_t kSave = 0x65766173;  ///< "save", facts canopen 1.6
constexpr double kRestart_s = 0.3;           ///< a node is back after NMT reset communication [design choice]

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08X", static_cast<unsigned>(value));
  return text;
}

}  // namespace

void Walk::node_id() {
  const std::vector<int> there = port_.nodes();
  const auto mine = std::count(there.begin(), there.end(), actuator_.node);
  std::string strangers;
  for (const int node : there) {
    bool known = false;
    for (const ActuatorConfig& other : robot_.actuators)
      known = known || (other.bus == actuator_.bus && other.node == node);
    for (const EncoderCardConfig& card : robot_.encoder_cards)
      known = known || (card.bus == actuator_.bus && card.node == node);
    if (!known) strangers += (strangers.empty() ? "" : ", ") + std::to_string(node);
  }
  Finding one{"who answers on the bus", "one device with id " + std::to_string(actuator_.node), "",
              Verdict::kOk};
  one.found = mine == 1 ? "one" : mine == 0 ? "none" : "two devices with this id";
  if (!strangers.empty()) one.found += "; not in robot.yaml: " + strangers;
  if (mine != 1) {
    one.verdict = Verdict::kDiffers;
    one.to_do = mine > 1            ? "take one of the two off the bus, give it its own id, put it back"
                : strangers.empty() ? "power, cable, termination, bit rate of drive and interface"
                                    : "give the drive its id: the maker's tool or object (EPOS2: 0x2000, "
                                      "then store and switch off "
                                      "and on), or by LSS: sprung can lss";
  }
  finding(one);
  if (mine != 1) throw Ended{};
}

/// What it will have when it is switched on the next time.
void Walk::bus_settings() {
  for (const CommissioningObject& object : plan_.objects)
    if (object.topic == CommissioningTopic::kNodeId) compare(object);
  topic(CommissioningTopic::kBitRate);
}

void Walk::identity() {
  const std::uint32_t typed[] = {actuator_.identity.vendor, actuator_.identity.product,
                                 actuator_.identity.revision, actuator_.identity.serial};
  const KnownDevice known = profile_->known_device();
  const std::uint32_t planned[] = {known.vendor, known.product, 0, 0};
  const char* const names[] = {"vendor", "product", "revision", "serial number"};
  bool stranger = false;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    const auto value = number({canopen::kIdentity, sub}, false);
    const std::uint32_t wanted = typed[sub - 1] != 0 ? typed[sub - 1] : planned[sub - 1];
    Finding one{names[sub - 1], wanted != 0 ? hex(wanted) : "",
                value ? hex(static_cast<std::uint32_t>(*value)) : "not readable"};
    bool right = wanted == 0 || (value && static_cast<std::uint32_t>(*value) == wanted);
    if (sub == 3 && wanted == 0 && !known.revisions.empty()) {
      for (const std::uint32_t revision : known.revisions)
        one.expected += (one.expected.empty() ? "one of " : ", ") + hex(revision);
      right = value && known.knows_firmware(static_cast<std::uint32_t>(*value));
    }
    if (!right) {
      one.verdict = Verdict::kDiffers;
      one.to_do =
          sub <= 2
              ? "another make or model than `profile` of robot.yaml: nothing more of it is read or written"
          : sub == 3
              ? "objects were not checked with this firmware: load the known one, or check every object "
                "with the maker's manual and type it as `revision` in robot.yaml"
              : "another drive than robot.yaml's: swapped? Type its serial number, then sprung home";
      stranger = true;
    }
    finding(one);
  }
  if (stranger) throw Ended{};
}

void Walk::errors() {
  auto status = number({canopen::kStatusWord, 0}, false);
  if (status && cia402::decode_status(static_cast<std::uint16_t>(*status)) == PowerState::kFault) {
    reset_fault();
    status = number({canopen::kStatusWord, 0}, false);
  }
  const PowerState state = status ? cia402::decode_status(static_cast<std::uint16_t>(*status))
                                  : PowerState::kUnknown;
  Finding one{"state", "no fault, no power", name(state)};
  const bool faulty = state == PowerState::kFault || state == PowerState::kFaultReactionActive;
  const bool on = state == PowerState::kOperationEnabled || state == PowerState::kQuickStopActive;
  if (faulty) {
    const auto code = number(plan_.last_error, false).value_or(0) & 0xFFFF;
    char text[16];
    std::snprintf(text, sizeof text, "0x%04X", static_cast<unsigned>(code));
    one.found = std::string("fault ") + text + " " +
                canopen::emergency_text(static_cast<std::uint16_t>(code)) + ", which a reset does not end";
  }
  if (faulty || on || !status) {
    one.verdict = Verdict::kDiffers;
    one.to_do = on ? "somebody else gives it power: stop that first" : "mend what the code names";
  }
  finding(one);
  supply();
}

/// A drive that came up on a dead bus is in fault (facts canopen 2.5); one reset of its communication and of
/// the fault is tried.
void Walk::reset_fault() {
  port_.send(canopen::nmt_frame(canopen::NmtCommand::kResetCommunication, actuator_.node));
  port_.wait(kRestart_s);
  boot_ups_ = port_.boot_ups(actuator_.node);
  write({canopen::kControlWord, 0}, 0, 2);
  port_.wait(DrivePort::kCycle_s);
  write({canopen::kControlWord, 0}, cia402::kFaultResetBit, 2);
  port_.wait(2 * DrivePort::kCycle_s);
  write({canopen::kControlWord, 0}, 0, 2);
  port_.wait(DrivePort::kCycle_s);
  protocol_.written.push_back("0x6040 control word: a fault reset, after NMT reset communication");
}

void Walk::supply() {
  const canopen::ObjectId object = profile_->supply_voltage_object();
  if (object.index == 0) return;
  const auto raw = number(object, false);
  char text[48];
  std::snprintf(text, sizeof text, "%.1f V",
                raw ? profile_->supply_V(static_cast<std::uint32_t>(*raw)) : 0.0);
  Finding one{"supply", "", raw ? text : "not readable"};
  const SupplyConfig& wanted = actuator_.supply;
  if (wanted.max_V > 0.0 && raw) {
    std::snprintf(text, sizeof text, "%.1f to %.1f V (supply of robot.yaml)", wanted.min_V, wanted.max_V);
    one.expected = text;
    const double volts = profile_->supply_V(static_cast<std::uint32_t>(*raw));
    if (volts < wanted.min_V || volts > wanted.max_V) {
      one.verdict = Verdict::kDiffers;
      one.to_do = "battery, cable, fuse";
    }
  }
  finding(one);
}

/// The bridge writes these at each start. A value that is neither robot.yaml's nor the maker's was stored by
/// somebody else, and so were others that nobody writes.
void Walk::stored() {
  int factory = 0, right = 0;
  for (const DriveSetting& setting : profile_->settings()) {
    const bool elsewhere = std::any_of(plan_.objects.begin(), plan_.objects.end(), [&](const auto& object) {
      return object.object.index == setting.object.index && object.object.sub == setting.object.sub;
    });
    const std::uint16_t index = setting.object.index;
    if (elsewhere || index == canopen::kHeartbeatConsumer || index == canopen::kHeartbeatProducer) continue;
    const auto value = number(setting.object, setting.is_signed);
    const canopen::EdsObject* described = eds_.find(setting.object);
    const std::uint64_t mask = setting.size >= 4 ? 0xFFFFFFFFULL : (1ULL << (8 * setting.size)) - 1;
    const bool wanted = value && ((static_cast<std::uint64_t>(*value) ^ setting.value) & mask) == 0;
    const bool makers = value && described != nullptr && described->default_value == *value;
    if (wanted) ++right;
    if (wanted || makers || (described != nullptr && !described->default_value && value)) {
      factory += wanted ? 0 : 1;
      continue;
    }
    if (!value) {
      finding({named(setting.object), "to be there: the bridge writes it at each start", "refused",
               Verdict::kDiffers, "robot.yaml names an object that this drive has not"});
      continue;
    }
    finding({named(setting.object),
             value_text(setting.object, static_cast<std::int64_t>(setting.value), setting.size) +
                 " (robot.yaml) or the maker's " +
                 (described != nullptr && described->default_value
                      ? value_text(setting.object, *described->default_value, setting.size)
                      : "own"),
             value_text(setting.object, *value, setting.size), Verdict::kDiffers,
             "stored for another robot or by another tool: restore the maker's values (0x1011:01), switch "
             "off and "
             "on, and begin again"});
  }
  finding({"what the bridge writes at each start", "",
           std::to_string(right) + " as robot.yaml, " + std::to_string(factory) + " still the maker's"});
}

void Walk::topic(CommissioningTopic which) {
  for (const CommissioningObject& object : plan_.objects)
    if (object.topic == which) compare(object);
  if (current_.findings.empty())
    finding({"objects", "", "no confirmed one for it on this make", Verdict::kSkipped,
             which == CommissioningTopic::kMotor ? plan_.not_readable : ""});
}

void Walk::compare(const CommissioningObject& wanted) {
  const auto raw = number(wanted.object, wanted.is_signed);
  Finding one{named(wanted.object), wanted.expected,
              raw ? value_text(wanted.object, *raw, wanted.size) : "not readable"};
  const std::int64_t value = raw ? (wanted.mask == 0xFFFFFFFF ? *raw : *raw & wanted.mask) : 0;
  const bool right = raw && value >= wanted.low && value <= wanted.high;
  if (!right && raw && wanted.may_be_written && options_.write && offer_to_write(wanted, one.found)) {
    one.found += " -> " + value_text(wanted.object, wanted.low, wanted.size) + ", written and read back";
  } else if (!right) {
    one.verdict = Verdict::kDiffers;
    one.to_do = wanted.may_be_written && raw
                    ? "set it (this command with --write offers to), or mend robot.yaml"
                    : "set it with the maker's tool, or mend robot.yaml";
  }
  finding(one);
}

/// @return whether it is in force now.
bool Walk::offer_to_write(const CommissioningObject& wanted, const std::string& found) {
  const std::string to = value_text(wanted.object, wanted.low, wanted.size);
  if (!(ask(Ask::kWrite, named(wanted.object) + ": " + found + " -> " + to + ". Write?", 1.0) == 1.0))
    return false;
  std::int64_t value = wanted.low;
  if (wanted.mask != 0xFFFFFFFF) {
    const std::int64_t before = number(wanted.object, wanted.is_signed).value_or(0);
    value |= before & ~static_cast<std::int64_t>(wanted.mask);
  }
  if (!write(wanted.object, value, wanted.size)) return false;
  const auto now = number(wanted.object, wanted.is_signed);
  if (!now || *now != value) return false;
  values_written_.push_back(named(wanted.object) + ": " + found + " -> " + to);
  return true;
}

void Walk::store_written() {
  if (values_written_.empty()) return;
  if (!(ask(Ask::kStore,
            std::to_string(values_written_.size()) +
                " values were written. Store them in the drive (0x1010:01)?",
            1.0) == 1.0))
    return;
  if (!write({canopen::kStoreParameters, 1}, kSave, 4)) return;
  for (const std::string& value : values_written_) protocol_.written.push_back(value + ", stored");
  values_written_.clear();
}

}  // namespace sprung::commission

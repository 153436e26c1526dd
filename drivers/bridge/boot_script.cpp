#include "drivers/bridge/boot_script.h"

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"

namespace sprung {
namespace {

using canopen::ObjectId;
using Kind = BootStep::Kind;

/// What robot.yaml types wins: whoever types a revision has checked the objects with it.
void verify_identity(const IdentityConfig& typed, const KnownDevice& known, std::vector<BootStep>& script) {
  const auto verify = [&script](std::uint8_t sub, std::uint32_t value) {
    if (value != 0) script.push_back({Kind::kVerify, {{canopen::kIdentity, sub}, 4, value, false}});
  };
  verify(1, typed.vendor != 0 ? typed.vendor : known.vendor);
  verify(2, typed.product != 0 ? typed.product : known.product);
  verify(3, typed.revision);
  if (typed.revision == 0 && known.vendor != 0) {
    BootStep firmware{Kind::kFirmware, {{canopen::kIdentity, 3}, 4, 0, false}, known};
    if (typed.product != 0 && typed.product != known.product) firmware.device.revisions.clear();
    script.push_back(firmware);
  }
  verify(4, typed.serial);
}

/// The order that drives accept: invalid, type, inhibit time, event timer, no map, entries, map, valid.
void remap(const PdoSetting& pdo, int node, std::vector<BootStep>& script) {
  const auto number = static_cast<std::uint16_t>(pdo.number);
  const auto communication = static_cast<std::uint16_t>(
      (pdo.transmit ? canopen::kTpdoCommunication : canopen::kRpdoCommunication) + number);
  const auto mapping = static_cast<std::uint16_t>(
      (pdo.transmit ? canopen::kTpdoMapping : canopen::kRpdoMapping) + number);
  const std::uint32_t cob_id = pdo.transmit ? canopen::tpdo_id(pdo.number, node) | canopen::kPdoNoRtr
                                            : canopen::rpdo_id(pdo.number, node);
  const auto add = [&script](ObjectId object, int size, std::uint32_t value) {
    script.push_back({Kind::kWriteAndVerify, {object, size, value, false}});
  };
  add({communication, 1}, 4, cob_id | canopen::kPdoInvalid);
  if (pdo.entries.empty()) return;
  add({communication, 2}, 1, pdo.transmission_type);
  if (pdo.inhibit_100us != 0) add({communication, 3}, 2, pdo.inhibit_100us);
  if (pdo.event_timer_ms != 0) add({communication, 5}, 2, pdo.event_timer_ms);
  add({mapping, 0}, 1, 0);
  std::uint8_t sub = 0;
  for (const canopen::MapEntry& entry : pdo.entries)
    add({mapping, ++sub}, 4, canopen::encode_map_entry(entry));
  add({mapping, 0}, 1, sub);
  add({communication, 1}, 4, cob_id);
}

}  // namespace

std::vector<BootStep> make_boot_script(const IdentityConfig& identity, const NodeProfile& profile, int node,
                                       bool has_power, const ReadingConfig& watched) {
  std::vector<BootStep> script;
  verify_identity(identity, profile.known_device(), script);
  // A drive that a former bridge left enabled loses its power before anything is changed.
  if (has_power)
    script.push_back({Kind::kWrite, {{canopen::kControlWord, 0}, 2, cia402::kDisableVoltageWord, false}});
  if (const std::uint32_t modes = profile.required_modes(); modes != 0)
    script.push_back({Kind::kRequireBits, {{canopen::kSupportedModes, 0}, 4, modes, false}});
  if (watched.index != 0)
    script.push_back({Kind::kWatched, {{watched.index, watched.sub}, watched.bytes, 0, false}});
  for (const DriveSetting& setting : profile.settings()) {
    script.push_back({Kind::kAdopt, setting});
    if (setting.object.index != canopen::kHeartbeatConsumer) continue;
    for (const DriveSetting& instead : profile.guarding_instead())
      script.push_back({Kind::kAdoptInstead, instead});
  }
  for (const PdoSetting& pdo : profile.pdos()) remap(pdo, node, script);
  if (has_power) script.push_back({Kind::kShowMode, {{canopen::kModeDisplay, 0}, 1, 0, true}});
  return script;
}

}  // namespace sprung

#include "tools/can/decode/drive_check.h"

#include "drivers/canopen/objects.h"

namespace sprung::cantools {
namespace {

constexpr std::uint32_t kAll = 0xFFFFFFFF;

void expect_identity(const IdentityConfig& identity, std::vector<ExpectedObject>& out) {
  const std::uint32_t values[] = {identity.vendor, identity.product, identity.revision, identity.serial};
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    if (values[sub - 1] != 0) out.push_back({{canopen::kIdentity, sub}, 4, values[sub - 1], false, kAll});
  }
}

/// A disabled PDO may carry any identifier; whether it may be asked for by a remote request matters to
/// nobody.
void expect_pdo(const PdoSetting& pdo, int node, std::vector<ExpectedObject>& out) {
  const auto index = [&pdo](std::uint16_t transmit, std::uint16_t receive) {
    return static_cast<std::uint16_t>((pdo.transmit ? transmit : receive) + pdo.number);
  };
  const std::uint16_t communication = index(canopen::kTpdoCommunication, canopen::kRpdoCommunication);
  const std::uint16_t mapping = index(canopen::kTpdoMapping, canopen::kRpdoMapping);
  const std::uint32_t id = pdo.transmit ? canopen::tpdo_id(pdo.number, node) | canopen::kPdoNoRtr
                                        : canopen::rpdo_id(pdo.number, node);
  if (pdo.entries.empty()) {
    out.push_back({{communication, 1}, 4, id | canopen::kPdoInvalid, false, canopen::kPdoInvalid});
    return;
  }
  out.push_back({{communication, 1}, 4, id, false, ~canopen::kPdoNoRtr});
  out.push_back({{communication, 2}, 1, pdo.transmission_type, false, kAll});
  if (pdo.inhibit_100us != 0) out.push_back({{communication, 3}, 2, pdo.inhibit_100us, false, kAll});
  if (pdo.event_timer_ms != 0) out.push_back({{communication, 5}, 2, pdo.event_timer_ms, false, kAll});
  out.push_back({{mapping, 0}, 1, static_cast<std::uint32_t>(pdo.entries.size()), false, kAll});
  std::uint8_t sub = 0;
  for (const canopen::MapEntry& entry : pdo.entries)
    out.push_back({{mapping, ++sub}, 4, canopen::encode_map_entry(entry), false, kAll});
}

}  // namespace

std::vector<ExpectedObject> expected_objects(const NodeDescription& node, const DriveTiming& timing) {
  const auto profile = node_profile(node, timing);
  std::vector<ExpectedObject> expected;
  expect_identity(node.actuator ? node.actuator->identity : node.encoder_card->identity, expected);
  for (const DriveSetting& setting : profile->settings())
    expected.push_back({setting.object, setting.size, setting.value, setting.is_signed, kAll});
  for (const PdoSetting& pdo : profile->pdos()) expect_pdo(pdo, node.node, expected);
  return expected;
}

bool matches(const ExpectedObject& expected, std::uint32_t found) noexcept {
  return ((expected.value ^ found) & expected.mask) == 0;
}

}  // namespace sprung::cantools

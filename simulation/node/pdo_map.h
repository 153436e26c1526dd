#pragma once
/// What a device's PDOs carry, as its dictionary says (0x1400.., 0x1600.., 0x1800.., 0x1A00..), and which
/// changes of that it refuses: facts canopen 1.5.
#include <array>
#include <cstdint>

#include "drivers/canopen/pdo_words.h"
#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

enum class PdoDirection { kReceive, kTransmit };

/// One PDO, resolved.
struct PdoMap {
  bool valid = false;  ///< also false where the device does not have this PDO
  std::uint32_t cob_id = 0;
  bool answers_remote = false;  ///< transmit: a remote frame may ask for it
  int type = canopen::kTypeEvent;
  int count = 0;
  int length = 0;                 ///< bytes
  std::array<int, 8> position{};  ///< in the dictionary; -1 = dummy, skipped
  std::array<int, 8> bytes{};
};

/// @param n from 0.
PdoMap resolve_pdo(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept;

/// Whether this SDO write, in range already, may be done. @return 0 when it may or is none of PDOs' objects,
/// else an abort code: 06090030 identifiers and types that a PDO cannot have, 08000022 changes that need the
/// PDO invalid (identifier, inhibit time, map) or the map's count 0 (entries), 06020000, 06040041 and
/// 06040042 of what cannot be mapped.
std::uint32_t check_pdo_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                              std::uint32_t value) noexcept;

/// Which PDO an object configures.
struct PdoObject {
  PdoDirection direction = PdoDirection::kReceive;
  bool mapping = false;
  int n = -1;  ///< from 0; -1 = none, it is no object of PDOs
};
PdoObject pdo_object(std::uint16_t index) noexcept;

}  // namespace sprung::sim

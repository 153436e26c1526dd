#pragma once
/// What a device's PDOs carry, as its dictionary says (0x1400.., 0x1600.., 0x1800.., 0x1A00..), and which
/// changes of that it refuses: facts canopen 1.5.
#include <array>
#include <cstdint>

#include "drivers/sim/object_dictionary.h"

namespace sprung::sim {

enum class PdoDirection { kReceive, kTransmit };

/// One PDO, resolved.
struct PdoMap {
  bool valid = false;
  std::uint32_t cob_id = 0;
  int type = canopen::kTypeEvent;
  int count = 0;
  int length = 0;                 ///< bytes
  std::array<int, 8> position{};  ///< in the dictionary; -1 = dummy, skipped
  std::array<int, 8> bytes{};
};

/// @param n from 0.
PdoMap resolve_pdo(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept;

/// Whether this SDO write may be done. @return 0 when it may or is none of PDOs' objects, else an abort code.
std::uint32_t check_pdo_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                              std::uint32_t value) noexcept;

/// The object is one of the PDO configuration's.
bool configures_pdo(canopen::ObjectId id) noexcept;

}  // namespace sprung::sim

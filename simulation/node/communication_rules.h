#pragma once
/// Which SDO writes to the communication objects a device refuses, beyond type and limits (CiA 301; facts
/// canopen 1.1, 1.3, 1.6). PDO objects: pdo_map.h.
#include <cstdint>

#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

inline constexpr std::int64_t kSaveWord = 0x65766173;  ///< "save", for 0x1010
inline constexpr std::int64_t kLoadWord = 0x64616F6C;  ///< "load", for 0x1011

/// Whether no service may be moved to this identifier ([U] CiA 301).
bool restricted_id(std::uint32_t id) noexcept;

/// @param value in the object's range already. @return 0, also for objects without such rules, or
///   06090030 0x1003:00 not 0; an identifier or node that cannot be
///   08000020 0x1010, 0x1011 without their word
///   08000022 0x1014 moved while it is valid
///   06040043 0x1016: this node is in another entry already
std::uint32_t check_communication_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                                        std::int64_t value) noexcept;

/// Identifiers that hang on the node id (SDO, emergency, PDOs) become another node's, where they are the
/// maker's.
void renumber(ObjectDictionary& dictionary, int from_node, int to_node) noexcept;

/// 0x1010 and 0x1011: what is written is an order, and reading them gives what they can do.
bool is_store_order(canopen::ObjectId id) noexcept;
/// Does what 0x1010 or 0x1011 orders. A load counts from the next reset.
void obey_store_order(ObjectDictionary& dictionary, canopen::ObjectId id) noexcept;

}  // namespace sprung::sim

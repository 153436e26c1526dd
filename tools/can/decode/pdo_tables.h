#pragma once
/// Which objects travel in which PDO of which bus: begins with the robot's map and follows every change that
/// is seen in the SDO traffic, so that a trace of another configuration is read right too. Pure; allocates.
#include <array>
#include <vector>

#include "drivers/canopen/pdo_words.h"
#include "tools/can/decode/bus_description.h"

namespace sprung::cantools {

struct PdoTable {
  int bus = 0;
  int node = 0;
  bool transmit = false;  ///< seen from the node
  int number = 0;         ///< from 0
  std::uint32_t cob_id = 0;
  bool mapped = false;  ///< whether the map is known
  int count = 0;        ///< objects in force
  std::array<std::uint32_t, canopen::kMaxMapped> words{};

  int bits() const noexcept;
};

class PdoTables {
 public:
  explicit PdoTables(const BusDescription& description);

  /// nullptr where no PDO that is known uses this identifier.
  const PdoTable* find(int bus, std::uint32_t id) const noexcept;
  /// `value` was written to `object` of the node and acknowledged, or read from it; objects that are no PDO's
  /// are ignored.
  void learn(int bus, int node, canopen::ObjectId object, std::uint32_t value);
  /// The node came up again: what the bridge configures is in force, as far as anybody can say.
  void restore(int bus, int node);

 private:
  PdoTable& table(int bus, int node, bool transmit, int number);
  void configure(const NodeDescription& node);

  BusDescription description_;
  std::vector<PdoTable> tables_;
};

}  // namespace sprung::cantools

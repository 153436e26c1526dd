#include "tools/can/decode/pdo_tables.h"

#include <algorithm>

#include "drivers/canopen/objects.h"

namespace sprung::cantools {
namespace {

constexpr std::uint16_t kPdosPerKind = 512;  ///< CiA 301: 0x1400..0x15FF and so on

struct PdoObject {
  bool transmit;
  bool mapping;
  int number;
};

bool pdo_object(std::uint16_t index, PdoObject& out) {
  const PdoObject kinds[] = {{false, false, canopen::kRpdoCommunication},
                             {false, true, canopen::kRpdoMapping},
                             {true, false, canopen::kTpdoCommunication},
                             {true, true, canopen::kTpdoMapping}};
  for (const PdoObject& kind : kinds) {
    if (index < kind.number || index >= kind.number + kPdosPerKind) continue;
    out = {kind.transmit, kind.mapping, index - kind.number};
    return true;
  }
  return false;
}

std::uint32_t predefined_id(bool transmit, int number, int node) {
  if (number >= canopen::kPdoCount) return canopen::kPdoInvalid;
  return transmit ? canopen::tpdo_id(number, node) : canopen::rpdo_id(number, node);
}

}  // namespace

int PdoTable::bits() const noexcept {
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += canopen::decode_map_entry(words[i]).bits;
  return sum;
}

PdoTables::PdoTables(const BusDescription& description) : description_(description) {
  for (const NodeDescription& node : description_.nodes) configure(node);
}

void PdoTables::configure(const NodeDescription& node) {
  for (const PdoSetting& pdo : node.pdos) {
    PdoTable& known = table(node.bus, node.node, pdo.transmit, pdo.number);
    known.cob_id = predefined_id(pdo.transmit, pdo.number, node.node);
    if (pdo.entries.empty()) known.cob_id |= canopen::kPdoInvalid;
    known.mapped = true;
    known.count = static_cast<int>(pdo.entries.size());
    for (std::size_t i = 0; i < pdo.entries.size(); ++i)
      known.words[i] = canopen::encode_map_entry(pdo.entries[i]);
  }
}

void PdoTables::restore(int bus, int node) {
  const auto of_node = [&](const PdoTable& table) { return table.bus == bus && table.node == node; };
  tables_.erase(std::remove_if(tables_.begin(), tables_.end(), of_node), tables_.end());
  if (const NodeDescription* known = description_.find(bus, node)) configure(*known);
}

const PdoTable* PdoTables::find(int bus, std::uint32_t id) const noexcept {
  const auto found = std::find_if(tables_.begin(), tables_.end(), [&](const PdoTable& table) {
    return table.bus == bus && canopen::pdo_valid(table.cob_id) && (table.cob_id & canopen::kPdoIdMask) == id;
  });
  return found == tables_.end() ? nullptr : &*found;
}

PdoTable& PdoTables::table(int bus, int node, bool transmit, int number) {
  for (PdoTable& known : tables_) {
    if (known.bus == bus && known.node == node && known.transmit == transmit && known.number == number)
      return known;
  }
  PdoTable created;
  created.bus = bus;
  created.node = node;
  created.transmit = transmit;
  created.number = number;
  created.cob_id = predefined_id(transmit, number, node);
  tables_.push_back(created);
  return tables_.back();
}

void PdoTables::learn(int bus, int node, canopen::ObjectId object, std::uint32_t value) {
  PdoObject pdo{};
  if (!pdo_object(object.index, pdo)) return;
  PdoTable& known = table(bus, node, pdo.transmit, pdo.number);
  if (!pdo.mapping) {
    if (object.sub == 1) known.cob_id = value;
  } else if (object.sub == 0) {
    known.count = static_cast<int>(std::min<std::uint32_t>(value, canopen::kMaxMapped));
    known.mapped = true;
  } else if (object.sub <= canopen::kMaxMapped) {
    known.words[object.sub - 1U] = value;
  }
}

}  // namespace sprung::cantools

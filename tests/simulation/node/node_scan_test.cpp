/// Every object of every EDS, asked of the simulated node by SDO: type, access, limits, default, and the
/// abort code of every wrong request. The node is pre-operational and its PDOs are invalid, so that nothing
/// but the object's own rules speaks.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "drivers/canopen/objects.h"
#include "simulation/node/communication_rules.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

using canopen::EdsObject;

class NodeScan : public testing::TestWithParam<const char*> {
 protected:
  NodeScan() {
    for (int n = 0; n < canopen::kPdoCount; ++n) {
      for (const int base : {0x1400, 0x1800}) {
        if (!bench_.dictionary.has(NodeBench::id(base + n, 1))) continue;
        EXPECT_EQ(write(base + n, 1, 0x80000000, 4), 0U);
        EXPECT_EQ(write(base + n + 0x200, 0, 0, 1), 0U);
      }
    }
  }
  std::uint32_t write(int index, int sub, std::int64_t value, int size) {
    return bench_.write(index, sub, value, size);
  }
  /// `size` bytes, in segments when they are more than fit into one frame.
  std::uint32_t put(const EdsObject& object, std::int64_t value, int size) {
    if (size <= 4) return write(object.id.index, object.id.sub, value, size);
    std::string bytes;
    for (int i = 0; i < size; ++i)
      bytes.push_back(i < 8 ? static_cast<char>((value >> (8 * i)) & 0xFF) : '\0');
    return bench_.write_bytes(object.id.index, object.id.sub, bytes);
  }
  std::int64_t shown(const EdsObject& object) { return bench_.dictionary.get(object.id); }
  static bool is_number(const EdsObject& object) { return canopen::type_bytes(object.type) > 0; }
  static bool is_writable(const EdsObject& object) {
    return sim::is_writable(object.access) && is_number(object);
  }
  /// Orders and words with rules of their own (communication_rules_test.cpp, pdo_map_test.cpp).
  static bool has_own_rules(const EdsObject& object) {
    const std::uint16_t index = object.id.index;
    return is_store_order(object.id) || index == canopen::kErrorHistory ||
           index == canopen::kEmergencyCobId || index == canopen::kHeartbeatConsumer ||
           pdo_object(index).n >= 0;
  }

  canopen::Eds eds_ = load_eds(GetParam(), NodeBench::kNode);
  NodeBench bench_{GetParam()};
};

TEST_P(NodeScan, ReadingGivesTheTypesLengthAndTheDefault) {
  const NodeBench fresh(GetParam());
  for (const EdsObject& object : eds_.objects) {
    SCOPED_TRACE(canopen::id_text(object.id));
    const auto reply = bench_.ask(canopen::sdo_read_request(NodeBench::kNode, object.id));
    if (object.access == Access::kWriteOnly) {
      EXPECT_EQ(reply.value, canopen::kAbortWriteOnly);
    } else if (!is_number(object)) {
      EXPECT_EQ(bench_.read_bytes(object.id.index, object.id.sub), object.default_text);
    } else if (canopen::type_bytes(object.type) > 4) {
      EXPECT_EQ(reply.kind, canopen::SdoKind::kUploadBegin);
      EXPECT_EQ(reply.value, 8U);
    } else {
      EXPECT_EQ(reply.kind, canopen::SdoKind::kUpload);
      EXPECT_EQ(reply.size, canopen::type_bytes(object.type));
      if (object.default_value) {
        EXPECT_EQ(fresh.dictionary.get(object.id), *object.default_value);
      }
    }
  }
}

TEST_P(NodeScan, WhatMayNotBeWrittenIsRefusedFirstOfAll) {
  for (const EdsObject& object : eds_.objects) {
    if (sim::is_writable(object.access)) continue;
    SCOPED_TRACE(canopen::id_text(object.id));
    EXPECT_EQ(write(object.id.index, object.id.sub, 0, 1), canopen::kAbortReadOnly);
    EXPECT_EQ(write(object.id.index, object.id.sub, 0, 4), canopen::kAbortReadOnly);
  }
}

TEST_P(NodeScan, WrongLengthsAreRefused) {
  for (const EdsObject& object : eds_.objects) {
    if (!is_writable(object)) continue;
    SCOPED_TRACE(canopen::id_text(object.id));
    const int bytes = canopen::type_bytes(object.type);
    EXPECT_EQ(put(object, 0, bytes + 1), canopen::kAbortTooLong);
    if (bytes > 1) {
      EXPECT_EQ(put(object, 0, bytes - 1), canopen::kAbortTooShort);
    }
  }
}

TEST_P(NodeScan, LimitsAreTakenAndWhatIsBeyondIsRefused) {
  for (const EdsObject& object : eds_.objects) {
    if (!is_writable(object) || has_own_rules(object)) continue;
    SCOPED_TRACE(canopen::id_text(object.id));
    const int bytes = canopen::type_bytes(object.type);
    const auto fits = [&](std::int64_t value) {
      return from_wire(object.type, static_cast<std::uint64_t>(value)) == value;
    };
    if (object.low_limit) {
      EXPECT_EQ(put(object, *object.low_limit, bytes), 0U);
      EXPECT_EQ(shown(object), *object.low_limit);
      if (fits(*object.low_limit - 1)) {
        EXPECT_EQ(put(object, *object.low_limit - 1, bytes), canopen::kAbortTooLow);
      }
    }
    if (object.high_limit) {
      EXPECT_EQ(put(object, *object.high_limit, bytes), 0U);
      if (fits(*object.high_limit + 1)) {
        EXPECT_EQ(put(object, *object.high_limit + 1, bytes), canopen::kAbortTooHigh);
      }
      EXPECT_EQ(shown(object), *object.high_limit);
    }
  }
}

TEST_P(NodeScan, EveryBitOfAnUnlimitedNumberIsKept) {
  for (const EdsObject& object : eds_.objects) {
    if (!is_writable(object) || has_own_rules(object) || object.low_limit || object.high_limit) continue;
    if (object.type == ObjectType::kBoolean) continue;
    SCOPED_TRACE(canopen::id_text(object.id));
    for (const std::int64_t pattern : {0x5555555555555555LL, -0x5555555555555556LL}) {
      EXPECT_EQ(put(object, pattern, canopen::type_bytes(object.type)), 0U);
      EXPECT_EQ(shown(object), from_wire(object.type, static_cast<std::uint64_t>(pattern)));
    }
  }
}

TEST_P(NodeScan, WhatIsNotThereIsSaidToBeMissing) {
  for (int index = 0x1000; index <= 0x6FFF; ++index) {
    bool has_index = false;
    int missing_sub = 0;
    for (const EdsObject& object : eds_.objects) {
      if (object.id.index != index) continue;
      has_index = true;
      missing_sub = object.id.sub + 1;
    }
    if (!has_index && index % 16 != 0) continue;  // not all of them
    SCOPED_TRACE(index);
    EXPECT_EQ(bench_.read(index, missing_sub), has_index ? canopen::kAbortNoSub : canopen::kAbortNoObject);
  }
}

/// In both directions: into a PDO goes what the EDS says, and nothing else.
TEST_P(NodeScan, OnlyMappableObjectsCanBeMapped) {
  for (const EdsObject& object : eds_.objects) {
    SCOPED_TRACE(canopen::id_text(object.id));
    const std::uint32_t entry = canopen::encode_map_entry({object.id, 8 * canopen::type_bytes(object.type)});
    if (bench_.dictionary.has({0x1600, 1})) {
      EXPECT_EQ(write(0x1600, 1, entry, 4), object.map_receive ? 0U : canopen::kAbortNotMappable);
    }
    EXPECT_EQ(write(0x1A00, 1, entry, 4), object.map_transmit ? 0U : canopen::kAbortNotMappable);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, NodeScan, testing::Values("epos2", "gold", "encoder_card"),
                         [](const auto& device) { return std::string(device.param); });

}  // namespace
}  // namespace sprung::sim

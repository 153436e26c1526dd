/// Every class that lcm-gen made, against what tools/logs/fields reads from the same files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "every_message_class.h"
#include "tests/signals/message_bytes.h"
#include "tests/support/paths.h"
#include "tests/tools/logs/fields/random_message.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/lcm_text.h"

namespace sprung::fields {
namespace {

struct GeneratedClass {
  std::string name;
  std::int64_t hash;
  /// Decodes and encodes again; empty where the class does not take every byte.
  std::function<std::vector<std::uint8_t>(const std::vector<std::uint8_t>&)> round_trip;
};

template <class M>
GeneratedClass generated(const char* name) {
  return {name, M::getHash(), [](const std::vector<std::uint8_t>& bytes) -> std::vector<std::uint8_t> {
            M message;
            const int size = static_cast<int>(bytes.size());
            if (message.decode(bytes.data(), 0, size) != size) return {};
            return test::encoded(message);
          }};
}

std::vector<GeneratedClass> every_class() {
#define SPRUNG_LISTED(name) generated<sprung_msgs::name>(#name),
  std::vector<GeneratedClass> all{SPRUNG_EVERY_MESSAGE_CLASS(SPRUNG_LISTED)};
#undef SPRUNG_LISTED
  for (const StructType& unsent : TypeTable::sprung().constants())
    all.erase(
        std::remove_if(all.begin(), all.end(), [&](const auto& one) { return one.name == unsent.name; }),
        all.end());
  return all;
}

TEST(EveryType, IsThereAndHasTheFingerprintOfItsClass) {
  for (const GeneratedClass& one : every_class()) {
    const StructType* type = TypeTable::sprung().by_name(one.name);
    ASSERT_NE(type, nullptr) << one.name;
    EXPECT_EQ(type->hash, one.hash) << one.name;
    EXPECT_EQ(TypeTable::sprung().by_hash(one.hash), type) << one.name;
  }
  EXPECT_EQ(TypeTable::sprung().all().size(), every_class().size());
}

TEST(EveryType, OfEveryFileInTheFolderIsBuiltIn) {
  std::set<std::string> in_folder, built_in;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() + "/lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const StructType& type : parse_lcm(text)) in_folder.insert(type.name);
  }
  for (const StructType& type : TypeTable::sprung().all()) built_in.insert(type.name);
  for (const StructType& type : TypeTable::sprung().constants()) built_in.insert(type.name);
  EXPECT_EQ(built_in, in_folder);
}

TEST(EveryType, TakesTheSameBytesAsItsClass) {
  RandomBytes random(1);
  Decoder decoder;
  MessageView message;
  for (const GeneratedClass& one : every_class()) {
    for (int i = 0; i < 20; ++i) {
      const auto bytes = random.of(*TypeTable::sprung().by_hash(one.hash));
      EXPECT_EQ(one.round_trip(bytes), bytes) << one.name;
      EXPECT_EQ(decoder.open(bytes.data(), bytes.size(), message), Fault::kNone) << one.name;
      EXPECT_EQ(message.layout()->type->name, one.name);
    }
  }
}

TEST(EveryType, CoversEachByteByOneField) {
  RandomBytes random(2);
  Decoder decoder;
  MessageView message;
  for (const GeneratedClass& one : every_class()) {
    const auto bytes = random.of(*TypeTable::sprung().by_hash(one.hash));
    ASSERT_EQ(decoder.open(bytes.data(), bytes.size(), message), Fault::kNone);
    std::size_t sum = 8;
    for (const Field& field : message.fields())
      sum += field.wire == Wire::kString ? 4 + message.bytes(field).size() : field.size;
    EXPECT_EQ(sum, bytes.size()) << one.name;
  }
}

TEST(EveryType, NeverTakesMutilatedBytesForMore) {
  RandomBytes random(3);
  std::mt19937 dice(4);
  int refused = 0;
  for (const GeneratedClass& one : every_class()) {
    Decoder decoder;
    for (int i = 0; i < 300; ++i) {
      auto bytes = random.of(*TypeTable::sprung().by_hash(one.hash));
      for (unsigned hits = 1 + dice() % 4; hits > 0; --hits)
        bytes[8 + dice() % (bytes.size() - 8)] = static_cast<std::uint8_t>(dice());
      if (dice() % 3 == 0) bytes.resize(dice() % (bytes.size() + 1));
      bytes.shrink_to_fit();  // a sanitizer then sees any byte that is read beyond
      MessageView message;
      if (decoder.open(bytes.data(), bytes.size(), message) != Fault::kNone) {
        ++refused;
        continue;
      }
      const std::uint8_t* const end = bytes.data() + bytes.size();
      for (const Field& field : message.fields())
        EXPECT_LE(message.bytes(field).data() + message.bytes(field).size(), end);
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(EveryType, RealNumbersHaveUnitsOrAreListedAsPlain) {
  const std::set<std::string> plain{"measured_quaternion_wxyz",
                                    "estimated_quaternion_wxyz",
                                    "base_quaternion_wxyz",
                                    "contact_confidence",
                                    "friction_compensation",
                                    "velocity_feedforward",
                                    "inertia_compensation",
                                    "jump_height_scale",
                                    "misfit_ratio",
                                    "dry_friction_factor",
                                    "viscous_friction_factor",
                                    "gait_phase",
                                    "estimated_ground_slope",
                                    "estimated_ground_slope_bound",
                                    "parameter_value",
                                    "value"};
  RandomBytes random(5);
  Decoder decoder;
  MessageView message;
  for (const StructType& type : TypeTable::sprung().all()) {
    const auto bytes = random.of(type);
    ASSERT_EQ(decoder.open(bytes.data(), bytes.size(), message), Fault::kNone);
    for (const Field& field : message.fields()) {
      if (field.kind != Kind::kReal || plain.count(field.member->name) > 0) continue;
      EXPECT_NE(field.unit, "") << field.path;
    }
  }
}

}  // namespace
}  // namespace sprung::fields

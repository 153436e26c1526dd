/// Every class that lcm-gen made, against what tools/fields reads from the same files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "every_message_class.h"
#include "tests/signals/message_bytes.h"
#include "tools/fields/decoder.h"
#include "tools/fields/lcm_text.h"

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
  return {SPRUNG_EVERY_MESSAGE_CLASS(SPRUNG_LISTED)};
#undef SPRUNG_LISTED
}

/// Bytes of a message as the schema says: counts 0..3, texts of up to 5 letters, all else random.
class RandomBytes {
 public:
  explicit RandomBytes(unsigned seed) : random_(seed) {}

  std::vector<std::uint8_t> of(const StructType& type) {
    bytes_.clear();
    number(8, static_cast<std::uint64_t>(type.hash));
    structure(type);
    return bytes_;
  }

 private:
  void number(std::size_t size, std::uint64_t value) {
    for (std::size_t i = size; i > 0; --i)
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * (i - 1))));
  }

  void structure(const StructType& type) {
    std::vector<std::size_t> counts(type.members.size());
    for (std::size_t i = 0; i < type.members.size(); ++i) {
      const Member& member = type.members[i];
      if (member.is_count) {
        counts[i] = random_() % 4;
        number(size_of(member.wire), counts[i]);
        continue;
      }
      std::size_t elements = 1;
      for (const Dimension& dimension : member.dimensions)
        elements *= dimension.count_member < 0 ? static_cast<std::size_t>(dimension.fixed)
                                               : counts[static_cast<std::size_t>(dimension.count_member)];
      for (std::size_t e = 0; e < elements; ++e) element(member);
    }
  }

  void element(const Member& member) {
    if (member.wire == Wire::kStruct) return structure(*member.type);
    if (member.wire == Wire::kString) {
      const std::size_t letters = random_() % 6;
      number(4, letters + 1);
      for (std::size_t i = 0; i < letters; ++i)
        bytes_.push_back(static_cast<std::uint8_t>('a' + random_() % 26));
      return bytes_.push_back(0);
    }
    number(size_of(member.wire),
           member.wire == Wire::kBoolean ? random_() % 2 : random_() * 0x1000000ULL + random_());
  }

  std::mt19937 random_;
  std::vector<std::uint8_t> bytes_;
};

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
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SPRUNG_SOURCE_DIR) + "/lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const StructType& type : parse_lcm(text)) in_folder.insert(type.name);
  }
  for (const StructType& type : TypeTable::sprung().all()) built_in.insert(type.name);
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
                                    "gait_phase",
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

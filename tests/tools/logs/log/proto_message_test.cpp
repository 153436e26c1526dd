#include "tools/logs/log/proto_message.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "tests/tools/logs/fields/random_message.h"
#include "tests/tools/logs/log/proto_reader.h"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

using fields::Wire;

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// A number by its bits, so that NaN is compared too.
std::string bits_text(std::uint64_t bits, std::size_t size) {
  return std::to_string(size == 4 ? bits & 0xFFFFFFFFU : bits);
}

/// A scalar as the schema has it: 4 or 8 bytes of a real number, an integer's value, a truth.
std::string scalar_text(Wire wire, std::uint64_t bits) {
  if (wire == Wire::kDouble || wire == Wire::kInt64) return bits_text(bits, 8);
  if (wire == Wire::kFloat || wire == Wire::kBoolean || wire == Wire::kByte) return bits_text(bits, 4);
  return std::to_string(static_cast<std::int32_t>(bits));
}

std::size_t scalar_size(Wire wire) {
  return wire == Wire::kDouble || wire == Wire::kInt64 ? 8 : wire == Wire::kBoolean ? 1 : 4;
}

/// Every value of an encoded message in its order, each member's number and wire type looked at.
void flatten(const fields::StructType& type, std::string_view message, std::vector<std::string>& out) {
  std::size_t last = 0;
  for (const ProtoValue& value : proto_values(message)) {
    EXPECT_GE(value.field, last) << type.name;
    last = value.field;
    ASSERT_LE(value.field, type.members.size()) << type.name;
    const fields::Member& member = type.members[value.field - 1];
    const bool bytes = member.wire == Wire::kByte && !member.dimensions.empty();
    if (member.wire == Wire::kStruct) {
      EXPECT_EQ(value.wire, 2u);
      flatten(*member.type, value.bytes, out);
    } else if (member.wire == Wire::kString || bytes) {
      EXPECT_EQ(value.wire, 2u);
      out.push_back(value.bytes);
    } else if (!member.dimensions.empty()) {
      EXPECT_EQ(value.wire, 2u);
      for (ProtoReader list(value.bytes); !list.done();)
        out.push_back(scalar_text(member.wire, list.fixed(scalar_size(member.wire))));
    } else {
      EXPECT_EQ(value.wire, scalar_size(member.wire) == 8 ? 1u : scalar_size(member.wire) == 4 ? 5u : 0u);
      out.push_back(scalar_text(member.wire, value.number));
    }
  }
}

/// Every value that tools/logs/fields finds in LCM's bytes, likewise.
std::vector<std::string> flat_fields(const fields::MessageView& message) {
  std::vector<std::string> out;
  for (const fields::Field& field : message.fields()) {
    const auto raw = message.bytes(field);
    if (field.kind == fields::Kind::kText) {
      out.emplace_back(message.text(field));
    } else if (field.kind == fields::Kind::kBytes) {
      out.emplace_back(raw.begin(), raw.end());
    } else if (field.kind == fields::Kind::kReal) {
      std::uint64_t bits = 0;
      for (const std::uint8_t byte : raw) bits = bits << 8U | byte;
      out.push_back(bits_text(bits, raw.size()));
    } else {
      const std::int64_t value = message.integer(field);
      out.push_back(field.wire == Wire::kInt64 ? bits_text(static_cast<std::uint64_t>(value), 8)
                                               : std::to_string(value));
    }
  }
  return out;
}

class ProtoMessageTest : public testing::Test {
 protected:
  template <class Bytes>
  std::string encode(const Bytes& bytes) {
    EXPECT_EQ(decoder_->open(bytes.data(), bytes.size(), message_), fields::Fault::kNone);
    return std::string(messages_.encode(message_, bytes.data(), bytes.size()));
  }

  /// Every value must be what tools/logs/fields reads; of a text that is no UTF-8, only that it is there.
  void expect_same_values(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::string> found;
    const std::string encoded = encode(bytes);
    ASSERT_NO_THROW(flatten(*message_.layout()->type, encoded, found));
    const std::vector<std::string> expected = flat_fields(message_);
    ASSERT_EQ(found.size(), expected.size()) << message_.layout()->type->name;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const fields::Field& field = message_.fields()[i];
      if (field.kind == fields::Kind::kText && !is_ascii(expected[i])) continue;
      EXPECT_EQ(found[i], expected[i]) << message_.layout()->type->name << "." << field.path;
    }
  }

  fields::TypeTable own_;
  std::unique_ptr<fields::Decoder> decoder_ = std::make_unique<fields::Decoder>();
  fields::MessageView message_;
  ProtoMessages messages_;
};

TEST_F(ProtoMessageTest, EveryTypeKeepsEveryValue) {
  fields::RandomBytes random(1);
  for (const fields::StructType& type : fields::TypeTable::sprung().all()) {
    for (int i = 0; i < 20; ++i) expect_same_values(random.of(type));
  }
}

/// Bytes that a Decoder takes although they are damaged: no more is read or written than there is, and the
/// values are still the same.
TEST_F(ProtoMessageTest, SoDoMutilatedMessagesThatCanBeDecoded) {
  fields::RandomBytes random(3);
  std::mt19937 dice(4);
  int taken = 0;
  for (const fields::StructType& type : fields::TypeTable::sprung().all()) {
    for (int i = 0; i < 100; ++i) {
      auto bytes = random.of(type);
      for (unsigned hits = 1 + dice() % 4; hits > 0; --hits)
        bytes[8 + dice() % (bytes.size() - 8)] = static_cast<std::uint8_t>(dice());
      if (decoder_->open(bytes.data(), bytes.size(), message_) != fields::Fault::kNone) continue;
      ++taken;
      expect_same_values(bytes);
    }
  }
  EXPECT_GT(taken, 500);
}

/// What the stack's own types do not have: texts in structs in lists, lists of lists, small integers in
/// lists, a struct of nothing.
TEST_F(ProtoMessageTest, SoDoTypesOfEveryKind) {
  own_.add({R"(package demo;
    struct empty_t { }
    struct name_t { string name; float size; int16_t pair[2]; }
    struct group_t { int8_t n_names; name_t names[n_names]; byte label[6]; /* zero-terminated text */ }
    struct whole_t {
      int32_t n; int8_t small; byte one; byte grid[2][3]; double table[2][n]; group_t groups[n];
      boolean flags[3]; string texts[n]; int64_t big[2]; int32_t counts[n]; float reals[2][2]; empty_t nothing;
    })"});
  decoder_ = std::make_unique<fields::Decoder>(own_);
  fields::RandomBytes random(2);
  for (int i = 0; i < 300; ++i) expect_same_values(random.of(*own_.by_name("demo.whole_t")));
}

TEST_F(ProtoMessageTest, LongTextsInStructsPushWhatFollows) {
  own_.add(
      {"package demo; struct in_t { string text; int32_t n; } struct out_t { in_t first; in_t second; }"});
  decoder_ = std::make_unique<fields::Decoder>(own_);
  for (const std::size_t letters : {0u, 1u, 120u, 127u, 128u, 129u, 20'000u}) {
    std::string bytes;
    const auto put = [&bytes](std::uint64_t value, int size) {
      for (int i = size; i-- > 0;) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    };
    put(static_cast<std::uint64_t>(own_.by_name("out_t")->hash), 8);
    for (const std::uint64_t number : {7u, 8u}) {
      put(letters + 1, 4);
      bytes += std::string(letters, 'x') + '\0';
      put(number, 4);
    }
    const std::string encoded = encode(bytes);
    EXPECT_EQ(proto_bytes(proto_bytes(encoded, 1), 1), std::string(letters, 'x'));
    EXPECT_EQ(proto_values(proto_bytes(encoded, 1), 2)[0].number, 7u);
    EXPECT_EQ(proto_values(proto_bytes(encoded, 2), 2)[0].number, 8u);
  }
}

TEST_F(ProtoMessageTest, NumbersStandWhereTheirStructSays) {
  const std::string encoded = encode(joint_event(125).data);
  EXPECT_EQ(proto_values(encoded, 3)[0].number, 125u);  // seq
  const auto joints = proto_values(encoded, 6);
  ASSERT_EQ(joints.size(), 2u);
  double torque_Nm = 0.0;
  const std::uint64_t bits = proto_values(joints[1].bytes, 6)[0].number;
  std::memcpy(&torque_Nm, &bits, sizeof torque_Nm);
  EXPECT_EQ(torque_Nm, 2.25);
}

TEST_F(ProtoMessageTest, TextsThatAreNoUtf8AreMadeSo) {
  const auto* type = fields::TypeTable::sprung().by_name("motion_state_t");
  const auto text_of = [&](const std::string& text) {
    const std::string encoded = encode(motion_event(0, text).data);
    for (const ProtoValue& value : proto_values(encoded)) {
      if (type->members[value.field - 1].name == "state_name") return value.bytes;
    }
    return std::string("there is none");
  };
  EXPECT_EQ(text_of("say \"no\"\n\\ \xC3\xA4"), "say \"no\"\n\\ \xC3\xA4");
  EXPECT_EQ(text_of("\xFF!"), "\xEF\xBF\xBD!");
  EXPECT_EQ(text_of(std::string(1000, '\xFE')).size(), 3000u);
  EXPECT_EQ(text_of("\x1F\x01\x7F"), "\x1F\x01\x7F");
}

TEST_F(ProtoMessageTest, EveryShapeIsItsOwn) {
  auto one = stamped<sprung_msgs::joint_state_t>(3);
  one.n_joints = 1;
  one.joints.resize(1);
  EXPECT_EQ(proto_values(encode(joint_event(1).data), 6).size(), 2u);
  EXPECT_EQ(proto_values(encode(encoded(one)), 6).size(), 1u);
  EXPECT_EQ(proto_values(encode(joint_event(2).data), 6).size(), 2u);
  EXPECT_TRUE(proto_values(encode(encoded(stamped<sprung_msgs::joint_state_t>(4))), 6).empty());
}

}  // namespace
}  // namespace sprung::log

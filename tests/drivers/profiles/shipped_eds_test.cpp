/// The EDS files of the profiles: that they can be read, and that they say what a table says that was typed
/// by hand from other sources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "drivers/canopen/eds.h"
#include "drivers/profiles/profile_registry.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using canopen::Eds;
using canopen::EdsAccess;
using canopen::EdsObject;
using canopen::ObjectId;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kEdsNode = 5;
const std::string kTop = test::source_dir();

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

Eds load(const std::string& device) {
  const std::string path = kTop + "/drivers/profiles/" + device + "/" + device;
  return canopen::parse_eds(read_file(path + ".eds"), device + ".eds", kEdsNode,
                            read_file(path + ".extra.ini"));
}

/// One line of the table, every column as text.
using EdsRow = std::map<std::string, std::string>;

std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::vector<EdsRow> rows_of(const std::string& device) {
  std::istringstream in(read_file(kTop + "/tests/conformance/objects_by_hand.csv"));
  std::vector<std::string> names;
  std::vector<EdsRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> parts = columns(line);
    if (names.empty()) {
      names = parts;
      continue;
    }
    EXPECT_EQ(parts.size(), names.size()) << line;
    EdsRow row;
    for (std::size_t n = 0; n < names.size(); ++n) row[names[n]] = parts.at(n);
    if (row["device"] == device) rows.push_back(row);
  }
  return rows;
}

ObjectId id_of(EdsRow row) {
  return {static_cast<std::uint16_t>(std::stoul(row["index"], nullptr, 16)),
          static_cast<std::uint8_t>(std::stoul(row["sub"]))};
}

/// The table's number as decimal text; $NODEID+ is the only expression in it.
std::string number_text(std::string text) {
  const std::string node = "$NODEID+";
  const bool relative = text.rfind(node, 0) == 0;
  if (relative) text.erase(0, node.size());
  if (text.empty() || text == "?") return text;
  return std::to_string(std::stoll(text, nullptr, 0) + (relative ? kEdsNode : 0));
}

std::string limit_text(const std::optional<std::int64_t>& limit) {
  return limit ? std::to_string(*limit) : "";
}

std::string access_text(EdsAccess access) {
  switch (access) {
    case EdsAccess::kReadOnly:
      return "ro";
    case EdsAccess::kWriteOnly:
      return "wo";
    case EdsAccess::kReadWrite:
      return "rw";
    case EdsAccess::kConst:
      return "const";
  }
  return "";
}

EdsRow seen(const EdsObject& object) {
  const std::string map = std::string(object.map_receive ? "R" : "") + (object.map_transmit ? "T" : "");
  return {{"type", type_name(object.type)},
          {"access", access_text(object.access)},
          {"map", map.empty() ? "-" : map},
          {"default", limit_text(object.default_value)},
          {"low", limit_text(object.low_limit)},
          {"high", limit_text(object.high_limit)},
          {"unit", object.unit}};
}

/// Differences between file and table, one line each.
std::vector<std::string> differences(const std::string& device) {
  const Eds eds = load(device);
  std::vector<std::string> found;
  for (EdsRow row : rows_of(device)) {
    const EdsObject* const object = eds.find(id_of(row));
    const std::string id = canopen::id_text(id_of(row));
    if (object == nullptr) {
      found.push_back(id + " is not in the file");
      continue;
    }
    for (const char* const key : {"default", "low", "high"}) row[key] = number_text(row[key]);
    for (const auto& [key, value] : seen(*object)) {
      if (row[key] != "?" && row[key] != value)
        found.push_back(id + " " + key + ": table " + row[key] + ", file " + value);
    }
  }
  return found;
}

TEST(ProfileEds, Epos2SaysWhatTheFactsSay) {
  EXPECT_GE(rows_of("epos2").size(), 40u);
  EXPECT_THAT(differences("epos2"), IsEmpty());
}

TEST(ProfileEds, GoldSaysWhatTheFactsSay) {
  EXPECT_GE(rows_of("gold").size(), 25u);
  EXPECT_THAT(differences("gold"), IsEmpty());
}

TEST(ProfileEds, DevicesAreWhatTheFactsSay) {
  const Eds epos2 = load("epos2");
  EXPECT_EQ(epos2.device.vendor_number, 0xFBu);
  EXPECT_EQ(epos2.device.order_code, "347717");
  EXPECT_THAT(epos2.device.bit_rates_kbit_s, ElementsAre(20, 50, 125, 250, 500, 800, 1000));
  EXPECT_TRUE(epos2.device.lss);
  EXPECT_THAT(epos2.dummies, IsEmpty());
  const Eds gold = load("gold");
  EXPECT_EQ(gold.device.vendor_number, 0x9Au);
  EXPECT_THAT(gold.device.bit_rates_kbit_s, ElementsAre(50, 125, 250, 500, 1000));
  EXPECT_FALSE(gold.device.lss);
  EXPECT_THAT(gold.dummies, ElementsAre(5));
  for (const canopen::EdsDevice& device : {epos2.device, gold.device}) {
    EXPECT_EQ(device.receive_pdos, 4);
    EXPECT_EQ(device.transmit_pdos, 4);
  }
}

TEST(ProfileEds, WhatADriveLacksIsNotInItsFile) {
  const Eds epos2 = load("epos2");
  const ObjectId absent[] = {{0x1006, 0}, {0x1029, 1}, {0x603F, 0}, {0x605A, 0}, {0x6071, 0},
                             {0x6077, 0}, {0x1400, 5}, {0x1800, 5}, {0x1003, 6}, {0x1404, 1}};
  for (const ObjectId id : absent) EXPECT_EQ(epos2.find(id), nullptr) << canopen::id_text(id);
  const Eds gold = load("gold");
  const ObjectId gold_absent[] = {{0x2030, 0}, {0x1400, 5}, {0x1003, 17}};
  for (const ObjectId id : gold_absent) EXPECT_EQ(gold.find(id), nullptr) << canopen::id_text(id);
}

TEST(ProfileEds, TheEncoderCardSendsItsEncodersAtEverySync) {
  const Eds card = load("encoder_card");
  EXPECT_EQ(card.find({0x1800, 1})->default_value, 0x185);
  EXPECT_EQ(card.find({0x1800, 2})->default_value, 1);
  EXPECT_EQ(card.find({0x1A00, 0})->default_value, 1);
  EXPECT_EQ(card.find({0x1A00, 1})->default_value, 0x21000040);
  EXPECT_EQ(card.find({0x2100, 0})->type, canopen::EdsType::kU64);
  EXPECT_TRUE(card.find({0x2100, 0})->map_transmit);
  EXPECT_EQ(card.find({0x2101, 3})->high_limit, (1 << 20) - 1);
  EXPECT_EQ(card.find({0x2102, 0})->default_value, 3);
  EXPECT_EQ(card.device.transmit_pdos, 1);
  EXPECT_EQ(card.device.receive_pdos, 0);
}

/// Every mapped object of a default map is in the file, may go that way, and has as many bits as the entry
/// says.
void check_default_maps(const Eds& eds, std::uint16_t first, bool transmit) {
  for (std::uint16_t n = 0; n < 4; ++n) {
    const auto index = static_cast<std::uint16_t>(first + n);
    const EdsObject* const count = eds.find({index, 0});
    if (count == nullptr) continue;
    for (int sub = 1; sub <= *count->default_value; ++sub) {
      const std::int64_t entry = *eds.find({index, static_cast<std::uint8_t>(sub)})->default_value;
      const EdsObject* const object = eds.find(
          {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xFF)});
      ASSERT_NE(object, nullptr) << std::hex << entry;
      // The maker's own default: half of the binary interpreter's command, unmapped by whoever boots a Gold.
      const std::int64_t bits = entry == 0x20120020 ? 32 : 8 * type_bytes(object->type);
      EXPECT_EQ(bits, entry & 0xFF) << std::hex << entry;
      EXPECT_TRUE(transmit ? object->map_transmit : object->map_receive) << std::hex << entry;
    }
  }
}

TEST(ProfileEds, DefaultMapsHoldMappableObjectsOfTheirSize) {
  for (const char* const device : {"epos2", "gold", "encoder_card"}) {
    const Eds eds = load(device);
    check_default_maps(eds, 0x1600, false);
    check_default_maps(eds, 0x1A00, true);
  }
}

TEST(ProfileEds, SubZeroIsTheHighestSub) {
  for (const char* const device : {"epos2", "gold", "encoder_card"}) {
    const Eds eds = load(device);
    std::map<std::uint16_t, int> highest;
    for (const EdsObject& object : eds.objects) highest[object.id.index] = object.id.sub;
    for (const EdsObject& object : eds.objects) {
      const bool counts = object.id.sub == 0 && object.name == "number of entries";
      if (counts) {
        EXPECT_EQ(object.default_value, highest[object.id.index]) << device << canopen::id_text(object.id);
      }
    }
  }
}

TEST(ProfileEds, EveryNumberHasADefault) {
  for (const char* const device : {"epos2", "gold", "encoder_card"}) {
    for (const EdsObject& object : load(device).objects) {
      const bool known = type_bytes(object.type) > 0 ? object.default_value.has_value()
                                                     : !object.default_text.empty();
      EXPECT_TRUE(known) << device << " " << canopen::id_text(object.id);
    }
  }
}

TEST(ProfileEds, IdentityIsTheSameInBothPlaces) {
  for (const char* const device : {"epos2", "gold", "encoder_card"}) {
    const Eds eds = load(device);
    EXPECT_EQ(eds.find({0x1018, 1})->default_value, eds.device.vendor_number) << device;
    EXPECT_EQ(eds.find({0x1018, 2})->default_value, eds.device.product_number) << device;
    EXPECT_EQ(eds.find({0x1018, 3})->default_value, eds.device.revision_number) << device;
  }
}

TEST(ProfileEds, EmbeddedTextIsTheFile) {
  for (const ProfileKind* kind : profile_kinds()) {
    const std::string name = kind->name;
    const std::string path = kTop + "/drivers/profiles/" + name + "/" + name;
    ASSERT_NE(kind->eds_text, nullptr) << name;
    EXPECT_EQ(kind->eds_text(), read_file(path + ".eds")) << name;
    ASSERT_NE(kind->eds_extra_text, nullptr) << name;
    EXPECT_EQ(kind->eds_extra_text(), read_file(path + ".extra.ini")) << name;
  }
}

}  // namespace
}  // namespace sprung

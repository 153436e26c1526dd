#include "simulation/node/object_dictionary.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

#include "drivers/canopen/objects.h"
#include "tests/support/allocation_count.h"

namespace sprung::sim {
namespace {

constexpr canopen::ObjectId kTorque{0x6071, 0};
constexpr canopen::ObjectId kPeriod{0x60C2, 1};
constexpr canopen::ObjectId kExponent{0x60C2, 2};
constexpr canopen::ObjectId kVendor{0x1018, 1};
constexpr canopen::ObjectId kInterpreter{0x2012, 0};
constexpr canopen::ObjectId kCounter{0x2013, 0};
constexpr canopen::ObjectId kName{0x1008, 0};
constexpr canopen::ObjectId kLabel{0x2100, 0};
constexpr canopen::ObjectId kProgram{0x1F50, 1};
constexpr canopen::ObjectId kSwitch{0x2101, 0};

ObjectEntry text(canopen::ObjectId id, ObjectType type, Access access, const std::string& content) {
  ObjectEntry entry;
  entry.id = id;
  entry.type = type;
  entry.access = access;
  entry.text = content;
  return entry;
}

ObjectDictionary small() {
  const auto rw = Access::kReadWrite;
  return ObjectDictionary({{kTorque, ObjectType::kI16, rw, Mappable::kReceive, 0},
                           {kPeriod, ObjectType::kU8, rw, Mappable::kNo, 1, 1, 255},
                           {kExponent, ObjectType::kI8, rw, Mappable::kNo, -3, -6, -2},
                           {kVendor, ObjectType::kU32, Access::kReadOnly, Mappable::kNo, 0x9A},
                           {kInterpreter, ObjectType::kU64, Access::kWriteOnly, Mappable::kReceive, 0},
                           {kCounter, ObjectType::kI64, rw, Mappable::kNo, -2},
                           {kSwitch, ObjectType::kBoolean, rw, Mappable::kNo, 0, 0, 1},
                           {{canopen::kControlWord, 0}, ObjectType::kU16, rw, Mappable::kReceive, 0},
                           text(kName, ObjectType::kVisibleString, Access::kConst, "Gold drive"),
                           text(kLabel, ObjectType::kVisibleString, rw, "hip"),
                           text(kProgram, ObjectType::kDomain, rw, "")},
                          {0x0005});
}

class ObjectDictionaryTest : public testing::Test {
 protected:
  std::uint32_t read(canopen::ObjectId id) {
    size_ = 0;
    return dictionary_.read(id, bytes_.data(), bytes_.size(), size_);
  }
  std::string text_of(canopen::ObjectId id) {
    EXPECT_EQ(read(id), 0U);
    return {reinterpret_cast<const char*>(bytes_.data()), size_};
  }
  std::uint32_t write(canopen::ObjectId id, std::uint64_t raw, std::size_t size, bool told = true) {
    std::array<std::uint8_t, 8> bytes{};
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>((raw >> (8 * i)) & 0xFF);
    return put(id, bytes.data(), size, told);
  }
  std::uint32_t write(canopen::ObjectId id, const std::string& content) {
    return put(id, reinterpret_cast<const std::uint8_t*>(content.data()), content.size(), true);
  }
  std::uint32_t put(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size, bool told) {
    std::int64_t value = 0;
    const std::uint32_t error = dictionary_.check(id, bytes, size, told, value);
    if (error == 0) dictionary_.accept(id, bytes, size, value);
    return error;
  }

  ObjectDictionary dictionary_ = small();
  std::array<std::uint8_t, 64> bytes_{};
  std::size_t size_ = 0;
};

TEST_F(ObjectDictionaryTest, ReadsNumbersLittleEndianWithTheirSize) {
  EXPECT_EQ(read(kVendor), 0U);
  EXPECT_EQ(size_, 4U);
  EXPECT_EQ(bytes_[0], 0x9A);
  EXPECT_EQ(read(kExponent), 0U);
  EXPECT_EQ(size_, 1U);
  EXPECT_EQ(bytes_[0], 0xFD);  // -3
  EXPECT_EQ(read(kCounter), 0U);
  EXPECT_EQ(size_, 8U);
  EXPECT_EQ(bytes_[0], 0xFE);
  EXPECT_EQ(bytes_[7], 0xFF);
}

TEST_F(ObjectDictionaryTest, WritesSignedValuesOfEverySize) {
  EXPECT_EQ(write(kTorque, 0xFFFF, 2), 0U);
  EXPECT_EQ(dictionary_.get(kTorque), -1);
  EXPECT_EQ(write(kTorque, 0x8000, 4, false), 0U);  // size not told: it takes what it needs
  EXPECT_EQ(dictionary_.get(kTorque), -32768);
  EXPECT_EQ(write(kCounter, 0x8000000000000001ULL, 8), 0U);
  EXPECT_EQ(dictionary_.get(kCounter), std::numeric_limits<std::int64_t>::min() + 1);
  EXPECT_EQ(write(kInterpreter, 0xFFFFFFFFFFFFFFFFULL, 8), 0U);  // all of a u64's values are in range
}

TEST_F(ObjectDictionaryTest, RefusesWithTheRightAbortCode) {
  EXPECT_EQ(read({0x7777, 0}), canopen::kAbortNoObject);
  EXPECT_EQ(read({0x60C2, 9}), canopen::kAbortNoSub);
  EXPECT_EQ(read(kInterpreter), canopen::kAbortWriteOnly);
  EXPECT_EQ(write({0x7777, 0}, 0, 1), canopen::kAbortNoObject);
  EXPECT_EQ(write({0x60C2, 9}, 0, 1), canopen::kAbortNoSub);
  EXPECT_EQ(write(kVendor, 0, 4), canopen::kAbortReadOnly);
  EXPECT_EQ(write(kName, "Silver"), canopen::kAbortReadOnly);
  EXPECT_EQ(write(kTorque, 0, 4), canopen::kAbortTooLong);
  EXPECT_EQ(write(kTorque, 0, 1), canopen::kAbortTooShort);
  EXPECT_EQ(write(kCounter, 0, 4, false), canopen::kAbortTooShort);
  EXPECT_EQ(write(kPeriod, 0, 1), canopen::kAbortTooLow);
  EXPECT_EQ(write(kExponent, 0, 1), canopen::kAbortTooHigh);
  EXPECT_EQ(write(kSwitch, 2, 1), canopen::kAbortTooHigh);
  EXPECT_EQ(dictionary_.get(kPeriod), 1);
  EXPECT_EQ(dictionary_.get(kExponent), -3);
}

TEST_F(ObjectDictionaryTest, TextsHaveAnyLengthThatFits) {
  EXPECT_EQ(text_of(kName), "Gold drive");
  EXPECT_EQ(write(kLabel, "left knee"), 0U);
  EXPECT_EQ(text_of(kLabel), "left knee");
  EXPECT_EQ(write(kLabel, std::string(ObjectDictionary::kTextBytes, 'x')), 0U);
  EXPECT_EQ(write(kLabel, std::string(ObjectDictionary::kTextBytes + 1, 'x')), canopen::kAbortLength);
  EXPECT_EQ(write(kLabel, ""), 0U);
  EXPECT_EQ(text_of(kLabel), "");
}

TEST_F(ObjectDictionaryTest, ADomainThatWasNeverFilledHasNoData) {
  EXPECT_EQ(read(kProgram), canopen::kAbortNoData);
  EXPECT_EQ(write(kProgram, std::string(30, '\xA5')), 0U);
  EXPECT_EQ(text_of(kProgram), std::string(30, '\xA5'));
}

TEST_F(ObjectDictionaryTest, ProcessDataOutOfRangeIsIgnored) {
  const int position = dictionary_.find(kExponent);
  dictionary_.write_process(position, 0xFE);
  EXPECT_EQ(dictionary_.value(position), -2);
  dictionary_.write_process(position, 0x05);
  EXPECT_EQ(dictionary_.value(position), -2);
}

TEST_F(ObjectDictionaryTest, StoredValuesComeBackOthersDoNot) {
  dictionary_.set(kTorque, 5);
  write(kLabel, "left knee");
  dictionary_.store(0x2000, 0x6FFF);
  dictionary_.set(kTorque, 6);
  dictionary_.set(kPeriod, 9);
  write(kLabel, "");
  dictionary_.restart();
  EXPECT_EQ(dictionary_.get(kTorque), 5);
  EXPECT_EQ(dictionary_.get(kPeriod), 1);
  EXPECT_EQ(text_of(kLabel), "left knee");
}

TEST_F(ObjectDictionaryTest, StoringAndRecallingKeepToTheirIndexes) {
  dictionary_.set(kTorque, 5);
  dictionary_.set(kCounter, 7);
  dictionary_.store(0x6000, 0x6FFF);
  dictionary_.set(kTorque, 6);
  dictionary_.recall(0x2000, 0x2FFF);
  EXPECT_EQ(dictionary_.get(kTorque), 6);
  EXPECT_EQ(dictionary_.get(kCounter), -2);
}

TEST_F(ObjectDictionaryTest, ForgettingBringsTheMakersDefaultsAfterTheNextRestart) {
  dictionary_.set(kPeriod, 9);
  write(kLabel, "left knee");
  dictionary_.store(0x1000, 0xFFFF);
  dictionary_.forget(0x1000, 0xFFFF);
  EXPECT_EQ(dictionary_.get(kPeriod), 9);
  dictionary_.restart();
  EXPECT_EQ(dictionary_.get(kPeriod), 1);
  EXPECT_EQ(text_of(kLabel), "hip");
}

TEST_F(ObjectDictionaryTest, OrdersAndReadOnlyObjectsAreNotStored) {
  EXPECT_TRUE(dictionary_.storable(dictionary_.find(kTorque)));
  EXPECT_FALSE(dictionary_.storable(dictionary_.find(kVendor)));
  EXPECT_FALSE(dictionary_.storable(dictionary_.find({canopen::kControlWord, 0})));
}

TEST_F(ObjectDictionaryTest, HandlesSeeAndSetTheirObject) {
  ObjectHandle torque(dictionary_, kTorque);
  torque.set(-7);
  EXPECT_EQ(dictionary_.get(kTorque), -7);
  dictionary_.set(kTorque, 8);
  EXPECT_EQ(torque.get(), 8);
  EXPECT_THROW(ObjectHandle(dictionary_, {0x7777, 0}), std::invalid_argument);
}

TEST_F(ObjectDictionaryTest, NothingAllocatesOnceItIsBuilt) {
  const std::string longest(ObjectDictionary::kTextBytes, 'x');
  const std::int64_t before = test::allocation_count();
  write(kLabel, longest);
  dictionary_.store(0x1000, 0xFFFF);
  dictionary_.forget(0x1000, 0xFFFF);
  dictionary_.restart();
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(ObjectDictionary, ListingAnObjectTwiceIsRefused) {
  const ObjectEntry entry{kTorque, ObjectType::kI16, Access::kReadWrite, Mappable::kNo, 0};
  EXPECT_THROW(ObjectDictionary({entry, entry}), std::invalid_argument);
}

canopen::Eds two_objects() {
  canopen::Eds eds;
  canopen::EdsObject current;
  current.id = {0x6410, 1};
  current.type = ObjectType::kU16;
  current.access = Access::kReadWrite;
  current.default_value = 5000;
  current.high_limit = 5000;
  current.map_receive = current.map_transmit = true;
  canopen::EdsObject serial;
  serial.id = {0x1018, 4};
  eds.objects = {serial, current};
  eds.dummies = {0x0006};
  return eds;
}

TEST(ObjectDictionary, IsMadeFromAnEds) {
  const ObjectDictionary dictionary(two_objects());
  const ObjectEntry& current = dictionary.entry(dictionary.find({0x6410, 1}));
  EXPECT_EQ(dictionary.get({0x6410, 1}), 5000);
  EXPECT_EQ(current.high, 5000);
  EXPECT_EQ(current.low, kNoLow);
  EXPECT_EQ(current.mappable, Mappable::kBoth);
  EXPECT_TRUE(dictionary.has_dummy(0x0006));
  EXPECT_FALSE(dictionary.has_dummy(0x0005));
}

/// What was commissioned is lost with "load", but nobody can take a device its serial number.
TEST(ObjectDictionary, CommissioningIsStoredInWritableObjectsAndBuiltIntoOthers) {
  ObjectDictionary dictionary(two_objects(), {{{0x6410, 1}, 2270}, {{0x1018, 4}, 77}});
  dictionary.restart();
  EXPECT_EQ(dictionary.get({0x6410, 1}), 2270);
  dictionary.forget(0x1000, 0xFFFF);
  dictionary.restart();
  EXPECT_EQ(dictionary.get({0x6410, 1}), 5000);
  EXPECT_EQ(dictionary.get({0x1018, 4}), 77);
  EXPECT_THROW(ObjectDictionary(two_objects(), {{{0x7777, 0}, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::sim

/// What real drives were seen to say, through decoder and profile. The frames are made here; what they carry
/// is what their owners published:
///
///   [EPOS]  maxon EPOS, enabled by PDO and read by SDO: machinekit/machinekit, "HAL driver for CAN",
///           2015-07-06
///   [ING]   Ingenia drive beside a Lely master, boot-up, device type, overrun: ros-industrial/ros2_canopen,
///           "Launch File error"
///   [CIA]   a CiA 402 drive over EtherCAT (same words), off, on and moving: linuxcnc-ethercat,
///           "Add a generic CiA402 driver", 2024-03-30
///   [IPOS]  Technosoft iPOS, enabled, in a mode of its maker's
///   [NET]   CANopenNode's demo devices without stored parameters: CANopenNode documentation (Apache 2.0)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/protocol.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/drive_profile.h"
#include "robots/robot_loader.h"
#include "tools/can/decode/frame_decoder.h"
#include "tools/can/decode/word_texts.h"

namespace sprung::cantools {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

CanFrame seen(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  CanFrame frame;
  frame.id = id;
  for (const std::uint8_t byte : bytes) frame.data[frame.length++] = byte;
  return frame;
}

struct SeenWord {
  std::uint16_t word;
  PowerState state;
  const char* source;
};

// Upper bits that the maker may set as he likes differ from make to make; the state must not.
constexpr SeenWord kSeenWords[] = {
    {0x0740, PowerState::kSwitchOnDisabled, "EPOS"},
    {0x0721, PowerState::kReadyToSwitchOn, "EPOS"},
    {0x0723, PowerState::kSwitchedOn, "EPOS"},
    {0x0737, PowerState::kOperationEnabled, "EPOS"},
    {0x1A50, PowerState::kSwitchOnDisabled, "CIA"},
    {0x0A50, PowerState::kSwitchOnDisabled, "CIA"},
    {0x1A37, PowerState::kOperationEnabled, "CIA"},
    {0x1637, PowerState::kOperationEnabled, "CIA"},
    {0x8637, PowerState::kOperationEnabled, "IPOS"},
    {0x0240, PowerState::kSwitchOnDisabled, "facts canopen 2.2"},
    {0x0108, PowerState::kFault, "facts canopen 2.2"},
    {0x010F, PowerState::kFaultReactionActive, "facts canopen 2.2"},
    {0x4123, PowerState::kSwitchedOn, "facts canopen 2.2, refresh of the power stage"},
};

TEST(RealStatusWords, AreTheStatesThatTheirOwnersSaw) {
  for (const SeenWord& seen : kSeenWords)
    EXPECT_EQ(cia402::decode_status(seen.word), seen.state) << std::hex << seen.word << " " << seen.source;
}

TEST(RealStatusWords, SayInWordsWhatTheirBitsMean) {
  EXPECT_THAT(status_word_text(0x0737), AllOf(HasSubstr("operation enabled"), Not(HasSubstr("warning"))));
  EXPECT_THAT(status_word_text(0x0740), HasSubstr("switch on disabled"));
  EXPECT_THAT(status_word_text(0x1637), HasSubstr("operation enabled"));
}

// From its own answer each next control word is the one that was sent.
TEST(RealStatusWords, MasterTakesTheStepsThatWereSeenToWork) {
  constexpr std::pair<std::uint16_t, std::uint16_t> kSteps[] = {
      {0x0740, 0x0006}, {0x0721, 0x0007}, {0x0723, 0x000F}};
  for (const auto& [status, control] : kSteps)
    EXPECT_EQ(cia402::next_control_word(cia402::decode_status(status), cia402::PowerTarget::kEnabled),
              control);
}

TEST(RealStatusWords, ProfileHandsThemOn) {
  const RobotConfig robot = load_robot("pegasus");
  const auto profile = make_profile(robot.actuators[1], timing_of(robot.cycle_s, robot.watchdogs));
  for (const SeenWord& word : kSeenWords) {
    CanFrame frame = seen(canopen::tpdo_id(0, robot.actuators[1].node), {0, 0, 0, 0, 0, 0, 0, 0});
    canopen::put_le(&frame.data[6], word.word, 2);
    DriveSample sample;
    ASSERT_TRUE(profile->decode_sample(frame, sample));
    EXPECT_EQ(sample.status_word, word.word);
  }
}

/// Node 2 of pegasus' first bus is an EPOS2, as node 2 of [EPOS] was one of its forerunners.
class RealTrace : public testing::Test {
 protected:
  std::string text(const CanFrame& frame) {
    const DecodedFrame decoded = decoder_.decode({0, 0, Direction::kUnknown, frame});
    kind_ = decoded.kind;
    return decoded.text;
  }
  /// An object of node 2, as a master would, acknowledged.
  void write(canopen::ObjectId object, std::uint32_t value, int size) {
    text(canopen::sdo_write_request(2, object, value, size));
    text(canopen::sdo_write_reply(2, object));
  }
  FrameDecoder decoder_{describe_buses(load_robot("pegasus"))};
  FrameKind kind_ = FrameKind::kUnknown;
};

// Status word and control word alone, as an EPOS has them in its first PDOs when it is delivered.
TEST_F(RealTrace, EposIsEnabledByPdo) {
  write({0x1A00, 1}, 0x60410010, 4);
  write({0x1A00, 0}, 1, 1);
  write({0x1600, 1}, 0x60400010, 4);
  write({0x1600, 0}, 1, 1);
  EXPECT_THAT(text(seen(0x182, {0x40, 0x07})), HasSubstr("switch on disabled"));
  EXPECT_EQ(kind_, FrameKind::kTpdo);
  EXPECT_THAT(text(seen(0x202, {0x06, 0x00})), HasSubstr("shutdown"));
  EXPECT_EQ(kind_, FrameKind::kRpdo);
  EXPECT_THAT(text(seen(0x182, {0x21, 0x07})), HasSubstr("ready to switch on"));
  EXPECT_THAT(text(seen(0x202, {0x07, 0x00})), HasSubstr("switch on"));
  EXPECT_THAT(text(seen(0x182, {0x23, 0x07})), HasSubstr("switched on"));
  EXPECT_THAT(text(seen(0x202, {0x0F, 0x00})), HasSubstr("enable operation"));
  EXPECT_THAT(text(seen(0x182, {0x37, 0x07})), HasSubstr("operation enabled"));
}

TEST_F(RealTrace, EposIsReadBySdo) {
  EXPECT_EQ(text(seen(0x602, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0})).rfind("read 0x6041:00", 0), 0U);
  EXPECT_THAT(text(seen(0x582, {0x4B, 0x41, 0x60, 0, 0x37, 0x07, 0, 0})),
              AllOf(HasSubstr("0x6041:00"), HasSubstr("operation enabled")));
}

TEST_F(RealTrace, IngeniaBootsLateAndComplainsAboutTheBus) {
  text(seen(0x602, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_THAT(text(seen(0x602, {0x80, 0x00, 0x10, 0, 0, 0, 0x04, 0x05})), HasSubstr("0x05040000"));
  EXPECT_EQ(text(seen(0x702, {0})), "boot-up");
  EXPECT_THAT(text(seen(0x582, {0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0})), HasSubstr("0x1000:00"));
  EXPECT_THAT(text(seen(0x082, {0x10, 0x81, 0x11, 0, 0, 0, 0, 0})),
              AllOf(HasSubstr("0x8110"), HasSubstr("overrun"), HasSubstr("communication")));
  EXPECT_THAT(text(seen(0x082, {0x10, 0x81, 0x11, 0, 0x90, 0, 0, 0})), HasSubstr("maker's bytes 00 90"));
}

TEST_F(RealTrace, DemoDevicesTellOfTheirMissingMemory) {
  EXPECT_EQ(text(seen(0x704, {0})), "boot-up");
  EXPECT_THAT(text(seen(0x084, {0x00, 0x50, 0x01, 0x2F, 0x74, 0, 0, 0})),
              AllOf(HasSubstr("0x5000"), HasSubstr("generic"), HasSubstr("2F 74")));
}

// A status word with a mode of the maker's own behind it.
TEST_F(RealTrace, MapsThatAreNotKnownAreShownAsBytes) {
  EXPECT_THAT(text(seen(0x27F, {0x37, 0x86, 0xFE})), HasSubstr("37 86 FE (map not known)"));
}

}  // namespace
}  // namespace sprung::cantools

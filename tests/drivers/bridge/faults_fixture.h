#pragma once
/// A bridge with its drives enabled, and what is expected of it when something fails.
#include <gmock/gmock.h>

#include "drivers/can/can_errors.h"
#include "signals/bus_state.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {

class BridgeFaults : public test::PoweredBridge {
 protected:
  static constexpr std::uint32_t kHipSample = 0x181;

  const BusHealth& bus() const { return bench_.bridge->bus_state().buses[0]; }
  void expect_damping(SafetyCause expected, const char* text) {
    EXPECT_EQ(level(), SafetyLevel::kDamping);
    EXPECT_EQ(cause(), expected);
    EXPECT_TRUE(latched());
    EXPECT_THAT(bench_.detail(), ::testing::HasSubstr(text));
    bench_.run(400);  // 0.3 s at rest
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  }
  void expect_bus_lost(const char* text) {
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
    EXPECT_EQ(cause(), SafetyCause::kBusLost);
    EXPECT_TRUE(latched());
    EXPECT_THAT(bench_.detail(), ::testing::HasSubstr(text));
  }
  void expect_cleared() {
    bench_.on_answers = nullptr;
    bench_.run(900);
    EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
    bench_.enable();
    EXPECT_EQ(enabled(), 2);
  }
  /// For bend_samples: a second device answers after the first one, told apart by its data.
  static void a_second_device_answers(std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] = static_cast<std::uint8_t>(~other.data[0]);
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  }
  /// Calls `change` for every sample of the hip.
  template <class Change>
  void bend_samples(Change change) {
    bench_.on_answers = [change](std::vector<CanFrame>& frames) {
      for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].id == kHipSample) change(frames, i);
      }
    };
  }
  void controller_error(std::uint8_t detail) {
    CanFrame frame;
    frame.error = true;
    frame.length = 8;
    frame.id = kCanErrorController;
    frame.data[1] = detail;
    bench_.bridge->receive(0, frame, bench_.time_us);
  }
};

}  // namespace sprung

#include "tools/logs/spy/spy_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/logs/spy/sample_messages.h"

namespace sprung::spy {
namespace {

using testing::HasSubstr;
using testing::Not;

class SpyViewTest : public testing::Test {
 protected:
  void hear(int messages = 1) {
    for (int i = 0; i < messages; ++i) {
      now_us_ += 20'000;
      ++seq_;
      add("JOINT_STATE", test::joint_state_bytes(seq_, 10.0 * static_cast<double>(seq_ % 5)));
      add("MOTION_STATE", test::encoded(test::motion_state(seq_, 3)));
    }
  }
  void add(const char* channel, const std::vector<std::uint8_t>& bytes) {
    book_.add(now_us_, channel, bytes.data(), bytes.size());
  }
  std::string screen(std::size_t width = 130, std::size_t height = 40) {
    std::string out;
    const auto lines = view_.render(width, height, now_us_);
    EXPECT_EQ(lines.size(), height);
    for (const Line& line : lines) out += line.text + "\n";
    return out;
  }
  std::string selected() {
    for (const Line& line : view_.render(130, 40, now_us_)) {
      if (line.style == Style::kSelected) return line.text;
    }
    return "";
  }
  bool key(Key key) {
    const bool stays = view_.press({key, 0});
    screen();
    return stays;
  }
  bool letters(const std::string& text) {
    bool stays = true;
    for (const char letter : text) stays = view_.press({Key::kLetter, letter});
    screen();
    return stays;
  }

  ChannelBook book_;
  SpyView view_{book_, {{"joints", {"hip", "knee"}}}, "memory"};
  std::int64_t now_us_ = 0;
  std::int64_t seq_ = 0;
};

TEST_F(SpyViewTest, BeginsWithTheChannels) {
  EXPECT_THAT(screen(), HasSubstr("nothing heard yet"));
  hear(100);
  EXPECT_THAT(screen(), HasSubstr("JOINT_STATE       joint_state_t           50.0"));
  EXPECT_THAT(screen(), HasSubstr("MOTION_STATE"));
  EXPECT_THAT(screen(), HasSubstr("sprung spy  memory"));
}

TEST_F(SpyViewTest, EnterShowsFieldsWithNamesUnitsAndSmallPlots) {
  hear();
  screen();
  key(Key::kEnter);
  hear(10);
  EXPECT_THAT(screen(130, 50), HasSubstr("joints[knee].gear_output_torque_Nm"));
  EXPECT_THAT(screen(130, 50), HasSubstr("10 Nm"));
  EXPECT_THAT(screen(130, 60), HasSubstr("█"));
  EXPECT_THAT(screen(), HasSubstr("JOINT_STATE  joint_state_t"));
}

TEST_F(SpyViewTest, EnumerationsAndTextsAreReadable) {
  hear();
  screen();
  key(Key::kDown);
  key(Key::kEnter);
  EXPECT_THAT(screen(), HasSubstr("thrust (3)"));
  EXPECT_THAT(screen(), HasSubstr("state_name                                            thrust"));
}

TEST_F(SpyViewTest, EnterOnAFieldPlotsItAndBackLeadsOut) {
  hear();
  screen();
  view_.show_channel("JOINT_STATE");
  hear(20);
  screen();
  letters("/knee].gear_output_torque_Nm");
  key(Key::kEnter);
  key(Key::kEnter);
  EXPECT_THAT(screen(), HasSubstr("40 Nm"));
  EXPECT_THAT(screen(), HasSubstr("last 10 s"));
  EXPECT_THAT(screen(), HasSubstr("// what the link feels"));
  key(Key::kBack);
  EXPECT_THAT(screen(), HasSubstr("field  "));
  key(Key::kBack);
  EXPECT_THAT(screen(), HasSubstr("MOTION_STATE"));
}

TEST_F(SpyViewTest, TheCursorStaysInSightAndInTheList) {
  hear();
  view_.show_channel("JOINT_STATE");
  screen();
  key(Key::kUp);
  EXPECT_THAT(selected(), HasSubstr("session"));
  key(Key::kEnd);
  EXPECT_THAT(selected(), HasSubstr("mac"));
  key(Key::kPageUp);
  key(Key::kPageDown);
  key(Key::kDown);
  EXPECT_THAT(selected(), HasSubstr("mac"));
  letters("kk");
  EXPECT_THAT(selected(), Not(HasSubstr("mac")));
  key(Key::kHome);
  letters("j");
  EXPECT_THAT(selected(), HasSubstr("utime"));
}

TEST_F(SpyViewTest, FilterShowsOnlyWhatContainsIt) {
  hear();
  screen();
  letters("/MOT");
  EXPECT_THAT(screen(), Not(HasSubstr("JOINT_STATE")));
  EXPECT_THAT(screen(), HasSubstr("contains: MOT_"));
  letters("q");  // while typing, a letter like others
  EXPECT_THAT(screen(), HasSubstr("nothing with 'MOTq'"));
  key(Key::kErase);
  key(Key::kEnter);
  EXPECT_THAT(screen(), HasSubstr("[only 'MOT']"));
  letters("/");
  key(Key::kBack);
  EXPECT_THAT(screen(), HasSubstr("JOINT_STATE"));
}

TEST_F(SpyViewTest, PauseFreezesWhatIsShown) {
  hear(3);
  screen();
  letters(" ");
  EXPECT_THAT(screen(), HasSubstr("PAUSED"));
  const std::string before = screen();
  hear(50);
  EXPECT_EQ(screen(), before);
  letters(" ");
  EXPECT_NE(screen(), before);
  EXPECT_EQ(book_.find("JOINT_STATE")->gaps.counts().missing, 0);
}

TEST_F(SpyViewTest, QuitsFromEveryPage) {
  hear();
  screen();
  EXPECT_FALSE(letters("q"));
  EXPECT_TRUE(key(Key::kEnter));
  EXPECT_FALSE(letters("q"));
  EXPECT_TRUE(key(Key::kEnter));
  EXPECT_FALSE(letters("q"));
}

TEST_F(SpyViewTest, ChannelsThatMissCyclesStandOut) {
  hear();
  add("JOINT_STATE", test::joint_state_bytes(seq_ + 5, 0));
  screen();
  key(Key::kDown);  // the cursor's own colour would hide it
  const auto lines = view_.render(130, 40, now_us_);
  EXPECT_EQ(lines[2].style, Style::kWarning);
  EXPECT_THAT(lines[2].text, HasSubstr(" 4"));
}

TEST_F(SpyViewTest, AnyWindowIsBigEnough) {
  hear();
  for (const std::size_t width : {0U, 1U, 7U, 300U}) {
    for (const std::size_t height : {1U, 2U, 3U, 5U, 100U}) {
      view_.show_channel("JOINT_STATE");
      screen(width, height);
      view_.press({Key::kEnter, 0});
      screen(width, height);
      view_.press({Key::kBack, 0});
      view_.press({Key::kBack, 0});
      screen(width, height);
    }
  }
}

TEST_F(SpyViewTest, AFieldThatGoesAwayIsNamed) {
  hear();
  view_.show_channel("JOINT_STATE");
  screen();
  letters("/legs[0].contact_conf");
  key(Key::kEnter);
  key(Key::kEnter);
  auto without = test::joint_state(99, 0);
  without.n_legs = 0;
  without.legs.clear();
  add("JOINT_STATE", test::encoded(without));
  EXPECT_THAT(screen(), HasSubstr("legs[0].contact_confidence is not in the last message"));
}

}  // namespace
}  // namespace sprung::spy

#include "tools/logs/replay/replay_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "lcmtypes/channels.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/verify.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/log_messages.h"
#include "tools/logs/replay/log_diff.h"

namespace sprung {
namespace {

using test::Folder;

class ReplayRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder("replay-run");
    const test::LogsOf logs(folder_->path().string());
    test::run(test::jump_script_of(load_robot("single_leg")));
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string log() { return *folder_ / "single_leg-000.lcm"; }

  static ReplayRequest request() {
    ReplayRequest request;
    request.log = log();
    return request;
  }
  /// The log without some of its events.
  template <class Keep>
  static std::string copy_of_log(const char* name, Keep&& keep) {
    const std::string path = *folder_ / name;
    log::Reader reader(log());
    log::Writer writer(path);
    for (log::Event event; reader.next(event);) {
      if (keep(event)) writer.write(event);
    }
    writer.close();
    return path;
  }
  static bool is(const log::Event& event, const char* channel, std::int64_t seq) {
    return event.channel == channel && event.size > kCountsOffset &&
           read_int64(event.data, kSeqOffset) == seq;
  }

  static Folder* folder_;
};
Folder* ReplayRun::folder_ = nullptr;

TEST_F(ReplayRun, LogOfAJumpIsReproducedBitForBit) {
  const ReplayResult result = run_replay(request());
  EXPECT_TRUE(result.identical());
  EXPECT_EQ(result.counts.first_seq, 0);
  EXPECT_EQ(result.counts.last_seq, 2599);
  EXPECT_GE(result.counts.compared, 4 * 2600);
  EXPECT_EQ(result.robot, "single_leg");
  EXPECT_EQ(result.clock, "inprocess");
  EXPECT_NEAR(result.replayed_s, 2.6, 0.01);
  EXPECT_EQ(result.flaws.unanswered, 0);
}

TEST_F(ReplayRun, TheLogHasAFlightInIt) {
  log::Reader reader(log());
  std::string seen;
  for (log::Event event; reader.next(event);) {
    if (event.channel == channels::kMotionState)
      seen.append(reinterpret_cast<const char*>(event.data), event.size);
  }
  EXPECT_NE(seen.find("flight"), std::string::npos);
}

TEST_F(ReplayRun, EachCoreAloneIsReproducedToo) {
  for (const char* core :
       {"estimator", "planner", "controller", "estimator,controller", "planner,controller"}) {
    ReplayRequest request = this->request();
    request.cores = core_choice(core);
    const ReplayResult result = run_replay(request);
    EXPECT_TRUE(result.identical()) << core;
    EXPECT_GE(result.counts.compared, 2600) << core;
  }
}

TEST_F(ReplayRun, AnotherGainIsSeenInTheFirstMessageThatItChanges) {
  ReplayRequest request = this->request();
  request.robot = test::changed_robot("single_leg", "friction_compensation: 0.9",
                                      "friction_compensation: 0.8", *folder_);
  const ReplayResult result = run_replay(request);
  EXPECT_FALSE(result.identical());
  ASSERT_TRUE(result.differences.first());
  EXPECT_EQ(result.differences.first()->channel, "LEG_COMMAND");
  EXPECT_NE(result.differences.first()->field.path.find("friction_compensation"), std::string::npos);
  EXPECT_GT(result.counts.differing, 0);
}

TEST_F(ReplayRun, AnotherPresetDiffers) {
  ReplayRequest request = this->request();
  request.preset = "paper";
  EXPECT_FALSE(run_replay(request).identical());
}

TEST_F(ReplayRun, DifferencesBeforeTheSpanAreNotLookedAt) {
  ReplayRequest request = this->request();
  request.preset = "paper";
  request.from_s = 2.0;
  const ReplayResult late = run_replay(request);
  ASSERT_TRUE(late.differences.first());
  EXPECT_GE(late.differences.first()->time_s, 2.0);
  request.from_s = 0.0;
  request.to_s = 0.5;  // the drives boot first
  const ReplayResult early = run_replay(request);
  EXPECT_GT(early.counts.last_seq, 100);
  EXPECT_LE(early.counts.last_seq, 500);
}

TEST_F(ReplayRun, OnlyTheSpanIsCompared) {
  ReplayRequest request = this->request();
  request.from_s = 2.0;
  const ReplayResult late = run_replay(request);
  EXPECT_TRUE(late.identical());
  EXPECT_GT(late.counts.compared, 4 * 550);
  EXPECT_LT(late.counts.compared, 4 * 750);
  request.preset = "paper";
  EXPECT_LE(run_replay(request).counts.differing, late.counts.compared);
}

TEST_F(ReplayRun, SpanBehindTheEndOfTheLogIsNotIdentical) {
  ReplayRequest request = this->request();
  request.from_s = 1000.0;
  const ReplayResult result = run_replay(request);
  EXPECT_EQ(result.counts.compared, 0);
  EXPECT_FALSE(result.identical());
}

TEST_F(ReplayRun, FalsifiedMessageIsNamed) {
  const std::string path = *folder_ / "falsified.lcm";
  log::Reader reader(log());
  log::Writer writer(path);
  for (log::Event event; reader.next(event);) {
    Bytes bytes(event.data, event.data + event.size);
    if (is(event, channels::kDriveCommand, 1234))
      bytes[kCountsOffset + 4 + 7] ^= 1;  // last bit of the first double
    writer.write(event.time_us, event.channel, bytes.data(), bytes.size());
  }
  writer.close();
  ReplayRequest request = this->request();
  request.log = path;
  const ReplayResult result = run_replay(request);
  ASSERT_TRUE(result.differences.first());
  EXPECT_EQ(result.counts.differing, 1);
  EXPECT_EQ(result.differences.first()->channel, "DRIVE_COMMAND");
  EXPECT_EQ(result.differences.first()->seq, 1234);
  EXPECT_EQ(result.differences.first()->field.path, "actuators[0].commanded_torque_Nm");
}

TEST_F(ReplayRun, InputThatTheLogLacksIsNamedAndTheVerdictIsNotIdentical) {
  ReplayRequest request = this->request();
  request.log = copy_of_log("gap.lcm",
                            [](const log::Event& e) { return !is(e, channels::kDriveState, 700); });
  const ReplayResult result = run_replay(request);
  EXPECT_FALSE(result.identical());
  EXPECT_EQ(result.counts.incomplete, 1);
  EXPECT_NE(result.counts.first_incomplete.find("cycle 700: the estimator had DRIVE_STATE 700"),
            std::string::npos);
}

TEST_F(ReplayRun, OutputThatTheLogLacksIsMadeAllTheSame) {
  ReplayRequest request = this->request();
  request.log = copy_of_log("output-gap.lcm", [](const log::Event& e) {
    return !is(e, channels::kJointState, 700) && !is(e, channels::kLegCommand, 800);
  });
  const ReplayResult result = run_replay(request);
  EXPECT_EQ(result.counts.compared, run_replay(this->request()).counts.compared - 2);
  EXPECT_EQ(result.counts.differing, 0);
  EXPECT_EQ(result.counts.incomplete, 0);
}

/// Where each process waits for the others, `sprung log verify` calls such a log not good.
TEST_F(ReplayRun, MessagesThatAreNotThereAreNamedAndTheLogIsNotCalledIdentical) {
  ReplayRequest request = this->request();
  request.log = copy_of_log("not-there.lcm",
                            [](const log::Event& e) { return !is(e, channels::kJointState, 700); });
  const ReplayResult result = run_replay(request);
  EXPECT_FALSE(result.identical());
  EXPECT_EQ(result.lockstep.absent[0].not_in_log.text(), "700");
  EXPECT_TRUE(result.lockstep.deterministic());
  log::Reader reader(request.log);
  EXPECT_FALSE(log::verify(reader).good());
  request.from_s = 1.0;
  EXPECT_TRUE(run_replay(request).identical()) << "what is earlier is not looked at";
}

/// The log of a planner that held still for a while, made of one that did not: LEG_COMMAND 800 and 801 never
/// existed, and the leg controller did without.
TEST_F(ReplayRun, CyclesOfALockStepRunThatNeverExistedAreNamed) {
  const auto without = [](const log::Event& event) {
    const bool planners = event.channel == channels::kLegCommand || event.channel == channels::kMotionState;
    const std::int64_t seq = planners ? read_int64(event.data, kSeqOffset) : -1;
    return seq == 800 || seq == 801;
  };
  const auto changed = [](const log::Event& event) {
    if (event.channel == channels::kLogMetadata) {
      auto metadata = read_log_metadata(event.data, event.size);
      metadata->clock = "lockstep";
      return message_bytes(*metadata);
    }
    Bytes bytes(event.data, event.data + event.size);
    const bool did_without = is(event, channels::kDriveCommand, 801) ||
                             is(event, channels::kDriveCommand, 802);
    if (did_without) {
      const auto end = bytes.end() - kMacBytes;  // big-endian before it: used_leg_command_seq
      end[-2] = 799 >> 8;
      end[-1] = 799 & 0xff;
    }
    return bytes;
  };
  ReplayRequest request = this->request();
  request.log = *folder_ / "never.lcm";
  log::Reader reader(log());
  log::Writer writer(request.log);
  for (log::Event event; reader.next(event);) {
    if (without(event)) continue;
    const Bytes bytes = changed(event);
    writer.write(event.time_us, event.channel, bytes.data(), bytes.size());
  }
  writer.close();
  request.cores = core_choice("estimator");
  const ReplayResult result = run_replay(request);
  EXPECT_EQ(result.counts.differing, 0);
  EXPECT_FALSE(result.identical());
  EXPECT_FALSE(result.lockstep.deterministic());
  EXPECT_EQ(result.lockstep.older.text(), "801 to 802");
  EXPECT_EQ(result.lockstep.absent[1].never_made.text(), "800 to 801");
  EXPECT_EQ(result.lockstep.absent[2].never_made.text(), "800 to 801");
  log::Reader whole(request.log);
  EXPECT_FALSE(log::verify(whole).good()) << "and both say so";
}

TEST_F(ReplayRun, LogWithoutTheCoresMessagesIsNotIdentical) {
  ReplayRequest request = this->request();
  request.log = copy_of_log("truth.lcm", [](const log::Event& e) {
    return e.channel == channels::kSimTruth || e.channel == channels::kLogMetadata;
  });
  const ReplayResult result = run_replay(request);
  EXPECT_FALSE(result.identical());
  EXPECT_EQ(result.counts.compared, 0);
}

TEST_F(ReplayRun, WhatTheCoresSayNowIsALogThatDiffersNowhere) {
  ReplayRequest request = this->request();
  request.out = *folder_ / "now.lcm";
  run_replay(request);
  DiffRequest diff;
  diff.first = log();
  diff.second = request.out;
  diff.channels = {channels::kJointState, channels::kLegCommand, channels::kMotionState,
                   channels::kDriveCommand};
  const DiffResult result = diff_logs(diff);
  EXPECT_TRUE(result.identical());
  EXPECT_EQ(result.channels.at(channels::kJointState).in_both, 2600);
}

TEST_F(ReplayRun, WhatTheCoresSayNowSaysWhatMadeIt) {
  ReplayRequest request = this->request();
  request.robot = test::changed_robot("single_leg", "friction_compensation: 0.9",
                                      "friction_compensation: 0.8", *folder_);
  request.out = *folder_ / "changed.lcm";
  EXPECT_FALSE(run_replay(request).identical());
  const LoggedRun made = read_logged_run(request.out);
  ASSERT_TRUE(made.metadata);
  EXPECT_EQ(made.robot, "single_leg");
  EXPECT_EQ(made.metadata->preset, "best");
  EXPECT_EQ(made.metadata->simulation, 1);
  EXPECT_NE(made.metadata->robot_yaml.find("friction_compensation: 0.8"), std::string::npos);
  EXPECT_NE(made.metadata->command_line.find("--into estimator,planner,controller"), std::string::npos);
  EXPECT_NE(made.metadata->command_line.find("--robot " + request.robot), std::string::npos);
}

TEST_F(ReplayRun, TheLogItselfIsNotOverwritten) {
  ReplayRequest request = this->request();
  request.log = copy_of_log("own.lcm", [](const log::Event&) { return true; });
  const auto size = std::filesystem::file_size(request.log);
  request.out = *folder_ / "same.lcm";
  std::filesystem::create_hard_link(request.log, request.out);
  EXPECT_THROW(run_replay(request), std::invalid_argument);
  EXPECT_EQ(std::filesystem::file_size(request.log), size);
}

TEST_F(ReplayRun, LogOfAnotherRobotIsRefusedInWords) {
  ReplayRequest request = this->request();
  request.robot = "pegasus";
  try {
    run_replay(request);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("another robot"), std::string::npos);
  }
}

/// The estimator is cycles ahead of the others, in another thread: which error comes must not depend on that.
TEST_F(ReplayRun, ErrorInTheEarlierCycleIsTheOneThatComes) {
  const auto damaged = [](const char* name, std::int64_t drive_state_seq, std::int64_t leg_command_seq) {
    const std::string path = *folder_ / name;
    log::Reader reader(log());
    log::Writer writer(path);
    for (log::Event event; reader.next(event);) {
      Bytes bytes(event.data, event.data + event.size);
      if (is(event, channels::kDriveState, drive_state_seq) ||
          is(event, channels::kLegCommand, leg_command_seq))
        bytes[0] ^= 0xFF;
      writer.write(event.time_us, event.channel, bytes.data(), bytes.size());
    }
    writer.close();
    return path;
  };
  const auto error_and_cycles_of = [&](const std::string& path) {
    ReplayRequest request = this->request();
    request.log = path;
    request.cores = core_choice("estimator,controller");  // leg commands are read, not made
    request.out = *folder_ / "before-error.lcm";
    std::string error;
    try {
      run_replay(request);
    } catch (const std::runtime_error& thrown) {
      error = thrown.what();
    }
    std::int64_t last = -1;
    log::Reader reader(request.out);
    for (log::Event event; reader.next(event);) {
      if (event.channel == channels::kJointState) last = read_int64(event.data, kSeqOffset);
    }
    return std::pair(error.substr(0, error.find(" is of")), last);
  };
  using Seen = std::pair<std::string, std::int64_t>;
  EXPECT_EQ(error_and_cycles_of(damaged("a.lcm", 1000, 1001)), Seen("the log's DRIVE_STATE", 999));
  EXPECT_EQ(error_and_cycles_of(damaged("b.lcm", 1001, 1000)), Seen("the log's LEG_COMMAND", 1000));
  EXPECT_EQ(error_and_cycles_of(damaged("c.lcm", 1000, 1000)), Seen("the log's DRIVE_STATE", 999));
}

TEST_F(ReplayRun, ProgressIsToldInTheCallersThreadAndMayEndTheReplay) {
  ReplayRequest request = this->request();
  request.log = *folder_ / "long.lcm";  // enough events
  log::Reader reader(log());
  log::Writer writer(request.log);
  for (log::Event event; reader.next(event);) {
    writer.write(event);
    for (int i = 0; i < 5; ++i) writer.write(event.time_us, "OTHER", "x", 1);
  }
  writer.close();
  std::vector<std::uint64_t> told;
  const auto caller = std::this_thread::get_id();
  run_replay(request, [&](std::uint64_t done, std::uint64_t all) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_LE(done, all);
    told.push_back(done);
  });
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_THROW(run_replay(request, [](std::uint64_t, std::uint64_t) { throw std::out_of_range("enough"); }),
               std::out_of_range);
}

TEST_F(ReplayRun, CoresBeginFreshWithASecondSession) {
  const std::string path = *folder_ / "twice.lcm";
  log::Writer writer(path);
  for (int run = 0; run < 2; ++run) {
    log::Reader reader(log());
    for (log::Event event; reader.next(event);) {
      Bytes bytes(event.data, event.data + event.size);
      bytes[kSessionOffset + 6] = static_cast<std::uint8_t>(run);
      writer.write(event.time_us, event.channel, bytes.data(), bytes.size());
    }
  }
  writer.close();
  ReplayRequest request = this->request();
  request.log = path;
  const ReplayResult result = run_replay(request);
  EXPECT_TRUE(result.identical());
  EXPECT_GE(result.counts.compared, 2 * 4 * 2600);
}

TEST(CoreChoiceWords, AreReadInAnyOrder) {
  const CoreChoice choice = core_choice("controller,estimator");
  EXPECT_TRUE(choice[Core::kEstimator]);
  EXPECT_FALSE(choice[Core::kPlanner]);
  EXPECT_TRUE(choice[Core::kController]);
  EXPECT_THROW(core_choice("estimator,bridge"), std::invalid_argument);
  EXPECT_THROW(core_choice(""), std::invalid_argument);
}

}  // namespace
}  // namespace sprung

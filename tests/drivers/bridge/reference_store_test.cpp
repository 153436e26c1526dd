#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "drivers/bridge/reference_store_shell.h"
#include "robots/robot_loader.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> synced;  ///< what save() told the kernel to keep over a power cut, in order

std::string path_of(int fd) {
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd)).filename().string();
}

class ReferenceStoreTest : public ::testing::Test {
 protected:
  ReferenceStoreTest() {
    std::string name = ::testing::TempDir() + "sprung-reference-XXXXXX";
    folder_ = mkdtemp(name.data());
    path_ = folder_ + "/deeper/two_drives.reference.yaml";
    robot_.hash = -77;
  }
  ~ReferenceStoreTest() override { std::filesystem::remove_all(folder_); }

  void store_knee() {
    ReferenceStore store(path_, robot_);
    store.record(1, {0.1 + 0.2, true, ReferenceSource::kJig}, -4321, "2026-11-21T06:00:00Z");
    store.save();
  }
  std::string contents() const {
    std::ifstream in(path_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  RobotConfig robot_ = test::two_drive_robot();
  std::string folder_, path_;
};

TEST_F(ReferenceStoreTest, NoFileIsNoMistakeAndNoReference) {
  const ReferenceStore store(path_, robot_);
  EXPECT_FALSE(store.good_for(0));
  EXPECT_FALSE(store.good_for(1));
}

TEST_F(ReferenceStoreTest, KeepsOffsetsToTheBitWithDateMethodCountsAndHash) {
  store_knee();
  const ReferenceStore again(path_, robot_);
  ASSERT_TRUE(again.good_for(1));
  EXPECT_EQ(again.good_for(1)->offset_rad, 0.1 + 0.2);
  EXPECT_EQ(again.good_for(1)->source, ReferenceSource::kJig);
  EXPECT_TRUE(again.good_for(1)->known);
  EXPECT_FALSE(again.good_for(0));
  EXPECT_THAT(contents(), HasSubstr("robot_hash: -77\n"));
  EXPECT_THAT(contents(), HasSubstr("date: 2026-11-21T06:00:00Z\n"));
  EXPECT_THAT(contents(), HasSubstr("counts: -4321\n"));
  EXPECT_FALSE(std::filesystem::exists(path_ + ".new"));
}

TEST_F(ReferenceStoreTest, AZeroIsDoubtfulAfterItsMaxAge) {
  store_knee();
  robot_.actuators[1].reference.max_age_days = 30;
  const ReferenceStore again(path_, robot_);
  EXPECT_EQ(again.doubtful_days(1, "2026-12-21T08:00:00"), 0);
  EXPECT_EQ(again.doubtful_days(1, "2026-12-22"), 31);
  EXPECT_EQ(again.doubtful_days(0, "2030-01-01"), 0) << "there is none";
}

TEST_F(ReferenceStoreTest, ActuatorsThatAreNotHomedAgainKeepTheirEntry) {
  store_knee();
  ReferenceStore store(path_, robot_);
  store.record(0, {1.5, true, ReferenceSource::kLink}, 1, "2026-11-22T00:00:00Z");
  store.save();
  const ReferenceStore again(path_, robot_);
  EXPECT_EQ(again.good_for(0)->offset_rad, 1.5);
  EXPECT_EQ(again.good_for(1)->offset_rad, 0.1 + 0.2);
  EXPECT_THAT(contents(), HasSubstr("2026-11-21"));
}

TEST_F(ReferenceStoreTest, IncrementalEncoderGetsNothingBack) {
  store_knee();
  robot_.actuators[1].reference.absolute_encoder = false;
  EXPECT_FALSE(ReferenceStore(path_, robot_).good_for(1));
}

TEST_F(ReferenceStoreTest, AnotherDriveNodeOrGearGetsNothingBack) {
  store_knee();
  const RobotConfig same = robot_;
  robot_.actuators[1].identity.serial = 5;
  EXPECT_FALSE(ReferenceStore(path_, robot_).good_for(1));
  robot_ = same;
  robot_.actuators[1].node = 9;
  EXPECT_FALSE(ReferenceStore(path_, robot_).good_for(1));
  robot_ = same;
  robot_.actuators[1].gear_ratio = 50;
  EXPECT_FALSE(ReferenceStore(path_, robot_).good_for(1));
  robot_ = same;
  robot_.actuators[1].torque_limit_Nm = 50;
  EXPECT_TRUE(ReferenceStore(path_, robot_).good_for(1)) << "what does not touch the count does not matter";
}

TEST_F(ReferenceStoreTest, ZeroFoundForOtherNumbersOfRobotYamlIsNotUsed) {
  robot_.actuators[1].link_encoder = {0, 1, 1048576.0, 1.0, 0.1};
  store_knee();
  const RobotConfig same = robot_;
  const auto refused = [&](const auto& change) {
    robot_ = same;
    change(robot_.actuators[1]);
    return !ReferenceStore(path_, robot_).good_for(1);
  };
  EXPECT_FALSE(refused([](ActuatorConfig&) {}));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.offset_rad += 0.01; })) << "somebody has measured it anew";
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.link_encoder.offset_rad += 0.01; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.link_encoder.direction = -1.0; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.link_encoder.channel = 2; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.link_encoder.card = -1; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.link_encoder.counts_per_turn *= 2; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.reference.method = ReferenceMethod::kIndex; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.reference.jig_position_rad += 0.01; }));
  EXPECT_TRUE(refused([](ActuatorConfig& a) { a.reference.index_position_rad += 0.01; }));
  robot_ = same;
}

TEST_F(ReferenceStoreTest, SaysWhyAStoredZeroIsNotUsed) {
  store_knee();
  EXPECT_EQ(ReferenceStore(path_, robot_).why_not_used(0), "") << "nothing is stored";
  EXPECT_EQ(ReferenceStore(path_, robot_).why_not_used(1), "") << "it is used";
  const std::string knee = robot_.actuators[1].name;
  robot_.actuators[1].offset_rad = 0.25;
  EXPECT_THAT(ReferenceStore(path_, robot_).why_not_used(1),
              AllOf(HasSubstr(knee), HasSubstr("2026-11-21"), HasSubstr("'offset 0.1'"),
                    HasSubstr("'offset 0.25'"), Not(HasSubstr("gear")), HasSubstr("sprung home")));
  robot_.actuators[1].reference.absolute_encoder = false;
  EXPECT_THAT(ReferenceStore(path_, robot_).why_not_used(1), HasSubstr("incremental"));
}

// Without it a power cut leaves an empty file under the new name.
TEST_F(ReferenceStoreTest, FileIsOnDiskBeforeItTakesTheOldOnesPlaceAndTheFolderAfter) {
  synced.clear();
  store_knee();
  EXPECT_THAT(synced, ElementsAre("two_drives.reference.yaml.new", "deeper"));
}

TEST_F(ReferenceStoreTest, BadFileIsNamedWithLineAndRemedy) {
  store_knee();
  std::string text = contents();
  text.replace(text.find("method: jig"), 11, "method: eye");
  std::ofstream(path_) << text;
  try {
    const ReferenceStore store(path_, robot_);
    FAIL() << "accepted an unknown method";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("two_drives.reference.yaml:7: key "));
    EXPECT_THAT(error.what(), HasSubstr("found 'eye'"));
    EXPECT_THAT(error.what(), HasSubstr("delete it, then sprung home"));
  }
}

TEST_F(ReferenceStoreTest, FolderThatCannotBeWrittenIsNamed) {
  std::ofstream(folder_ + "/file") << "x";
  const ReferenceStore store(folder_ + "/file/r.yaml", robot_);
  try {
    store.save();
    FAIL() << "wrote into a file";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/file/r.yaml: the references cannot be stored"));
  }
}

TEST(ReferenceFile, SimulatedRobotHasItsOwnFile) {
  const char* before = std::getenv("SPRUNG_STATE_DIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("SPRUNG_STATE_DIR", "/state", 1);
  EXPECT_EQ(reference_file("leg", false), "/state/leg.reference.yaml");
  EXPECT_EQ(reference_file("leg", true), "/state/leg.simulated.reference.yaml");
  if (before == nullptr) {
    unsetenv("SPRUNG_STATE_DIR");
  } else {
    setenv("SPRUNG_STATE_DIR", kept.c_str(), 1);
  }
}

}  // namespace
}  // namespace sprung

/// In the place of the C library's.
extern "C" int fsync(int fd) {
  sprung::synced.push_back(sprung::path_of(fd));
  return 0;
}

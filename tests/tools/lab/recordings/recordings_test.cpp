#include "tools/lab/recordings/recordings.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung::recordings {
namespace {

/// A folder of recordings of this test's own.
class Recordings : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "recordings_" +
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_ / "ur10e");
    std::filesystem::create_directories(folder_ / "lara8");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  std::filesystem::path folder_;
};

TEST_F(Recordings, JointsOfTheUr10eAreColumnsOfItsTable) {
  std::string row = "100.5";
  for (int column = 2; column <= 31; ++column) row += "," + std::to_string(column);
  write("ur10e/joint_5.csv", row + "\n" + row + "\n");
  const Recording found = ur10e_joint(folder_, 5);
  EXPECT_EQ(found.series.time_s, (std::vector<double>{100.5, 100.5}));
  EXPECT_EQ(found.series.position_rad[0], 6.0);
  EXPECT_EQ(found.series.velocity_rad_s[0], 12.0);
  EXPECT_EQ(found.series.measured_torque[0], 18.0);
  EXPECT_EQ(found.series.torque_unit, "A");
  EXPECT_EQ(found.series.gear_ratio, 101.0);
  EXPECT_EQ(found.protocol.window.from_s, 8.0);
  EXPECT_EQ(found.protocol.window.to_s, 60.0);
  EXPECT_EQ(found.protocol.prepare.rate_Hz, 100.0);
  EXPECT_THROW(ur10e_joint(folder_, 7), std::invalid_argument);
  EXPECT_THROW(ur10e_joint(folder_, 1), std::runtime_error) << "no such file";
}

constexpr const char* kLara8Header =
    "Timestamp,joint_velocity_3,joint_torque_current_3,encoder_loadinc_3,encoder_motorinc_3,target_joint_"
    "torque_3,"
    "target_joint_velocity_3,fts_reading_1,fts_reading_5\n";

TEST_F(Recordings, LoadOfTheLara8IsInverseDynamicsWithoutFrictionPlusTheSensor) {
  write("lara8/joint_3_sweep.csv",
        std::string(kLara8Header) +
            "10.0,0.0,43,0,0,28,0.0,-16,-0.5\n10.004,0.5,70,8388608,847249408,50,0.5,10,2\n");
  const Recording found = lara8_joint_3(folder_);
  EXPECT_NEAR(found.series.load_Nm[0], 28.0 + 0.8735 * 16.0 + 0.5, 1e-9)
      << "at rest there is no friction to take off";
  const double friction_Nm = 6.527 + 1.149 * (12.0 * 0.5 + std::tanh(54.5 * 0.5));
  EXPECT_NEAR(found.series.load_Nm[1], 50.0 - friction_Nm - 0.8735 * 10.0 - 2.0, 1e-9);
  EXPECT_NEAR(found.series.link_position_rad[1], M_PI, 1e-9) << "half of 2^24 counts";
  EXPECT_NEAR(found.series.position_rad[1], M_PI, 1e-9) << "101 times as many on the motor";
  EXPECT_EQ(found.protocol.search.most_parameters, 8);
}

TEST_F(Recordings, PartsOfTheLara8AreEveryOtherSecond) {
  write("lara8/joint_3_sweep.csv", std::string(kLara8Header) + "10.0,0,43,0,0,28,0,0,0\n");
  const auto& protocol = lara8_joint_3(folder_).protocol;
  ASSERT_EQ(protocol.train.size(), 2u);
  EXPECT_NEAR(protocol.train[1].from_s * 6.0, 4.0, 1e-12);
  EXPECT_NEAR(protocol.test[1].from_s * 6.0, 5.0, 1e-12);
  EXPECT_NEAR(protocol.test[0].from_s, protocol.train[0].to_s, 1e-12);
}

TEST_F(Recordings, FolderIsTheOneAskedFor) {
  EXPECT_EQ(data_folder(folder_), folder_);
  EXPECT_THROW(data_folder(folder_ / "nowhere"), std::runtime_error);
}

TEST_F(Recordings, FolderOfTheEnvironmentIsTakenUnlessAnotherIsAskedFor) {
  const char* const before = std::getenv("SPRUNG_DATA");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("SPRUNG_DATA", (folder_ / "ur10e").c_str(), 1);
  EXPECT_EQ(data_folder(""), folder_ / "ur10e");
  EXPECT_EQ(data_folder(folder_), folder_);
  ::setenv("SPRUNG_DATA", (folder_ / "nowhere").c_str(), 1);
  EXPECT_THROW(data_folder(""), std::runtime_error);
  before != nullptr ? ::setenv("SPRUNG_DATA", kept.c_str(), 1) : ::unsetenv("SPRUNG_DATA");
}

}  // namespace
}  // namespace sprung::recordings

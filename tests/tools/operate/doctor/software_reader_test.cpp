#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tools/operate/doctor/robot_checks.h"
#include "tools/operate/doctor/software_reader_shell.h"

namespace sprung::doctor {
namespace {

namespace fs = std::filesystem;

class SoftwareReader : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "sprung_software";
    fs::create_directories(folder_);
    setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
    program("sprung-good", "echo sprung-good 0.1.0 '(abc)'");
  }
  void TearDown() override {
    fs::remove_all(folder_);
    unsetenv("SPRUNG_RUN_DIR");
  }
  void program(const std::string& name, const std::string& line) const {
    std::ofstream(folder_ / name) << "#!/bin/sh\n" << line << "\n";
    chmod((folder_ / name).c_str(), 0755);
  }
  std::string version(const std::string& name) const { return program_version((folder_ / name).string()); }
  fs::path folder_;
};

TEST_F(SoftwareReader, VersionIsWhatTheProgramSays) { EXPECT_EQ(version("sprung-good"), "0.1.0 (abc)"); }

TEST_F(SoftwareReader, MissingOrBrokenProgramHasNone) {
  program("sprung-mute", "exit 1");
  EXPECT_EQ(version("sprung-mute"), "");
  EXPECT_EQ(version("sprung-none"), "");
}

TEST_F(SoftwareReader, AllProgramsAndLcmAreLookedAt) {
  const SoftwareFacts facts = read_software(folder_.string(), {"sprung-good", "sprung-none"}, "default");
  EXPECT_EQ(facts.programs.at("sprung-good"), "0.1.0 (abc)");
  EXPECT_EQ(facts.programs.at("sprung-none"), "");
  EXPECT_TRUE(known_lcm(facts.lcm_version)) << facts.lcm_version;
  EXPECT_NE(facts.types_hash, 0);
  EXPECT_FALSE(facts.robot_is_up);
}

}  // namespace
}  // namespace sprung::doctor

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tools/operate/doctor/machine_reader_shell.h"

namespace sprung::doctor {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// A machine that is files alone.
class FakeMachine : public testing::Test {
 protected:
  void SetUp() override { root_ = test::temp_dir() + "sprung_machine"; }
  void TearDown() override { fs::remove_all(root_); }
  void file(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  KernelFacts facts() const { return read_kernel(root_.string()); }
  fs::path root_;
};

TEST_F(FakeMachine, EverythingIsReadFromItsPlace) {
  file("proc/sys/net/core/rmem_max", "4194304\n");
  file("sys/devices/system/cpu/online", "0-3\n");
  file("sys/devices/system/cpu/isolated", "2-3\n");
  file("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
  file("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave\n");
  file("sys/kernel/realtime", "1\n");
  file("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet\n");
  file("sys/devices/system/clocksource/clocksource0/available_clocksource", "hpet acpi_pm \n");
  const KernelFacts found = facts();
  EXPECT_EQ(found.receive_buffer_bytes, 4'194'304);
  EXPECT_THAT(found.cpus, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(found.isolated_cpus, ElementsAre(2, 3));
  EXPECT_EQ(found.governors.at("cpu1"), "powersave");
  EXPECT_EQ(found.governors.size(), 2u);
  EXPECT_TRUE(found.real_time);
  EXPECT_EQ(found.clock_source, "hpet");
  EXPECT_THAT(found.clock_sources, ElementsAre("hpet", "acpi_pm"));
}

TEST_F(FakeMachine, EmptyMachineIsReadToo) {
  const KernelFacts found = facts();
  EXPECT_EQ(found.receive_buffer_bytes, 0);
  EXPECT_THAT(found.governors, IsEmpty());
  EXPECT_THAT(found.isolated_cpus, IsEmpty());
  EXPECT_FALSE(found.real_time);
  EXPECT_EQ(found.multicast_device, "");
}

constexpr const char* kTitles = "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU Window IRTT\n";

TEST_F(FakeMachine, DefaultRouteCarriesMulticastUnlessALongerPrefixDoes) {
  const std::string by_default = "eth0 00000000 010200C0 0003 0 0 0 00000000 0 0 0\n";
  file("proc/net/route", kTitles + by_default);
  EXPECT_EQ(facts().multicast_device, "eth0");
  file("proc/net/route", kTitles + by_default + "lo 000000EF 00000000 0001 0 0 0 000000FF 0 0 0\n");
  EXPECT_EQ(facts().multicast_device, "lo");
}

TEST_F(FakeMachine, RouteThatIsDownOrLeadsElsewhereDoesNotCount) {
  file("proc/net/route", std::string(kTitles) + "eth0 000200C0 00000000 0001 0 0 0 00FFFFFF 0 0 0\n" +
                             "lo 000000EF 00000000 0000 0 0 0 000000FF 0 0 0\n");
  EXPECT_EQ(facts().multicast_device, "");
}

TEST(ParseCpus, RangesAndSingleOnes) {
  EXPECT_THAT(parse_cpus("0-2,5"), ElementsAre(0, 1, 2, 5));
  EXPECT_THAT(parse_cpus(""), IsEmpty());
}

TEST(ThisMachine, IsRead) {
  const KernelFacts found = read_kernel("/");
  EXPECT_GE(found.cpus.size(), 1u);
  EXPECT_GT(found.receive_buffer_bytes, 0);
  EXPECT_EQ(read_limits().superuser, geteuid() == 0);
}

TEST(Disk, FolderThatIsNotThereYetIsOnTheDiskOfItsParent) {
  const DiskFacts disk = read_disk("/tmp/no/such/folder");
  EXPECT_EQ(disk.folder, "/tmp/no/such/folder");
  EXPECT_NEAR(disk.free_MB, read_disk("/tmp").free_MB, 0.1 * disk.free_MB + 500.0);
}

}  // namespace
}  // namespace sprung::doctor

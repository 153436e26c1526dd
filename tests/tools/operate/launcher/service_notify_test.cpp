#include "tools/operate/launcher/service_notify.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/own_folder.h"

namespace sprung {
namespace {

/// Stands in for systemd: a datagram socket in the file system, or with an abstract name (first character @).
class ServiceNotifyTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "sprung_notify";
    std::filesystem::create_directories(folder_);
    name_ = GetParam() + (folder_ / "notify").string();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name_.data(), name_.size());
    if (name_[0] == '@') address.sun_path[0] = '\0';
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size());
    ASSERT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), length), 0);
    setenv("NOTIFY_SOCKET", name_.c_str(), 1);
    setenv("WATCHDOG_USEC", "2000000", 1);
    unsetenv("WATCHDOG_PID");
  }
  void TearDown() override {
    close(socket_);
    std::filesystem::remove_all(folder_);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) unsetenv(name);
  }
  std::string heard() const {
    std::array<char, 512> text{};
    const ssize_t got = recv(socket_, text.data(), text.size(), 0);
    return got < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(got));
  }
  std::filesystem::path folder_;
  std::string name_;
  int socket_ = -1;
};

INSTANTIATE_TEST_SUITE_P(File, ServiceNotifyTest, testing::Values("", "@"),
                         [](const auto& where) { return *where.param == '\0' ? "File" : "Abstract"; });

TEST_P(ServiceNotifyTest, SaysReadyWithAStatusAndStopping) {
  ServiceNotify notify;
  notify.ready("pegasus is up");
  EXPECT_EQ(heard(), "READY=1\nSTATUS=pegasus is up");
  notify.stopping();
  EXPECT_EQ(heard(), "STOPPING=1");
}

TEST_P(ServiceNotifyTest, KeepsAliveTwiceInTheWatchdogsTime) {
  ServiceNotify notify;
  EXPECT_TRUE(notify.keep_alive(5'000'000));
  EXPECT_EQ(heard(), "WATCHDOG=1");
  EXPECT_FALSE(notify.keep_alive(5'999'999));
  EXPECT_EQ(heard(), "");
  EXPECT_TRUE(notify.keep_alive(6'000'000));
}

TEST(ServiceNotify, WithoutSystemdItIsSilent) {
  unsetenv("NOTIFY_SOCKET");
  ServiceNotify notify;
  EXPECT_FALSE(notify.send("READY=1"));
  EXPECT_FALSE(notify.keep_alive(1'000'000));
}

TEST(ServiceNotify, WatchdogOfAnotherProcessIsNotOurs) {
  EXPECT_EQ(keep_alive_interval_us("10000000", "41", 42), 0);
  EXPECT_EQ(keep_alive_interval_us("10000000", "42", 42), 5'000'000);
  EXPECT_EQ(keep_alive_interval_us("10000000", nullptr, 42), 5'000'000);
  EXPECT_EQ(keep_alive_interval_us(nullptr, nullptr, 42), 0);
}

}  // namespace
}  // namespace sprung

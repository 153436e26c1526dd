#include "runtime/own_port.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <set>

namespace sprung {
namespace {

TEST(OwnPort, IsNeverGivenTwiceAndNotOneThatTheKernelHandsOut) {
  std::set<int> ports;
  for (int i = 0; i < 200; ++i) {
    const int port = own_port();
    EXPECT_TRUE(ports.insert(port).second) << port;
    EXPECT_GE(port, 1024);
    EXPECT_LT(port, 32'768);
  }
}

/// So many that processes who knew nothing of each other would choose some fifteen twice.
TEST(OwnPort, IsNoOtherProcesssEither) {
  constexpr std::size_t kEach = 200;
  std::array<int, 2> theirs{}, done{};
  ASSERT_EQ(pipe(theirs.data()), 0);
  ASSERT_EQ(pipe(done.data()), 0);
  std::set<int> all;
  std::array<pid_t, 3> children{};
  for (pid_t& child : children) {
    child = fork();
    if (child != 0) continue;
    for (std::size_t i = 0; i < kEach; ++i) {
      const int port = own_port();
      if (write(theirs[1], &port, sizeof port) != sizeof port) _exit(1);
    }
    close(done[1]);
    char end = 0;
    _exit(read(done[0], &end, 1) == 0 ? 0 : 1);  // keeps its ports until the parent has its own
  }
  for (std::size_t i = 0; i < kEach; ++i) EXPECT_TRUE(all.insert(own_port()).second);
  for (std::size_t i = 0; i < children.size() * kEach; ++i) {
    int port = 0;
    ASSERT_EQ(read(theirs[0], &port, sizeof port), static_cast<ssize_t>(sizeof port));
    EXPECT_TRUE(all.insert(port).second) << port;
  }
  close(done[1]);
  for (const pid_t child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  for (const int fd : {theirs[0], theirs[1], done[0]}) close(fd);
}

/// LCM's sockets bind to every address of the machine and let others share the port: they are seen all the
/// same.
TEST(OwnPort, IsNotOneThatIsInUse) {
  std::set<int> taken, sockets;
  for (int port = 20'000; port < 20'200; ++port) {
    const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) taken.insert(port);
    sockets.insert(fd);
  }
  EXPECT_GT(taken.size(), 100u);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(taken.count(own_port()), 0u);
  for (const int fd : sockets) close(fd);
}

}  // namespace
}  // namespace sprung

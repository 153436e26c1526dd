/// The receiver against LCM's own sender, and against whoever sends something else.
#include "runtime/transport/lcm_receiver.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "runtime/resource_use.h"
#include "tests/runtime/lcm_network.h"
#include "tests/runtime/transport/datagrams.h"

namespace sprung {
namespace {

using test::Bytes;
using test::with_channel;

class LcmReceiverTest : public testing::Test {
 protected:
  void SetUp() override { raw_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0); }
  void TearDown() override { close(raw_); }

  void publish(const std::string& channel, const std::string& data) {
    ASSERT_EQ(lcm_publish(sender_.get(), channel.c_str(), data.data(), static_cast<unsigned>(data.size())),
              0);
  }
  /// To the group, or to another address of this machine.
  void send(const Bytes& bytes, const char* host = nullptr) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(address_.port);
    inet_pton(AF_INET, host != nullptr ? host : address_.group.c_str(), &to.sin_addr);
    ASSERT_GE(sendto(raw_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  }
  /// Everything up to a message on channel END, which comes last: "CHANNEL:data" each.
  std::vector<std::string> heard(LcmReceiver& receiver) {
    publish("END", "");
    std::vector<std::string> out;
    for (bool ended = false; !ended;) {
      pollfd wait{receiver.fd(), POLLIN, 0};
      if (poll(&wait, 1, 20'000) != 1) {
        ADD_FAILURE() << "the last message has not come";
        break;
      }
      receiver.receive([&](const ReceivedMessage& message) {
        if (message.channel == "END") {
          ended = true;
        } else if (message.channel != "LCM_SELF_TEST") {
          out.push_back(std::string(message.channel) + ":" +
                        std::string(message.data, message.data + message.size));
        }
      });
    }
    return out;
  }

  const std::string url_ = test::own_lcm_url();
  const LcmAddress address_ = LcmAddress::of(url_);
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> sender_{lcm_create(url_.c_str()), lcm_destroy};
  int raw_ = -1;
};

using Strings = std::vector<std::string>;

TEST_F(LcmReceiverTest, HearsWhatLcmSendsInItsOrder) {
  LcmReceiver receiver(url_, Fragments::kRefused);
  Strings sent;
  for (int i = 0; i < 50; ++i) {
    publish("CH", std::to_string(i));
    sent.push_back("CH:" + std::to_string(i));
  }
  EXPECT_EQ(heard(receiver), sent);
}

TEST_F(LcmReceiverTest, MessageHasTheTimeAtWhichTheKernelHadIt) {
  LcmReceiver receiver(url_, Fragments::kRefused);
  publish("CH", "a");
  std::int64_t utc_us = 0;
  pollfd wait{receiver.fd(), POLLIN, 0};
  ASSERT_EQ(poll(&wait, 1, 20'000), 1);
  receiver.receive([&](const ReceivedMessage& message) { utc_us = message.utc_us; });
  EXPECT_GT(utc_us, 1'600'000'000'000'000);
}

TEST_F(LcmReceiverTest, LargeMessageIsPutTogetherOrRefusedAsAsked) {
  const std::string large(150'000, 'x');
  LcmReceiver safe(url_, Fragments::kPutTogether);
  LcmReceiver strict(url_, Fragments::kRefused);
  publish("LARGE", large);
  EXPECT_EQ(heard(safe), Strings{"LARGE:" + large});
  EXPECT_EQ(safe.counts().fragments, 0);
  EXPECT_EQ(heard(strict), Strings{});
  EXPECT_EQ(strict.counts().fragments, 3);
}

/// hazards 9 and 10: each of these ended a process that received by LCM 1.3.1.
TEST_F(LcmReceiverTest, DatagramsThatEndLcmAreCountedAndTheNextMessageIsHeard) {
  for (const Fragments fragments : {Fragments::kRefused, Fragments::kPutTogether}) {
    LcmReceiver receiver(url_, fragments);
    publish("CH", "before");
    send(test::fragment_datagram({1, 200, 0, 0, 3}, with_channel(std::string(50, 'x'))));
    send(test::fragment_datagram({1, 200, 0xFFFFFF9C, 1, 3}, std::string(100, 'x')));
    Bytes endless = test::short_datagram(1, "CHANNEL", "");
    endless.pop_back();
    send(endless);
    publish("CH", "after");
    EXPECT_EQ(heard(receiver), (Strings{"CH:before", "CH:after"}));
    EXPECT_EQ(receiver.counts().malformed, 2);
    EXPECT_EQ(receiver.counts().fragments, fragments == Fragments::kRefused ? 1 : 0);
  }
}

TEST_F(LcmReceiverTest, WhatIsSentToTheMachineAndNotToTheGroupIsNotHeard) {
  LcmReceiver receiver(url_, Fragments::kRefused);
  send(test::short_datagram(1, "CH", "unicast"), "127.0.0.1");
  EXPECT_EQ(heard(receiver), Strings{});
}

TEST_F(LcmReceiverTest, RandomDatagramsAreSurvivedInConstantMemory) {
  LcmReceiver receiver(url_, Fragments::kPutTogether);
  std::mt19937 random(7);
  std::int64_t memory_before_kB = 0;
  for (int lap = 0; lap < 40; ++lap) {
    for (int i = 0; i < 100; ++i) {
      const auto size = static_cast<std::uint32_t>(random() % 4 == 0 ? random() : random() % 100'000);
      const auto count = static_cast<std::uint16_t>(random() % 5);
      const test::FragmentHead head{static_cast<std::uint32_t>(random() % 1000), size,
                                    static_cast<std::uint32_t>(random() % 3 == 0 ? random() : 0),
                                    static_cast<std::uint16_t>(random() % 4), count};
      Bytes bytes = test::fragment_datagram(head, with_channel(std::string(random() % 300, 'x')));
      if (random() % 3 == 0) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      send(bytes);
    }
    heard(receiver);
    if (lap == 10) memory_before_kB = resident_kB();
  }
  EXPECT_GT(receiver.counts().malformed, 1000);
  EXPECT_LT(resident_kB() - memory_before_kB, 2 * (FragmentStore::kMostBytes >> 10U));
}

TEST_F(LcmReceiverTest, InterfaceThatIsNotThereIsNamed) {
  try {
    LcmReceiver receiver(url_ + "&interface=none7", Fragments::kRefused);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("none7"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sprung

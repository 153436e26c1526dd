/// What somebody without the key can do with messages of every channel that carries a MAC: nothing. Guard and
/// slot as a process has them, at full speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/receive_guard.h"
#include "runtime/resource_use.h"
#include "runtime/slot.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/messages.h"
#include "signals/operator.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kForgerySession = 4711;
constexpr std::int64_t kForgeryCycle_us = 1000;
constexpr std::int64_t kFirst = 10'000;  ///< cycle that the tests begin with

std::shared_ptr<const MessageKey> key_of(std::uint8_t number) {
  return std::make_shared<const MessageKey>(std::array<std::uint8_t, kKeyBytes>{number});
}

void put_int64(Bytes& bytes, std::size_t offset, std::int64_t value) {
  for (std::size_t i = 0; i < 8; ++i)
    bytes[offset + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (56U - 8U * i));
}

/// One channel as a process hears it; knows no types.
class Ear {
 public:
  virtual ~Ear() = default;
  virtual Refusal hears(const Bytes& bytes, std::int64_t now_us) = 0;
  virtual std::int64_t newest() const = 0;  ///< cycle of the newest that was obeyed
  virtual const ReceiveGuard& guard() const = 0;
  virtual Bytes said(std::int64_t seq, const MessageKey* key) const = 0;
};

template <class Signal>
class EarFor : public Ear {
 public:
  EarFor(const char* channel, const CountLimits& limits, const Signal& prototype, bool lockstep)
      : guard_(channel, layout_of<MessageOf<Signal>>(), limits, kForgerySession),
        prototype_(prototype),
        slot_(prototype) {
    guard_.demand(key_of(1), lockstep);
  }
  Refusal hears(const Bytes& bytes, std::int64_t now_us) override {
    const Refusal refusal = guard_.decode(bytes.data(), bytes.size(), message_, now_us);
    if (refusal == Refusal::kNone && from_message(message_, signal_) && is_new(signal_.stamp.seq))
      slot_.push(signal_);
    return refusal;
  }
  std::int64_t newest() const override {
    Signal signal = prototype_;
    return slot_.newest(signal) ? signal.stamp.seq : -1;
  }
  const ReceiveGuard& guard() const override { return guard_; }
  Bytes said(std::int64_t seq, const MessageKey* key) const override {
    Signal signal = prototype_;
    signal.stamp = {seq * kForgeryCycle_us, seq};
    MessageOf<Signal> message;
    to_message(signal, kForgerySession, message);
    Bytes bytes = test::encoded(message);
    if (key != nullptr) key->seal(guard_.channel(), bytes.data(), bytes.size());
    return bytes;
  }

 private:
  /// As the simulation does: one that has the stamp of a former one is the same again.
  bool is_new(std::int64_t seq) {
    return guard_.channel() != channels::kSimControl || controls_.insert(seq).second;
  }
  std::set<std::int64_t> controls_;
  ReceiveGuard guard_;
  Signal prototype_;
  Slot<Signal> slot_;
  MessageOf<Signal> message_{};
  Signal signal_{};
};

std::vector<std::unique_ptr<Ear>> ears(bool lockstep) {
  std::vector<std::unique_ptr<Ear>> all;
  const auto add = [&](const char* channel, const CountLimits& limits, const auto& signal) {
    all.push_back(
        std::make_unique<EarFor<std::decay_t<decltype(signal)>>>(channel, limits, signal, lockstep));
  };
  add(channels::kDriveState, CountLimits::exactly(12), DriveState(12));
  add(channels::kDriveCommand, CountLimits::exactly(12), DriveCommand(12));
  add(channels::kJointState, CountLimits::exactly(12, 4), JointState(12, 4));
  add(channels::kLegCommand, CountLimits::exactly(4), LegCommand(4));
  add(channels::kImu, CountLimits::none(), Imu());
  add(channels::kOperatorCommand, CountLimits::none(), OperatorCommand());
  add(channels::kSimControl, CountLimits::none(), SimControl());
  return all;
}

bool is_event(const Ear& ear) {
  return ear.guard().channel() == channels::kOperatorCommand ||
         ear.guard().channel() == channels::kSimControl;
}

std::int64_t time_of(std::int64_t seq) { return seq * kForgeryCycle_us + 100; }

class Forgery : public testing::TestWithParam<bool> {
 protected:
  bool lockstep() const { return GetParam(); }
  const std::vector<std::unique_ptr<Ear>> ears_ = ears(GetParam());
  const std::shared_ptr<const MessageKey> key_ = key_of(1);
  const std::shared_ptr<const MessageKey> other_key_ = key_of(2);
};

TEST_P(Forgery, TrueMessagesAreObeyed) {
  for (const auto& ear : ears_) {
    for (std::int64_t seq = kFirst; seq < kFirst + 20; ++seq) {
      ASSERT_EQ(ear->hears(ear->said(seq, key_.get()), time_of(seq)), Refusal::kNone)
          << ear->guard().last_refusal();
      ASSERT_EQ(ear->newest(), seq);
    }
    EXPECT_EQ(ear->guard().refused(), 0);
  }
}

/// Hazard: the forgery for k+3 was there before the controller's own, and the first one stayed.
TEST_P(Forgery, ForgeryPushesNoTrueMessageOut) {
  for (const auto& ear : ears_) {
    (void)ear->hears(ear->said(kFirst, key_.get()), time_of(kFirst));
    for (const MessageKey* key : {static_cast<const MessageKey*>(nullptr), other_key_.get()})
      EXPECT_EQ(ear->hears(ear->said(kFirst + 3, key), time_of(kFirst)), Refusal::kForged);
    EXPECT_EQ(ear->newest(), kFirst);
    for (std::int64_t seq = kFirst + 1; seq <= kFirst + 3; ++seq)
      EXPECT_EQ(ear->hears(ear->said(seq, key_.get()), time_of(seq)), Refusal::kNone)
          << ear->guard().channel();
    EXPECT_EQ(ear->newest(), kFirst + 3);
    EXPECT_NE(ear->guard().last_refusal().find("refused: forged"), std::string::npos);
  }
}

TEST_P(Forgery, MessageOfOneChannelIsForgedOnAnother) {
  EarFor<JointState> other("JOINT_STATE_2", CountLimits::exactly(12, 4), JointState(12, 4), lockstep());
  EXPECT_EQ(other.hears(ears_[2]->said(kFirst, key_.get()), time_of(kFirst)), Refusal::kForged);
}

/// An old message of the same run, by which a slot would take the sender for restarted and forget what it
/// has.
TEST_P(Forgery, ReplayOfAnOldMessageIsRefused) {
  for (const auto& ear : ears_) {
    std::vector<Bytes> heard;
    for (std::int64_t seq = kFirst; seq < kFirst + 100; ++seq) {
      heard.push_back(ear->said(seq, key_.get()));
      (void)ear->hears(heard.back(), time_of(seq));
    }
    for (std::size_t i = 0; i < 80; ++i) {
      const Refusal refusal = ear->hears(heard[i], time_of(kFirst + 99));
      const bool known_by_stamp = ear->guard().channel() == channels::kSimControl;  // by the simulation
      EXPECT_EQ(refusal, known_by_stamp ? Refusal::kNone : Refusal::kReplayed) << ear->guard().channel();
    }
    if (is_event(*ear)) continue;
    EXPECT_EQ(ear->newest(), kFirst + 99) << ear->guard().channel();
  }
}

TEST_P(Forgery, LateAndFutureMessagesAreRefusedByTheClock) {
  for (const auto& ear : ears_) {
    if (lockstep() && !is_event(*ear)) continue;  // time is not the clock's
    const Bytes bytes = ear->said(kFirst, key_.get());
    EXPECT_EQ(ear->hears(bytes, time_of(kFirst) + kOldest_us), Refusal::kLate) << ear->guard().channel();
    EXPECT_EQ(ear->hears(bytes, time_of(kFirst) - 2 * kMostAhead_us), Refusal::kFuture);
    EXPECT_EQ(ear->newest(), -1);
    EXPECT_EQ(ear->hears(bytes, time_of(kFirst)), Refusal::kNone) << "what was refused does not spoil it";
  }
}

/// What hostile people do: copies, copies with other times and cycles, other keys, bits, lengths.
class Attacker {
 public:
  Attacker(const Ear& ear, std::shared_ptr<const MessageKey> key, unsigned seed)
      : ear_(ear), key_(std::move(key)), random_(seed) {}

  void overhears(const Bytes& bytes) {
    if (heard_.size() < 512)
      heard_.push_back(bytes);
    else
      heard_[random_() % 512] = bytes;
  }
  Bytes next(std::int64_t seq) {
    Bytes bytes = heard_[random_() % heard_.size()];
    switch (random_() % 6) {
      case 0:
        return bytes;
      case 1:
        put_int64(bytes, kSeqOffset, seq + static_cast<std::int64_t>(random_() % 20));
        break;
      case 2:
        put_int64(bytes, kUtimeOffset, static_cast<std::int64_t>(random_()));
        break;
      case 3:
        bytes[random_() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
        break;
      case 4:
        bytes.resize(random_() % (2 * bytes.size()));
        break;
      default:
        put_int64(bytes, kSeqOffset, seq + 3);
        put_int64(bytes, kUtimeOffset, (seq + 3) * kForgeryCycle_us);
        key_->seal(ear_.guard().channel(), bytes.data(), bytes.size());
    }
    return bytes;
  }

 private:
  const Ear& ear_;
  std::shared_ptr<const MessageKey> key_;
  std::mt19937 random_;
  std::vector<Bytes> heard_;
};

/// A million of them among ten thousand true ones: all true ones are obeyed, at once, and none of the others.
TEST_P(Forgery, MillionHostileMessagesAreNotObeyed) {
  constexpr std::int64_t kTrueOnes = 1'500;
  constexpr int kBetween = 96;
  std::map<std::string, std::int64_t> refused;
  std::int64_t hostile = 0, memory_kB = 0;
  for (const auto& ear : ears_) {
    Attacker attacker(*ear, other_key_, 3);
    std::int64_t repeats = 0;
    for (std::int64_t seq = kFirst; seq < kFirst + kTrueOnes; ++seq) {
      const Bytes own = ear->said(seq, key_.get());
      ASSERT_EQ(ear->hears(own, time_of(seq)), Refusal::kNone) << ear->guard().last_refusal();
      ASSERT_EQ(ear->newest(), seq);
      attacker.overhears(own);
      for (int n = 0; n < kBetween; ++n, ++hostile) {
        const Refusal refusal = ear->hears(attacker.next(seq), time_of(seq));
        ASSERT_EQ(ear->newest(), seq) << ear->guard().channel() << ": " << name(refusal);
        repeats += refusal == Refusal::kNone ? 1 : 0;
      }
      if (memory_kB == 0 && seq == kFirst + 600) memory_kB = resident_kB();
    }
    const bool takes_repeats = ear->guard().channel() == channels::kSimControl ||
                               (lockstep() && !is_event(*ear));
    EXPECT_TRUE(takes_repeats || repeats == 0) << ear->guard().channel();
    for (const auto& row : kWords<Refusal>) refused[row.name] += ear->guard().refused(row.value);
  }
  EXPECT_GE(hostile, 1'000'000);
  for (const char* why : {"forged", "replayed", "wrong length"}) EXPECT_GT(refused[why], 10'000) << why;
#ifndef __SANITIZE_ADDRESS__  // which keeps what was given back, to see who uses it
  EXPECT_LT(resident_kB(), memory_kB + 1'000);
#endif
}

INSTANTIATE_TEST_SUITE_P(OnBothClocks, Forgery, testing::Bool(),
                         [](const auto& clock) { return clock.param ? "Lockstep" : "RealTime"; });

}  // namespace
}  // namespace sprung

/// Every channel's way from bytes to a signal: the receive guard, LCM's decoder, from_message, and back.
#include <memory>

#include "runtime/process_status.h"
#include "runtime/receive_guard.h"
#include "signals/auxiliary_state.h"
#include "signals/body_state.h"
#include "signals/bus_state.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/messages.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::runtime_receive_guard {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class M>
Bytes encoded(const M& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  require(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())) == static_cast<int>(bytes.size()),
          "encodes");
  return bytes;
}

/// What a signal holds is what its message holds: there and back again gives the same bytes.
template <class Signal, class M>
void require_round_trip(const M& message) {
  Signal signal, again;
  if (!from_message(message, signal)) return;
  M first{}, second{};
  to_message(signal, message.session, first);
  require(from_message(first, again).good, "its own message is read");
  to_message(again, message.session, second);
  require(encoded(first) == encoded(second), "a signal comes back");
}

struct NoSignal {};  ///< CAN_TRACE: read as a message

template <class Signal, class M>
void look_at(const std::uint8_t* bytes, std::size_t size, const CountLimits& limits) {
  static const MessageLayout layout = layout_of<M>();
  ReceiveGuard guard("CHANNEL", layout, limits, 0);
  M message{};
  if (guard.decode(bytes, size, message) != Refusal::kNone) {
    require(!guard.last_refusal().empty(), "a refusal is named");
    return;
  }
  if constexpr (!std::is_same_v<Signal, NoSignal>) require_round_trip<Signal>(message);
  encoded(message);
}

template <class M>
void write_hash(std::uint8_t* bytes) {
  const auto hash = static_cast<std::uint64_t>(M::getHash());
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
}

struct Channel {
  void (*look)(const std::uint8_t*, std::size_t, const CountLimits&);
  void (*write_hash)(std::uint8_t*);
  std::string (*seed)(int count);
};

/// A message with `count` of everything that it has several of.
template <class M>
M with_counts(int count) {
  M message{};
  Bytes bytes = encoded(message);
  const MessageLayout layout = layout_of<M>();
  for (int i = 0; i < layout.counts; ++i) {
    bytes[kCountsOffset + 4 * static_cast<std::size_t>(i) + 3] = static_cast<std::uint8_t>(count);
    bytes.resize(bytes.size() +
                 static_cast<std::size_t>(count) * layout.element_size[static_cast<std::size_t>(i)]);
  }
  // Strings, at the end, are zeros now: their lengths are put right by hand.
  if (layout.strings > 0 && layout.counts > 0) return message;
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return message;
}

template <class Signal, class M>
Channel channel() {
  return {look_at<Signal, M>, write_hash<M>, [](int count) {
            const Bytes bytes = encoded(with_counts<M>(count));
            return std::string(bytes.begin(), bytes.end());
          }};
}

template <class Signal>
Channel of_signal() {
  return channel<Signal, MessageOf<Signal>>();
}

const std::vector<Channel>& channels() {
  static const std::vector<Channel> all = {of_signal<DriveState>(),
                                           of_signal<DriveCommand>(),
                                           of_signal<JointState>(),
                                           of_signal<LegCommand>(),
                                           of_signal<MotionState>(),
                                           of_signal<SafetyState>(),
                                           of_signal<BusState>(),
                                           of_signal<OperatorCommand>(),
                                           of_signal<OperatorReply>(),
                                           of_signal<SimControl>(),
                                           of_signal<SimTruth>(),
                                           of_signal<Imu>(),
                                           of_signal<TorqueSensor>(),
                                           of_signal<ProcessStatus>(),
                                           of_signal<AuxiliaryState>(),
                                           of_signal<BodyState>(),
                                           channel<NoSignal, sprung_msgs::can_trace_t>()};
  return all;
}

std::vector<std::string> guard_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < channels().size(); ++i) {
    for (const int count : {0, 2}) {
      Output seed;
      seed.byte(static_cast<int>(i)).byte(0).byte(count).text(channels()[i].seed(count));
      seeds.push_back(seed.bytes());
    }
  }
  return seeds;
}

}  // namespace

/// Which channel, whether the hash stays as it came, the robot's count, and the message.
SPRUNG_FUZZ(runtime_receive_guard, guard_seeds) {
  const Channel& channel = channels()[input.byte() % channels().size()];
  const bool own_hash = input.byte() % 16 != 1;
  const std::size_t count = input.byte() % 16U;
  const std::string_view rest = input.rest();
  // An exact copy, so that one byte beyond it is seen.
  const std::unique_ptr<std::uint8_t[]> copy(new std::uint8_t[rest.size()]);
  std::copy(rest.begin(), rest.end(), copy.get());
  if (own_hash && rest.size() >= 8) channel.write_hash(copy.get());
  channel.look(copy.get(), rest.size(), CountLimits::up_to(count, count));
}

}  // namespace sprung::fuzz::runtime_receive_guard

#pragma once
/// A process's place on the LCM network. LCM publishes (the node's own thread only); a receiver of our own
/// (runtime/transport) takes what comes in a thread that always drains, through a receive guard, into slots
/// and queues.
///
///   Node node(options);
///   Slot<DriveState> drive_states{DriveState(n)};
///   node.subscribe(channels::kDriveState, CountLimits::exactly(n), drive_states);
///   auto joint_states = node.publisher<JointState>(channels::kJointState);
///   node.start();
///   while (!stop_requested()) {
///     node.wait_for_input(node.utime_us() + 50'000);
///     ...; joint_states.publish(out); process.publish_status_if_due();
///   }
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/input_event.h"
#include "runtime/input_queue.h"
#include "runtime/message_key.h"
#include "runtime/message_layout.h"
#include "runtime/receive_guard.h"
#include "runtime/session_clock.h"
#include "runtime/slot.h"
#include "runtime/transport/lcm_receiver.h"
#include "signals/messages.h"

namespace sprung {

inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

struct NodeOptions {
  std::string lcm_url = kDefaultLcmUrl;
  std::int64_t session = 0;         ///< sent with every message; only this one is accepted, 0 = any (tools)
  std::int64_t epoch_us = 0;        ///< see SessionClock
  std::vector<std::string> inject;  ///< see FaultInjection
  /// Seals what is sent, and is demanded of what comes, on channels that carry a MAC. None: such messages go
  /// out with a MAC of zeros, and every one is believed: for who only looks, and for tests.
  std::shared_ptr<const MessageKey> key = nullptr;
  bool lockstep = false;  ///< times of cycles are not the clock's (freshness.h)
  /// Rest of the receiving thread after each look, in which messages wait with the kernel: who shows a robot
  /// need not be woken thousands of times a second. 0: none, for whatever moves one.
  int gather_ms = 0;
};

class Node;

/// Sends one kind of signal. Holds its message and buffer, so a cycle allocates nothing beyond LCM itself.
template <class Signal>
class Publisher {
 public:
  void publish(const Signal& signal);

 private:
  friend class Node;
  Publisher(Node* node, const char* channel) : node_(node), channel_(channel) {}
  Node* node_;
  std::string channel_;
  MessageOf<Signal> message_{};
};

class Node {
 public:
  /// @throws std::runtime_error when LCM cannot start, saying what to do; std::invalid_argument on a bad
  /// address or injection.
  explicit Node(const NodeOptions& options);
  ~Node();  ///< stops and joins the receiving thread
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Subscriptions come before start(). Slots and queues must outlive receiving: see Receiving below.
  /// Signal is one of the structs of signals/ whose message has no texts.
  template <class Signal>
  void subscribe(const char* channel, const CountLimits& limits, Slot<Signal>& slot) {
    slot.wake(&event_);
    on_signal<Signal>(channel, limits, [&slot](const Signal& signal) { slot.push(signal); });
  }
  template <class Signal>
  void subscribe(const char* channel, const CountLimits& limits, InputQueue<Signal>& queue) {
    queue.wake(&event_);
    on_signal<Signal>(channel, limits, [&queue](const Signal& signal) { queue.push(signal); });
  }
  /// M is a message type: for messages with texts (SAFETY_STATE, MOTION_STATE, OPERATOR_REPLY,
  /// PROCESS_STATUS) and tools.
  template <class M>
  void subscribe_message(const char* channel, const CountLimits& limits, InputQueue<M>& queue) {
    queue.wake(&event_);
    on_message<M>(channel, limits, [&queue](const M& message) { queue.push(message); });
  }
  /// Checked and decoded; `handle` runs in the receiving thread and must be short.
  template <class M>
  void on_message(const char* channel, const CountLimits& limits, std::function<void(const M&)> handle);
  template <class Signal>
  void on_signal(const char* channel, const CountLimits& limits, std::function<void(const Signal&)> handle);

  /// The bytes of messages of type M, checked, so that decoding them is safe: for who decodes few of many.
  /// `handle` runs in the receiving thread and must be short.
  /// @param rest_us after one that was good, those of the next rest_us are passed over unseen: checking a MAC
  /// is a third of what hearing costs.
  template <class M>
  void on_bytes(const char* channel, const CountLimits& limits, std::int64_t rest_us,
                std::function<void(const std::uint8_t* data, std::size_t size)> handle) {
    add(channel, layout_of<M>(), limits,
        [rest_us, until_us = std::numeric_limits<std::int64_t>::min(), handle = std::move(handle)](
            ReceiveGuard& guard, const Arrival& in) mutable {
          if (in.utime_us < until_us) return;
          if (guard.check(in.data, in.size, in.utime_us) != Refusal::kNone) return;
          handle(static_cast<const std::uint8_t*>(in.data), in.size);
          until_us = in.utime_us + rest_us;
        });
  }

  void start();  ///< receiving begins
  void stop();   ///< receiving ends; the destructor does it too

  template <class Signal>
  Publisher<Signal> publisher(const char* channel) {
    return Publisher<Signal>(this, channel);
  }
  /// A message that the caller has filled; `session` is set here.
  template <class M>
  void publish_message(const char* channel, M& message);

  /// Sleeps until something came in, a stop was requested, or utime_us() reaches the deadline.
  /// @return true when something came in or a stop was requested.
  bool wait_for_input(std::int64_t deadline_utime_us);
  int event_fd() const noexcept {
    return event_.fd();
  }  ///< readable when something came in; then call clear_event()
  void clear_event() noexcept { event_.clear(); }  ///< before looking at the inputs

  std::int64_t utime_us() const noexcept { return clock_.utime_us(); }
  const SessionClock& clock() const noexcept { return clock_; }
  std::int64_t session() const noexcept { return session_; }

  std::int64_t refused_messages() const;  ///< by all receive guards, and datagrams before them
  std::string last_refusal() const;       ///< of the guard that refused last; empty when none did
  ReceiverCounts datagrams() const noexcept;

 private:
  /// Bytes that came, and when.
  struct Arrival {
    const void* data;
    std::size_t size;
    std::int64_t utime_us;
  };
  using Handler = std::function<void(ReceiveGuard&, const Arrival&)>;
  struct Impl;
  void add(const char* channel, const MessageLayout& layout, const CountLimits& limits, Handler handler);
  void seal(const char* channel);                    ///< buffer_
  void send(const char* channel, std::int64_t seq);  ///< buffer_

  SessionClock clock_;
  std::int64_t session_;
  InputEvent event_;
  std::vector<std::uint8_t> buffer_;
  std::unique_ptr<Impl> impl_;
};

/// Receives as long as it lives. Declare it after the slots and queues, so that receiving ends before they
/// do.
class Receiving {
 public:
  explicit Receiving(Node& node) : node_(node) { node_.start(); }
  ~Receiving() { node_.stop(); }
  Receiving(const Receiving&) = delete;
  Receiving& operator=(const Receiving&) = delete;

 private:
  Node& node_;
};

template <class Signal>
void Publisher<Signal>::publish(const Signal& signal) {
  to_message(signal, node_->session(), message_);
  node_->publish_message(channel_.c_str(), message_);
}

template <class M>
void Node::publish_message(const char* channel, M& message) {
  message.session = session_;
  const int size = message.getEncodedSize();
  buffer_.resize(static_cast<std::size_t>(size));
  message.encode(buffer_.data(), 0, size);
  if (kHasMac<M>) seal(channel);
  send(channel, message.seq);
}

template <class M>
void Node::on_message(const char* channel, const CountLimits& limits, std::function<void(const M&)> handle) {
  add(channel, layout_of<M>(), limits,
      [message = M(), handle = std::move(handle)](ReceiveGuard& guard, const Arrival& in) mutable {
        if (guard.decode(in.data, in.size, message, in.utime_us) == Refusal::kNone) handle(message);
      });
}

template <class Signal>
void Node::on_signal(const char* channel, const CountLimits& limits,
                     std::function<void(const Signal&)> handle) {
  using M = MessageOf<Signal>;
  add(channel, layout_of<M>(), limits,
      [message = M(), signal = Signal(), handle = std::move(handle)](ReceiveGuard& guard,
                                                                     const Arrival& in) mutable {
        if (guard.decode(in.data, in.size, message, in.utime_us) != Refusal::kNone) return;
        const Reading reading = from_message(message, signal);
        if (reading.good) return handle(signal);
        guard.refuse(Refusal::kBadValue, reading.found, reading.largest);
      });
}

}  // namespace sprung

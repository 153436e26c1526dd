#include "runtime/node.h"

#include <lcm/lcm.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <stdexcept>
#include <thread>

#include "runtime/fault_injection.h"
#include "runtime/stop_request.h"
#include "runtime/transport/lcm_address.h"

namespace sprung {
namespace {

struct LcmDeleter {
  void operator()(lcm_t* lcm) const noexcept { lcm_destroy(lcm); }
};
using LcmPointer = std::unique_ptr<lcm_t, LcmDeleter>;

LcmPointer open_lcm(const std::string& url) {
  LcmPointer lcm(lcm_create(LcmAddress::of(url).url().c_str()));
  if (lcm != nullptr) return lcm;
  throw std::runtime_error("LCM could not start on '" + url +
                           "': check the address; without a multicast route run (as root) 'ip link set lo "
                           "multicast on; ip route add 239.0.0.0/8 dev lo'");
}

/// What the receiving thread has counted, for the others.
struct SharedCounts {
  std::atomic<std::int64_t> strangers{0}, malformed{0}, fragments{0}, lost{0};
  void set(const ReceiverCounts& now) noexcept {
    strangers = now.strangers;
    malformed = now.malformed;
    fragments = now.fragments;
    lost = now.lost;
  }
};

}  // namespace

struct Node::Impl {
  struct Subscription {
    Subscription(std::string channel, const MessageLayout& layout, const CountLimits& limits,
                 std::int64_t session, Handler handle)
        : guard(std::move(channel), layout, limits, session), handler(std::move(handle)) {}
    ReceiveGuard guard;
    Handler handler;
  };

  explicit Impl(const NodeOptions& options)
      : url(options.lcm_url),
        key(options.key),
        lockstep(options.lockstep),
        gather_ms(options.gather_ms),
        clock(options.epoch_us),
        faults(options.inject),
        sending(open_lcm(options.lcm_url)) {}

  void dispatch(const ReceivedMessage& message) noexcept {
    for (const auto& subscription : subscriptions) {
      if (subscription->guard.channel() == message.channel)
        receive(*subscription, message.data, message.size);
    }
  }

  void receive(Subscription& subscription, const void* data, std::size_t size) noexcept {
    ReceiveGuard& guard = subscription.guard;
    if (size >= kCountsOffset) {
      const std::int64_t seq = read_int64(static_cast<const std::uint8_t*>(data), kSeqOffset);
      if (faults.on_receive(guard.channel(), seq) == LinkFault::kDropReceived) return;
    }
    const std::int64_t before = guard.refused();
    try {
      subscription.handler(guard, {data, size, clock.utime_us()});
    } catch (...) {
      guard.refuse(Refusal::kNotDecodable, 0, 0);  // out of memory: the next one may find some
    }
    if (guard.refused() != before) last_refuser = &guard;
  }

  void drain() noexcept {
    std::array<pollfd, 2> waits{pollfd{receiver->fd(), POLLIN, 0}, pollfd{stopping.fd(), POLLIN, 0}};
    while ((waits[1].revents & POLLIN) == 0) {
      if (poll(waits.data(), waits.size(), -1) <= 0 || waits[0].revents == 0) continue;
      const auto hand_on = [this](const ReceivedMessage& message) { dispatch(message); };
      const bool more = receiver->receive(hand_on);
      counts.set(receiver->counts());
      if (gather_ms > 0 && !more) poll(&waits[1], 1, gather_ms);
    }
  }

  std::string url;
  std::shared_ptr<const MessageKey> key;
  bool lockstep;
  int gather_ms;
  SessionClock clock;
  FaultInjection faults;
  LcmPointer sending;
  std::unique_ptr<LcmReceiver> receiver;  ///< of those who subscribe
  SharedCounts counts;
  std::vector<std::unique_ptr<Subscription>> subscriptions;
  std::atomic<const ReceiveGuard*> last_refuser{nullptr};
  InputEvent stopping;
  std::thread thread;
};

Node::Node(const NodeOptions& options)
    : clock_(options.epoch_us), session_(options.session), impl_(std::make_unique<Impl>(options)) {}

Node::~Node() { stop(); }

void Node::add(const char* channel, const MessageLayout& layout, const CountLimits& limits, Handler handler) {
  if (impl_->thread.joinable()) throw std::logic_error("Node: subscribe before start()");
  if (impl_->receiver == nullptr)
    impl_->receiver = std::make_unique<LcmReceiver>(impl_->url, Fragments::kRefused);
  impl_->subscriptions.push_back(
      std::make_unique<Impl::Subscription>(channel, layout, limits, session_, std::move(handler)));
  impl_->subscriptions.back()->guard.demand(impl_->key, impl_->lockstep);
}

void Node::start() {
  if (impl_->thread.joinable() || impl_->subscriptions.empty()) return;
  impl_->thread = std::thread([impl = impl_.get()] { impl->drain(); });
}

void Node::stop() {
  impl_->stopping.signal();
  if (impl_->thread.joinable()) impl_->thread.join();
  impl_->stopping.clear();
}

void Node::seal(const char* channel) {
  if (impl_->key != nullptr) impl_->key->seal(channel, buffer_.data(), buffer_.size());
}

void Node::send(const char* channel, std::int64_t seq) {
  const LinkFault fault = impl_->faults.on_publish(channel, seq);
  if (fault == LinkFault::kDropSent) return;
  for (int copies = fault == LinkFault::kRepeatSent ? 2 : 1; copies > 0; --copies) {
    lcm_publish(impl_->sending.get(), channel, buffer_.data(), static_cast<unsigned int>(buffer_.size()));
  }
}

bool Node::wait_for_input(std::int64_t deadline_utime_us) {
  const std::int64_t left_us = std::max<std::int64_t>(0, deadline_utime_us - utime_us());
  const timespec timeout{left_us / 1'000'000, (left_us % 1'000'000) * 1'000};
  std::array<pollfd, 2> waits{pollfd{event_.fd(), POLLIN, 0},
                              pollfd{stop_fd(), POLLIN, 0}};  // poll ignores fd -1
  const int ready = ppoll(waits.data(), waits.size(), &timeout, nullptr);
  if (ready > 0) event_.clear();
  return ready > 0;
}

ReceiverCounts Node::datagrams() const noexcept {
  const SharedCounts& counts = impl_->counts;
  return {counts.strangers, counts.malformed, counts.fragments, counts.lost};
}

std::int64_t Node::refused_messages() const {
  const ReceiverCounts datagrams = this->datagrams();
  std::int64_t sum = datagrams.strangers + datagrams.malformed + datagrams.fragments;
  for (const auto& subscription : impl_->subscriptions) sum += subscription->guard.refused();
  return sum;
}

std::string Node::last_refusal() const {
  const ReceiveGuard* const guard = impl_->last_refuser.load();
  if (guard != nullptr) return guard->last_refusal();
  const ReceiverCounts datagrams = this->datagrams();
  if (datagrams.strangers + datagrams.malformed + datagrams.fragments == 0) return "";
  return "datagrams refused: " + std::to_string(datagrams.strangers) + " of strangers, " +
         std::to_string(datagrams.malformed) + " malformed, " + std::to_string(datagrams.fragments) +
         " fragments";
}

}  // namespace sprung

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

namespace sprung {
namespace {

/// The receiving thread empties LCM's own queue at once; this only bridges a moment in which it is not
/// scheduled.
constexpr int kLcmQueue = 4096;

struct LcmDeleter {
  void operator()(lcm_t* lcm) const noexcept { lcm_destroy(lcm); }
};
using LcmPointer = std::unique_ptr<lcm_t, LcmDeleter>;

LcmPointer open_lcm(const std::string& url) {
  LcmPointer lcm(lcm_create(url.c_str()));
  if (lcm != nullptr) return lcm;
  throw std::runtime_error("LCM could not start on '" + url +
                           "': check the address; without a multicast route run (as root) 'ip link set lo "
                           "multicast on; ip route add 239.0.0.0/8 dev lo'");
}

}  // namespace

struct Node::Impl {
  struct Subscription {
    Subscription(Impl* node, std::string channel, const MessageLayout& layout, const CountLimits& limits,
                 std::int64_t session, Handler handle)
        : impl(node), guard(std::move(channel), layout, limits, session), handler(std::move(handle)) {}
    Impl* impl;
    ReceiveGuard guard;
    Handler handler;
  };

  explicit Impl(const NodeOptions& options)
      : faults(options.inject), sending(open_lcm(options.lcm_url)), receiving(open_lcm(options.lcm_url)) {}

  static void on_bytes(const lcm_recv_buf_t* bytes, const char* /*channel*/, void* user) noexcept {
    auto& subscription = *static_cast<Subscription*>(user);
    subscription.impl->receive(subscription, bytes->data, bytes->data_size);
  }

  void receive(Subscription& subscription, const void* data, std::size_t size) noexcept {
    ReceiveGuard& guard = subscription.guard;
    if (size >= kCountsOffset) {
      const std::int64_t seq = read_int64(static_cast<const std::uint8_t*>(data), kSeqOffset);
      if (faults.on_receive(guard.channel(), seq) == LinkFault::kDropReceived) return;
    }
    const std::int64_t before = guard.refused();
    try {
      subscription.handler(guard, data, size);
    } catch (...) {
      guard.refuse(Refusal::kNotDecodable, 0,
                   0);  // out of memory: nothing may be thrown through LCM's C code
    }
    if (guard.refused() != before) last_refuser = &guard;
  }

  void drain() {
    std::array<pollfd, 2> waits{pollfd{lcm_get_fileno(receiving.get()), POLLIN, 0},
                                pollfd{stopping.fd(), POLLIN, 0}};
    while ((waits[1].revents & POLLIN) == 0) {
      if (poll(waits.data(), waits.size(), -1) > 0 && (waits[0].revents & POLLIN) != 0)
        lcm_handle(receiving.get());
    }
  }

  FaultInjection faults;
  LcmPointer sending;
  LcmPointer receiving;
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
  auto subscription = std::make_unique<Impl::Subscription>(impl_.get(), channel, layout, limits, session_,
                                                           std::move(handler));
  lcm_subscription_t* const made = lcm_subscribe(impl_->receiving.get(), channel, &Impl::on_bytes,
                                                 subscription.get());
  if (made == nullptr)
    throw std::runtime_error(std::string("LCM cannot receive ") + channel + ": run 'sprung doctor'");
  lcm_subscription_set_queue_capacity(made, kLcmQueue);
  impl_->subscriptions.push_back(std::move(subscription));
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

void Node::send(const char* channel, std::int64_t seq) {
  const LinkFault fault = impl_->faults.on_publish(channel, seq);
  if (fault == LinkFault::kDropSent) return;
  for (int copies = fault == LinkFault::kRepeatSent ? 2 : 1; copies > 0; --copies) {
    const int sent = lcm_publish(impl_->sending.get(), channel, buffer_.data(),
                                 static_cast<unsigned int>(buffer_.size()));
    if (sent != 0) ++send_failures_;
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

std::int64_t Node::refused_messages() const {
  std::int64_t sum = 0;
  for (const auto& subscription : impl_->subscriptions) sum += subscription->guard.refused();
  return sum;
}

std::string Node::last_refusal() const {
  const ReceiveGuard* const guard = impl_->last_refuser.load();
  return guard == nullptr ? "" : guard->last_refusal();
}

}  // namespace sprung

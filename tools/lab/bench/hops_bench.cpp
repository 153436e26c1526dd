#include "tools/lab/bench/hops_bench.h"

#include <lcm/lcm.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "runtime/own_port.h"
#include "runtime/transport/lcm_receiver.h"
#include "tools/lab/bench/stopwatch.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {
namespace {

using Clock = std::chrono::steady_clock;
using Lcm = std::unique_ptr<lcm_t, void (*)(lcm_t*)>;
using HopMessage = std::array<std::uint8_t, 300>;

constexpr int kHops = 4;
constexpr int kPoll_ms = 20;
constexpr std::int64_t kLost_ns = 200'000'000;  // a message that took longer is given up

struct Content {
  std::int64_t sent_ns = 0;
  int number = 0;
};

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

Lcm open_hop(const std::string& url) {
  Lcm lcm(lcm_create(url.c_str()), lcm_destroy);
  if (!lcm) throw std::runtime_error("LCM could not start on " + url + ": run 'sprung doctor'");
  return lcm;
}
std::string hop_channel(int hop) { return "HOP_" + std::to_string(hop); }

/// Calls `take` with each message of one channel until `ended`.
using Receive = std::function<void(const std::string& url, const std::string& channel,
                                   const std::atomic<bool>& ended, std::atomic<int>& ready,
                                   const std::function<void(const void*, std::size_t)>& take)>;

void receive_by_ours(const std::string& url, const std::string& wanted, const std::atomic<bool>& ended,
                     std::atomic<int>& ready, const std::function<void(const void*, std::size_t)>& take) {
  LcmReceiver receiver(url, Fragments::kRefused);
  ++ready;
  pollfd wait{receiver.fd(), POLLIN, 0};
  while (!ended) {
    if (poll(&wait, 1, kPoll_ms) > 0)
      receiver.receive([&](const ReceivedMessage& message) {
        if (message.channel == wanted) take(message.data, message.size);
      });
  }
}

void receive_by_lcm(const std::string& url, const std::string& wanted, const std::atomic<bool>& ended,
                    std::atomic<int>& ready, const std::function<void(const void*, std::size_t)>& take) {
  const Lcm lcm = open_hop(url);
  const auto handle = [](const lcm_recv_buf_t* buffer, const char*, void* user) {
    (*static_cast<const std::function<void(const void*, std::size_t)>*>(user))(buffer->data,
                                                                               buffer->data_size);
  };
  lcm_subscribe(lcm.get(), wanted.c_str(), handle,
                const_cast<std::function<void(const void*, std::size_t)>*>(&take));
  ++ready;
  while (!ended) lcm_handle_timeout(lcm.get(), kPoll_ms);
}

struct Delays {
  double p50_us = 0.0;
  double p99_us = 0.0;
};

/// Relays, the one who waits at the end, and the one who sends.
class Chain {
 public:
  Chain(const Receive& receive, const std::string& url) {
    for (int hop = 0; hop + 1 < kHops; ++hop) start(receive, url, hop, relay(url, hop + 1));
    start(receive, url, kHops - 1, [this](const void* data, std::size_t) {
      Content content;
      std::memcpy(&content, data, sizeof content);
      arrived_us_ = 1e-3 * static_cast<double>(now_ns() - content.sent_ns);
      arrived_ = content.number;
    });
    while (ready_ < kHops) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ~Chain() {
    ended_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  Delays run(const HopsBench& bench, const std::string& url) {
    const Lcm lcm = open_hop(url);
    std::vector<double> delays_us;
    auto due = Clock::now();
    for (int number = 1; number <= bench.messages; ++number) {
      due += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / bench.rate_Hz));
      std::this_thread::sleep_until(due);
      HopMessage bytes{};
      const Content content{now_ns(), number};
      std::memcpy(bytes.data(), &content, sizeof content);
      lcm_publish(lcm.get(), hop_channel(0).c_str(), bytes.data(), bytes.size());
      while (arrived_ != number && now_ns() - content.sent_ns < kLost_ns)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      if (arrived_ == number) delays_us.push_back(arrived_us_);
      due = std::max(due, Clock::now() - std::chrono::milliseconds(2));
    }
    if (delays_us.empty()) throw std::runtime_error("no message came through on " + url);
    std::sort(delays_us.begin(), delays_us.end());
    return {delays_us[delays_us.size() / 2], delays_us[delays_us.size() * 99 / 100]};
  }

 private:
  using Take = std::function<void(const void*, std::size_t)>;
  static Take relay(const std::string& url, int to) {
    const std::shared_ptr<lcm_t> lcm(open_hop(url).release(), lcm_destroy);
    return [lcm, name = hop_channel(to)](const void* data, std::size_t size) {
      lcm_publish(lcm.get(), name.c_str(), data, static_cast<unsigned>(size));
    };
  }
  void start(const Receive& receive, const std::string& url, int hop, Take take) {
    threads_.emplace_back([this, receive, url, name = hop_channel(hop), take = std::move(take)] {
      receive(url, name, ended_, ready_, take);
    });
  }

  std::atomic<bool> ended_{false};
  std::atomic<int> ready_{0};
  std::atomic<int> arrived_{0};
  std::atomic<double> arrived_us_{0.0};
  std::vector<std::thread> threads_;
};

Delays run_once(const HopsBench& bench, const Receive& receive) {
  const std::string url = lcm_url_on_port(own_port());
  return Chain(receive, url).run(bench, url);
}

}  // namespace

std::vector<ReportRow> bench_hops(const HopsBench& bench) {
  std::vector<double> ours_p50, ours_p99, lcm_p50, lcm_p99, ratio_p50, ratio_p99;
  for (int run = 0; run < bench.runs; ++run) {
    const Delays ours = run_once(bench, receive_by_ours);
    const Delays theirs = run_once(bench, receive_by_lcm);
    ours_p50.push_back(ours.p50_us);
    ours_p99.push_back(ours.p99_us);
    lcm_p50.push_back(theirs.p50_us);
    lcm_p99.push_back(theirs.p99_us);
    ratio_p50.push_back(ours.p50_us / theirs.p50_us);
    ratio_p99.push_back(ours.p99_us / theirs.p99_us);
  }
  return {row("hops.ours_p50", "us", median(ours_p50)),
          row("hops.ours_p99", "us", median(ours_p99)),
          row("hops.lcm_p50", "us", median(lcm_p50)),
          row("hops.lcm_p99", "us", median(lcm_p99)),
          row("hops.ratio_p50", "-", median(ratio_p50), between(0.0, 1.0)),
          row("hops.ratio_p99", "-", median(ratio_p99))};
}

}  // namespace sprung

#include "runtime/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace sprung {
namespace {

constexpr const char* kRefused = "refused";

/// What was granted, part by part; under kEnforce a refusal throws.
class Grant {
 public:
  explicit Grant(RealTimePolicy policy) : policy_(policy) {}
  void part(const std::string& what, int error, const char* remedy) {
    if (error != 0 && policy_ == RealTimePolicy::kEnforce) {
      throw std::runtime_error("real time: " + what + " refused (" + std::strerror(error) + "); " + remedy);
    }
    if (!text_.empty()) text_ += ", ";
    text_ += what;
    if (error != 0) text_ += std::string(" ") + kRefused + " (" + std::strerror(error) + ")";
  }
  const std::string& text() const { return text_; }

 private:
  RealTimePolicy policy_;
  std::string text_;
};

int use_fifo(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return sched_setscheduler(0, SCHED_FIFO, &parameters) == 0 ? 0 : errno;
}

int pin(int cpu) {
  if (cpu >= CPU_SETSIZE) return EINVAL;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  return pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

// So that the loop never takes a page fault for stack it has not used before.
void touch_stack() {
  std::array<volatile char, std::size_t{256} * 1024> stack;
  for (std::size_t i = 0; i < stack.size(); i += 4096) stack[i] = 0;
}

}  // namespace

std::string set_up_real_time(const RealTimeRequest& request) {
  if (request.policy == RealTimePolicy::kOff) return "off";
  Grant grant(request.policy);
  if (request.priority > 0) {
    grant.part("SCHED_FIFO " + std::to_string(request.priority), use_fifo(request.priority),
               "raise the limit rtprio, or use --rt-policy warn");
    grant.part("memory locked", mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno,
               "raise the limit memlock, or use --rt-policy warn");
    touch_stack();
  } else {
    grant.part("normal scheduling", 0, "");
  }
  if (request.cpu >= 0) {
    grant.part("cpu " + std::to_string(request.cpu), pin(request.cpu), "choose a CPU that this machine has");
  }
  return grant.text();
}

bool real_time_refused(const std::string& granted) { return granted.find(kRefused) != std::string::npos; }

}  // namespace sprung

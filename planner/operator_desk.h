#pragma once
/// Operators' commands that wait for their cycle, the answers that wait to be sent, and the memory of what
/// was answered, so that a repeated request_id is answered again and never executed again. Pure; fixed
/// storage.
#include <array>
#include <cstdint>
#include <limits>

#include "signals/operator.h"

namespace sprung {

/// Of a reply about a parameter: which, and its value from now on.
struct ParameterNews {
  std::int64_t parameter = 0;  ///< id; 0: none
  double value = kNaN;
};

class OperatorDesk {
 public:
  static constexpr int kMostWaiting = 16;
  /// Request ids; what is not greater than a forgotten one is refused.
  static constexpr int kRemembered = 256;
  static constexpr int kMostReplies = 64;

  /// @return false when the queue is full. Repeated ids are answered with their last answer, or wait for
  /// their first.
  bool submit(const OperatorCommand& command) noexcept;
  /// Oldest command whose cycle has come. @return false when there is none.
  bool take_due(std::int64_t seq, OperatorCommand& out) noexcept;
  /// Any command that waits, due or not. @return false when there is none.
  bool take_any(OperatorCommand& out) noexcept;
  void reply(std::int64_t request_id, OperatorOutcome outcome, const char* reason, const Stamp& now,
             const ParameterNews& news = {}) noexcept;
  bool next_reply(OperatorReply& out) noexcept;

 private:
  struct Answered {
    OperatorReply reply;
    bool answered = false;
    bool used = false;
  };
  Answered* find(std::int64_t request_id) noexcept;
  void remember(std::int64_t request_id) noexcept;
  void push(const OperatorReply& reply) noexcept;
  void take(int index, OperatorCommand& out) noexcept;

  std::array<OperatorCommand, kMostWaiting> waiting_{};
  int waiting_count_ = 0;
  std::array<Answered, kRemembered> memory_{};
  int next_memory_ = 0;
  /// Greatest id that is in memory no more.
  std::int64_t forgotten_ = std::numeric_limits<std::int64_t>::min();
  std::array<OperatorReply, kMostReplies> replies_{};
  int first_reply_ = 0;
  int reply_count_ = 0;
};

}  // namespace sprung

#pragma once
/// An operator's end of OPERATOR_COMMAND and OPERATOR_REPLY. Commands are sent again until they are answered
/// (the receivers do not execute one id twice), so a lost datagram costs a tenth of a second and nothing
/// else.
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "runtime/node.h"
#include "signals/operator.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

struct OperatorAnswer {
  OperatorOutcome outcome = OperatorOutcome::kFailed;
  std::int64_t took_effect_at_seq = -1;
  std::string from;
  std::string reason;
  std::int64_t parameter = 0;  ///< id of the one that was set or read; 0: none
  double parameter_value = kNaN;
};

class OperatorClient {
 public:
  explicit OperatorClient(const RunInfo& info);
  explicit OperatorClient(const NodeOptions& options);

  /// Sends with a new request id unless one is set. @return the first answer (accepted, refused or queued);
  /// nullopt when nobody answered in timeout_s of wall time.
  std::optional<OperatorAnswer> send(OperatorCommand& command, double timeout_s);
  /// Waits for `done` or `failed` (or a refusal) of a command that was sent; asks again twice a second, in
  /// case the answer was lost. nullopt on a stop request, or when timeout_s passed without any answer.
  std::optional<OperatorAnswer> wait_done(const OperatorCommand& command, double timeout_s);

  /// From now on whatever waits here says this every each_s too, with a new id each time, whether or not the
  /// last was answered: over a network that delays, an answer is there only when the robot ought to have
  /// heard the next one already.
  void renew(const OperatorCommand& renewal, double each_s);
  void renew_no_more() noexcept { renewal_.reset(); }
  /// Goes on with that until one is refused, a signal comes, or nobody answered any of them for timeout_s.
  /// @return the last answer; nullopt: nobody answered.
  std::optional<OperatorAnswer> wait_refused(double timeout_s);

 private:
  void publish(OperatorCommand command);
  void say_renewal();
  void wait_until(std::int64_t time_us);
  std::optional<OperatorAnswer> next_renewal_answer();
  std::optional<OperatorAnswer> next_answer(std::int64_t request_id);
  InputQueue<sprung_msgs::operator_reply_t> replies_{256};
  std::int64_t next_ask_us_ = 0;
  std::optional<OperatorCommand> renewal_;
  std::int64_t renew_each_us_ = 0, next_renewal_us_ = 0;
  std::deque<std::int64_t> renewed_;  ///< their ids, the latest last
  Node node_;
  Publisher<OperatorCommand> commands_;
};

}  // namespace sprung

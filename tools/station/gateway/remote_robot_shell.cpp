#include "tools/station/gateway/remote_robot_shell.h"

#include <unistd.h>

#include <stdexcept>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "signals/messages.h"
#include "signals/mode_names.h"
#include "tools/station/gateway/gate.h"
#include "tools/station/gateway/message_bytes.h"

namespace sprung::gateway {
namespace {

OperatorLink opened(const RemoteOptions& options) {
  OperatorLink link(options);
  link.open();
  return link;
}

std::string answer_text(const sprung_msgs::operator_reply_t& reply) {
  return name(static_cast<OperatorOutcome>(reply.outcome)) +
         (reply.reason.empty() ? "" : ": " + reply.reason);
}

}  // namespace

std::string stop_in_emergency(const RemoteOptions& options) {
  OperatorLink link = opened(options);
  OperatorCommand stop;
  stop.kind = OperatorKind::kEstop;
  stop.request_id = request_id_at(link.run_us(monotonic_us()));
  sprung_msgs::operator_command_t message;
  to_message(stop, 0, message);
  const std::string text = encoded(message);
  const std::int64_t end_us = monotonic_us() + OperatorLink::kGiveUp_us;
  for (std::int64_t next_us = 0; monotonic_us() < end_us && !stop_requested();) {
    if (monotonic_us() >= next_us) {
      link.say(SaidKind::kCommand, text, monotonic_us());
      next_us = monotonic_us() + kEstopAgain_us;
    }
    link.wait_and_hear(5);
    for (const Told& told : link.take_told()) {
      const auto reply = reply_in(told);
      if (reply && reply->request_id == stop.request_id) return answer_text(*reply);
    }
  }
  return "";
}

RemoteRobot::RemoteRobot(const RemoteOptions& options) : link_(opened(options)), mirror_(link_) {}

void RemoteRobot::hand_over(const std::string& name) {
  constexpr int kTries = 30;
  for (int k = 0; k < kTries && !stop_requested(); ++k) {
    if (mirror_.driver() == name) return;
    if (k % 5 == 0) mirror_.ask_hand_over(name);
    usleep(100'000);
  }
  const std::string driver = mirror_.driver();
  throw std::runtime_error((driver.empty() ? "nobody" : driver) + " drives, and " + name +
                           " does not: only who drives hands over, to an operator whose key is to drive or "
                           "maintain (on the robot: sprung operator key list)");
}

}  // namespace sprung::gateway

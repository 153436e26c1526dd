#include "tools/station/gateway/gateway_shell.h"

#include <sodium.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/log.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/gateway/audit_log_shell.h"
#include "tools/station/gateway/file_parts.h"
#include "tools/station/gateway/gate.h"
#include "tools/station/gateway/operator_register_shell.h"
#include "tools/station/gateway/served_files_shell.h"
#include "tools/station/gateway/served_robot_shell.h"
#include "tools/station/gateway/token_bucket.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;

constexpr int kTick_ms = 10;
constexpr std::int64_t kWatch_us = 50'000, kLook_us = 1'000'000;
constexpr int kMostAtOnce = 500;  // datagrams; then the robot is served again
/// [design choice] for parts of files, of all operators: 2.2 MB/s, so that fetching logs costs a robot that
/// walks no cycle.
constexpr double kRequestsEachSecond = 125.0, kRequestsAtOnce = 8.0;

class Gateway {
 public:
  explicit Gateway(const GatewayOptions& options)
      : options_(options),
        socket_(UdpSocket::bound_to(options.listen)),
        gate_(robot_key(options.state_folder), read_register(register_file())),
        audit_(options.state_folder + "/operator-audit.jsonl"),
        files_(options.log_folder) {
    remember_register();
  }

  int port() const { return socket_.port(); }

  void run() {
    while (!stop_requested()) {
      socket_.wait(kTick_ms);
      const std::int64_t now_us = monotonic_us();
      if (now_us >= next_look_us_) look(now_us);
      hear(now_us);
      serve(now_us);
      audit_.step(now_us);
    }
    audit_.step(monotonic_us(), true);
  }

 private:
  std::string register_file() const { return options_.state_folder + "/operators.json"; }

  void remember_register() {
    std::error_code none;
    register_written_ = fs::last_write_time(register_file(), none);
  }

  /// Once a second: which robot is up, and who may command it.
  void look(std::int64_t now_us) {
    next_look_us_ = now_us + kLook_us;
    std::error_code none;
    if (fs::last_write_time(register_file(), none) != register_written_) read_operators();
    try {
      follow_run();
      trouble_.clear();
    } catch (const std::exception& error) {  // what is missing may be there in a second
      if (std::exchange(trouble_, error.what()) != error.what()) log_error(error.what());
    }
  }

  void follow_run() {
    const std::optional<RunInfo> run = read_run_file(options_.instance);
    if (robot_ && (!run || run->session != robot_->info().session)) part_from_robot();
    if (run && !robot_) meet(*run);
  }

  void read_operators() {
    remember_register();
    try {
      gate_.know(read_register(register_file()));
    } catch (const std::exception& error) {
      log_error(std::string("operators stay as they were: ") + error.what());
    }
  }

  void part_from_robot() {
    robot_.reset();
    gate_.robot_is_down();
    files_.robot_is_down();
  }

  void meet(const RunInfo& run) {
    robot_ = std::make_unique<ServedRobot>(run);
    gate_.robot_is_up(run.session, run.epoch_us);
    files_.robot_is_up(robot_->description(), run.robot_folder, run.log);
    log_info("robot " + run.robot + " is up");
  }

  void hear(std::int64_t now_us) {
    std::string from;
    for (int count = 0; count < kMostAtOnce; ++count) {
      const auto packet = socket_.receive(from);
      if (!packet) return;
      std::uint64_t session = 0;
      randombytes_buf(&session, sizeof session);
      obey(gate_.take(from, *packet, now_us, std::max<std::uint64_t>(1, session)), from, now_us);
    }
  }

  void obey(const Verdict& verdict, const std::string& from, std::int64_t now_us) {
    for (const auto& [to, packet] : verdict.packets) socket_.send(packet, to);
    if (verdict.turned != Turned::kNone)
      return audit_.turned(name(verdict.turned), verdict.who, address_text(from), now_us);
    if (!verdict.event.empty()) audit_.event(verdict.who, address_text(from), verdict.event);
    if (verdict.command && robot_) robot_->link().say(*verdict.command);
    if (verdict.part_asked.empty()) return;
    const auto request = parse_request(verdict.part_asked);
    if (!request || !parts_.take(now_us)) return;  // who lacks one asks again
    for (const FilePart& part : files_.parts(*request, now_us))
      tell(verdict.session, ToldKind::kPart, part_text(part), now_us);
  }

  void tell(std::uint64_t session, ToldKind kind, std::string text, std::int64_t now_us) {
    if (const auto packet = gate_.tell(session, kind, std::move(text), now_us))
      socket_.send(packet->second, packet->first);
  }

  void serve(std::int64_t now_us) {
    const std::vector<std::uint64_t> sessions = gate_.sessions();
    if (robot_)
      for (const std::string& text : robot_->due(now_us))
        for (const std::uint64_t session : sessions) tell(session, ToldKind::kMessage, text, now_us);
    if (now_us < next_watch_us_) return;
    next_watch_us_ = now_us + kWatch_us;
    watch_link(now_us);
    for (const std::uint64_t session : sessions) tell(session, ToldKind::kNews, news(session), now_us);
  }

  std::string news(std::uint64_t session) const {
    auto out = nlohmann::ordered_json::parse(gate_.news(session));
    out["run"] = robot_ ? robot_->info().session : 0;
    return out.dump();
  }

  void watch_link(std::int64_t now_us) {
    const bool moves = robot_ && robot_->moves();
    if (gate_.link_is_lost(moves, now_us)) {
      say_stop();
    } else {
      stop_.request_id = 0;
    }
    for (const std::string& name : gate_.tidy(moves, now_us))
      audit_.event(name, "", "drives no more: not heard for 10 s");
  }

  /// The same one until the robot stands: another would begin the gait's stopping anew.
  void say_stop() {
    if (stop_.request_id == 0) {
      audit_.event("gateway", "", "stop: the link to who moves the robot is lost");
      stop_.kind = OperatorKind::kStop;
      stop_.request_id = request_id_at(robot_->link().utime_us());
    }
    robot_->link().say(stop_);
  }

  GatewayOptions options_;
  UdpSocket socket_;
  Gate gate_;
  AuditLog audit_;
  ServedFiles files_;
  TokenBucket parts_{kRequestsEachSecond, kRequestsAtOnce};
  std::unique_ptr<ServedRobot> robot_;
  fs::file_time_type register_written_{};
  std::string trouble_;  ///< said last, so that it is said once
  std::int64_t next_look_us_ = 0, next_watch_us_ = 0;
  OperatorCommand stop_;  ///< request 0: the link is there
};

}  // namespace

void serve_operators(const GatewayOptions& options, const std::function<void(int port)>& ready) {
  start_crypto();
  Gateway gateway(options);
  ready(gateway.port());
  gateway.run();
}

}  // namespace sprung::gateway

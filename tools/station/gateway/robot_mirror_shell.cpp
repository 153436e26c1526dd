#include "tools/station/gateway/robot_mirror_shell.h"

#include <sodium.h>
#include <sprung_version.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/key_source.h"
#include "runtime/session_clock.h"
#include "runtime/types_hash.h"
#include "signals/modes.h"
#include "tools/station/gateway/file_parts.h"
#include "tools/station/gateway/message_bytes.h"
#include "tools/station/server/robot_channels.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of a message that was quicker than all before: it must not seem to come from the future (freshness.h).
constexpr std::int64_t kMargin_us = 50'000;
constexpr std::int64_t kStatus_us = 500'000;
constexpr const char* kLinkName = "operator-link";

/// One process's own: nobody else on this computer meets there by chance.
std::string own_network() {
  std::array<std::uint8_t, 4> random{};
  randombytes_buf(random.data(), random.size());
  const int port = 20000 + (random[2] * 256 + random[3]) % 20000;
  return "udpm://239.254." + std::to_string(random[0]) + "." + std::to_string(1 + random[1] % 254) + ":" +
         std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

std::string private_folder() {
  std::string path = (fs::temp_directory_path() / "sprung-via-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr) throw std::runtime_error(path + ": cannot be made");
  return path;
}

/// Programs of other message types refuse each other's messages without a word.
void demand_same_types(const Json& description, const std::string& host) {
  if (description.at("types").get<std::int64_t>() == types_hash()) return;
  throw std::runtime_error("sprung on " + host + " is of " + description.at("version").get<std::string>() +
                           ", here of " SPRUNG_GIT_HASH
                           ", and their messages differ: build and install the same commit on both");
}

std::string text_in(const Json& object, const char* field) {
  const auto found = object.find(field);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::optional<sprung_msgs::operator_reply_t> reply_in(const Told& told) {
  const auto message = told.kind == ToldKind::kMessage ? message_in(told.text) : std::nullopt;
  if (!message || message->channel != channels::kOperatorReply) return std::nullopt;
  ReceiveGuard guard(channels::kOperatorReply, layout_of<sprung_msgs::operator_reply_t>(),
                     CountLimits::none(), 0);
  sprung_msgs::operator_reply_t out;
  if (guard.decode(message->bytes.data(), message->bytes.size(), out) != Refusal::kNone) return std::nullopt;
  return out;
}

RobotMirror::RobotMirror(OperatorLink& link) : link_(link), folder_(private_folder()) {
  try {
    setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
    describe();
  } catch (...) {
    remove();
    throw;
  }
  thread_ = std::thread([this] { run(); });
}

RobotMirror::~RobotMirror() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
  remove();
}

void RobotMirror::remove() {
  run_file_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string RobotMirror::driver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return driver_;
}

void RobotMirror::ask_hand_over(const std::string& name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  hand_over_ = name;
}

/// Run file, key and the robot's own files, as if it had been started here.
void RobotMirror::describe() {
  fetch_robot(link_.fetch("run"));
  info_.via = link_.host();
  info_.instance = "default";
  info_.lcm_url = own_network();
  info_.log.clear();
  info_.launcher_pid = 0;
  info_.epoch_us += link_.offset_us() - kMargin_us;
  info_.processes.push_back({kLinkName, 0});
  for (RunningProcess& process : info_.processes) process.pid = 0;
  robot_ = std::make_unique<RobotConfig>(load_robot(info_.robot_folder));
  run_file_ = std::make_unique<RunFile>(info_.instance);
  run_file_->write_key(*random_key());
  run_file_->write(info_);
  node_ = std::make_unique<Node>(commanding(info_));
  node_->subscribe_message(channels::kOperatorCommand, CountLimits::none(), commands_);
  add_channels();
  node_->start();
}

void RobotMirror::fetch_robot(const std::string& text) {
  const Json description = Json::parse(text);
  demand_same_types(description, link_.host());
  info_ = parse_run(description.at("run").dump());
  if (!is_plain_name(info_.robot)) throw std::runtime_error("'" + info_.robot + "' is no robot's name");
  const fs::path robot = fs::path(folder_) / "robot" / info_.robot;
  fs::create_directories(robot);
  for (const Json& file : description.at("files")) {
    const std::string name = file;
    if (!is_plain_name(name)) throw std::runtime_error("'" + name + "' is no file's name");
    std::ofstream(robot / name, std::ios::binary) << link_.fetch("robot/" + name);
  }
  info_.robot_folder = robot;
}

template <class M>
void RobotMirror::add(const char* channel, const CountLimits& limits) {
  auto guard = std::make_shared<ReceiveGuard>(channel, layout_of<M>(), limits, 0);
  channels_[channel] = [this, channel, guard, message = M()](std::string_view bytes) mutable {
    if (guard->decode(bytes.data(), bytes.size(), message) == Refusal::kNone)
      node_->publish_message(channel, message);
  };
}

void RobotMirror::add_channels() {
  station::visit_robot_channels(*robot_, [this](const auto& channel) {
    add<typename std::decay_t<decltype(channel)>::Message>(channel.name, channel.limits);
  });
  add<sprung_msgs::process_status_t>(channels::kProcessStatus, CountLimits::none());
  add<sprung_msgs::operator_reply_t>(channels::kOperatorReply, CountLimits::none());
}

void RobotMirror::run() {
  while (!over_) {
    link_.wait_and_hear(5);
    const std::int64_t now_us = monotonic_us();
    for (const Told& told : link_.take_told()) say_again(told);
    forward(now_us);
    if (now_us >= next_status_us_) say_link(now_us);
  }
  link_.say(SaidKind::kBye, "", monotonic_us());
}

void RobotMirror::say_again(const Told& told) {
  if (told.kind == ToldKind::kNews) return take_news(told.text);
  const auto message = told.kind == ToldKind::kMessage ? message_in(told.text) : std::nullopt;
  if (!message) return;
  if (const auto reply = reply_in(told); reply && reply->request_id == estop_id_) estop_.clear();
  const auto found = channels_.find(message->channel);
  if (found != channels_.end()) found->second(message->bytes);
}

void RobotMirror::take_news(const std::string& text) {
  const Json news = Json::parse(text, nullptr, false);
  if (!news.is_object()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  driver_ = text_in(news, "driver");
  you_ = text_in(news, "you");
  role_ = text_in(news, "role");
  const auto run = news.find("run");
  gone_ = run == news.end() || !run->is_number_integer() || run->get<std::int64_t>() != info_.session;
}

/// An emergency stop is said until somebody answers.
void RobotMirror::forward(std::int64_t now_us) {
  while (const auto command = commands_.pop()) {
    const std::string text = encoded(*command);
    link_.say(SaidKind::kCommand, text, now_us);
    if (static_cast<OperatorKind>(command->kind) != OperatorKind::kEstop) continue;
    estop_ = text;
    estop_id_ = command->request_id;
    next_estop_us_ = now_us + kEstopAgain_us;
  }
  if (!estop_.empty() && now_us >= next_estop_us_) {
    link_.say(SaidKind::kCommand, estop_, now_us);
    next_estop_us_ = now_us + kEstopAgain_us;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (hand_over_.empty()) return;
  link_.say(SaidKind::kHandOver, hand_over_, now_us);
  hand_over_.clear();
}

/// What `status` and the console show of the link, as a process of the robot.
void RobotMirror::say_link(std::int64_t now_us) {
  next_status_us_ = now_us + kStatus_us;
  sprung_msgs::process_status_t status{};
  status.utime = node_->utime_us();
  status.pid = getpid();
  status.state = static_cast<std::int8_t>(ProcessState::kRunning);
  status.process = kLinkName;
  status.robot = info_.robot;
  status.clock = info_.clock;
  status.detail = link_text(now_us);
  node_->publish_message(channels::kProcessStatus, status);
}

std::string RobotMirror::link_text(std::int64_t now_us) const {
  const std::int64_t silent_us = link_.silent_us(now_us);
  if (silent_us > OperatorLink::kLost_us) {
    char text[24];
    std::snprintf(text, sizeof text, "%.1f s", 1e-6 * static_cast<double>(silent_us));
    return "link to " + info_.via + " LOST for " + text + ": a robot that moves for us stops and stands";
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  return "via " + info_.via + " as " + you_ + " (" + role_ + "); " + (driver_.empty() ? "nobody" : driver_) +
         " drives" + (gone_ ? "; the robot is down" : "");
}

}  // namespace sprung::gateway

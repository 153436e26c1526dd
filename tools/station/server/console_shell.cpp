#include "tools/station/server/console_shell.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "runtime/stop_request.h"
#include "tools/operate/launcher/torque_watch.h"
#include "tools/station/foxglove/robot_messages.h"
#include "tools/station/frames/frame_layout.h"
#include "tools/station/scene/run_scene.h"
#include "tools/station/server/console_session.h"
#include "tools/station/server/foxglove_session.h"
#include "tools/station/server/frame_bytes.h"
#include "tools/station/server/live_report.h"
#include "tools/station/server/page_files.h"
#include "tools/station/server/robot_link_shell.h"

namespace sprung::station {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kProtocols{"sprung.v1", "foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr std::int64_t kTick_us = 20'000;
// Beside the robot's own processes a page may take 3 % of a core: the state's text costs as much as 15
// frames.
constexpr std::int64_t kFrame_us = 2 * kTick_us;
constexpr std::int64_t kState_us = 250'000;
constexpr std::int64_t kProcesses_us = 500'000;  // PROCESS_STATUS comes twice a second
constexpr std::int64_t kRunCheck_us = 1'000'000;

std::array<unsigned char, 16> random_bytes() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the kernel gives no random numbers for the page's token");
  return bytes;
}

std::string random_token() {
  std::string text;
  for (const unsigned char byte : random_bytes()) {
    char hex[3];
    std::snprintf(hex, sizeof hex, "%02x", byte);
    text += hex;
  }
  return text;
}

std::uint64_t utc_ns() { return static_cast<std::uint64_t>(utc_us()) * 1000; }

/// For viewers; nothing of a robot that cannot be drawn.
std::optional<RobotMessages> drawn_robot(const RobotConfig& robot, const std::string& scene_text,
                                         const std::vector<FrameField>& fields) {
  const auto scene = nlohmann::json::parse(scene_text);
  if (scene.contains("missing")) return std::nullopt;
  return std::make_optional<RobotMessages>(robot, scene, fields);
}

class Console {
 public:
  Console(const RunInfo& info, const ConsoleOptions& options)
      : info_(info),
        robot_(robot_of(info)),
        link_(info, robot_),
        session_(robot_, {info.preset, info.maintenance, random_bytes()[0]}),
        drives_(robot_.actuators.size()),
        joints_(robot_.joints.size(), robot_.legs.size()),
        nonce_(random_token()),
        page_text_(console_page(nonce_)),
        scene_text_(scene_of_run(robot_, info).dump()),
        layout_text_(frame_layout(robot_, link_.frame_fields()).dump()),
        drawn_(drawn_robot(robot_, scene_text_, link_.frame_fields())),
        viewers_(robot_.name, RobotLink::channels_heard(), drawn_ ? drawn_->shapes(utc_ns()) : ""),
        server_({options.port,
                 random_token(),
                 {kProtocols.begin(), kProtocols.end()},
                 options.other_origins,
                 ConsoleSession::kLongestText,
                 nonce_},
                {[this](std::string_view path) { return file(path); },
                 [this](int page, std::string_view protocol) { opened(page, protocol); },
                 [this](int page) { closed(page); },
                 [this](int page, std::string_view text) { heard(page, text); }}) {
    for (const auto& [channel, type] : RobotLink::channels_heard()) viewers_readers_.push_back({channel, 0});
  }

  ConsoleAddress address() const {
    const int port = server_.port();
    return {"http://127.0.0.1:" + std::to_string(port) + "/" + server_.token() + "/", port};
  }

  std::string run() {
    while (!stop_requested()) {
      const std::int64_t now_us = link_.utime_us();
      if (now_us >= next_tick_us_) tick(now_us);
      if (now_us >= session_.next_step_us()) flush();
      if (now_us >= next_run_check_us_ && !run_goes_on(now_us)) return farewell();
      const std::int64_t next_us = std::min(next_tick_us_, session_.next_step_us());
      server_.service(static_cast<int>(std::max<std::int64_t>(1, (next_us - now_us) / 1000)));
    }
    return "";
  }

 private:
  const WebFile* file(std::string_view path) const {
    if (path.empty()) return &page_;
    if (path == "scene.json") return &scene_;
    if (path == "layout.json") return &layout_;
    return console_file(path);
  }

  void opened(int page, std::string_view protocol) {
    if (protocol != kProtocols.front()) {
      for (std::string& text : viewers_.opened(page)) server_.send(page, std::move(text));
      return;
    }
    pages_.insert(page);
    OrderedJson hello = robot_json(robot_);
    hello["type"] = "robot";
    hello["preset"] = info_.preset;
    hello["clock"] = info_.clock;
    hello["simulation"] = info_.simulation;
    hello["maintenance"] = info_.maintenance;
    hello["instance"] = info_.instance;
    server_.send(page, hello.dump());
    session_.page_opened(page, link_.utime_us());
    flush();
  }

  void closed(int page) {
    viewers_.closed(page);
    if (pages_.erase(page) == 0) return;
    session_.page_closed(page, link_.utime_us());
    flush();
  }

  void heard(int page, std::string_view text) {
    if (viewers_.has(page)) {
      std::string told = viewers_.text(page, text);
      if (!told.empty()) server_.send(page, std::move(told));
      return send_binaries(viewers_.take_shapes(utc_us() * 1000));
    }
    session_.text(page, text, link_.utime_us());
    flush();
  }

  void flush() {
    const Outbox out = session_.step(link_.utime_us());
    for (const OperatorCommand& command : out.commands) link_.say(command);
    for (const auto& [page, text] : out.texts) server_.send(page, text);
    for (const int page : out.close) server_.close(page);
  }

  void tick(std::int64_t now_us) {
    next_tick_us_ = now_us + kTick_us;
    for (const RobotAnswer& answer : link_.take_answers()) session_.answer(answer, now_us);
    listen(now_us);
    flush();
    if (now_us >= next_frame_us_ && (!pages_.empty() || robot_is_viewed())) send_frame(now_us);
    send_to_viewers();
    if (!pages_.empty() && now_us >= next_state_us_) send_state(now_us);
  }

  bool robot_is_viewed() const {
    return std::any_of(kRobotTopics.begin(), kRobotTopics.end(),
                       [this](RobotTopic topic) { return viewers_.wanted(name_of(topic)); });
  }

  void send_frame(std::int64_t now_us) {
    next_frame_us_ = now_us + kFrame_us - kTick_us / 2;  // ticks come late, never early
    const Frame* const frame = link_.frame();
    if (frame == nullptr) return;
    const auto bytes = std::make_shared<const std::string>(frame_bytes(*frame));
    for (const int page : pages_) server_.send_frame(page, bytes);
    for (const RobotTopic topic : kRobotTopics) {
      if (!drawn_ || topic == RobotTopic::kShapes || !viewers_.wanted(name_of(topic))) continue;
      const std::uint64_t now_ns = utc_ns();
      const std::string payload = drawn_->message(topic, *frame, now_ns);
      send_binaries(viewers_.robot_message(topic, payload, static_cast<std::int64_t>(now_ns)));
    }
  }

  void send_binaries(FoxgloveSession::Messages&& messages) {
    for (auto& [page, bytes] : messages) server_.send_binary(page, std::move(bytes));
  }

  void send_to_viewers() {
    for (RobotLink::Reader& reader : viewers_readers_) {
      if (!viewers_.wanted(reader.channel)) continue;
      if (const auto* const bytes = link_.newest(reader))
        send_binaries(viewers_.message(reader.channel, bytes->data(), bytes->size(), utc_us() * 1000));
    }
  }

  void listen(std::int64_t now_us) {
    if (!link_.drives(drives_)) return;
    drives_heard_us_ = now_us;
    // In lock-step a message's time is not the clock's.
    const bool lockstep = info_.clock == "lockstep";
    session_.drives(may_have_torque(drives_), lockstep ? now_us : drives_.stamp.utime_us);
  }

  RobotNow robot_now() const {
    RobotNow now;
    for (const EstimatedJoint& joint : joints_.joints)
      now.joint_positions_rad.push_back(joint.estimated_position_rad);
    const auto& motion = heard_->motion.message;
    const bool walks = motion && static_cast<MotionPhase>(motion->state) == MotionPhase::kWalking;
    now.walking_in = walks ? motion->gait : -1;
    return now;
  }

  void send_state(std::int64_t now_us) {
    next_state_us_ = now_us + kState_us;
    heard_ = &link_.hear();
    link_.joints(joints_);
    session_.robot_is(robot_now());
    if (now_us >= next_processes_us_) {
      processes_ = processes_json(info_, *heard_);
      next_processes_us_ = now_us + kProcesses_us;
    }
    OrderedJson state{{"type", "state"}, {"time_s", 1e-6 * static_cast<double>(drives_.stamp.utime_us)}};
    state["age_s"] = drives_.stamp.seq < 0
                         ? OrderedJson(nullptr)
                         : OrderedJson(1e-6 * static_cast<double>(now_us - drives_heard_us_));
    state.update(live_json(joints_, drives_));
    state.update(health_json(robot_, *heard_));
    state["processes"] = processes_;
    state["session"] = session_.status_json(now_us);
    const auto text = std::make_shared<const std::string>(
        state.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
    for (const int page : pages_) server_.send_state(page, text);
  }

  bool run_goes_on(std::int64_t now_us) {
    next_run_check_us_ = now_us + kRunCheck_us;
    const auto run = read_run_file(info_.instance);
    return run && run->session == info_.session;
  }

  std::string farewell() {
    for (const int page : pages_)
      server_.send(page, OrderedJson({{"type", "end"}, {"text", "the robot is down"}}).dump());
    const std::int64_t until_us = link_.utime_us() + 10 * kTick_us;
    while (link_.utime_us() < until_us) server_.service(20);
    return info_.robot + " is down";
  }

  RunInfo info_;
  RobotConfig robot_;
  RobotLink link_;
  ConsoleSession session_;
  DriveState drives_;
  JointState joints_;
  std::int64_t drives_heard_us_ = 0;
  const HeardRobot* heard_ = nullptr;
  OrderedJson processes_ = OrderedJson::array();
  std::string nonce_, page_text_, scene_text_, layout_text_;
  WebFile page_{"text/html; charset=utf-8", page_text_};
  WebFile scene_{"application/json", scene_text_};
  WebFile layout_{"application/json", layout_text_};
  std::set<int> pages_;                 ///< of ours; the others are viewers
  std::optional<RobotMessages> drawn_;  ///< what viewers are told of the robot
  FoxgloveSession viewers_;
  std::vector<RobotLink::Reader> viewers_readers_;
  std::int64_t next_tick_us_ = 0, next_frame_us_ = 0, next_state_us_ = 0, next_processes_us_ = 0,
               next_run_check_us_ = 0;
  WebServer server_;
};

}  // namespace

std::string serve_console(const RunInfo& info, const ConsoleOptions& options,
                          const std::function<void(const ConsoleAddress&)>& ready) {
  Console console(info, options);
  ready(console.address());
  return console.run();
}

}  // namespace sprung::station

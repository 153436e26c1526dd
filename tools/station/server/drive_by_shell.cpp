#include "tools/station/server/drive_by_shell.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "robots/robot_loader.h"
#include "runtime/stop_request.h"
#include "tools/operate/launcher/torque_watch.h"
#include "tools/station/server/console_session.h"
#include "tools/station/server/gamepad_device_shell.h"
#include "tools/station/server/robot_link_shell.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

constexpr int kPage = 1;  // this program
constexpr std::chrono::milliseconds kTick{20};
constexpr std::int64_t kFarewell_us = 500'000;  // for the stop that ends the walk

class DriveBy {
 public:
  DriveBy(const RunInfo& info, const DriveByOptions& options, std::function<void(const std::string&)> tell)
      : robot_(load_robot(info.robot_folder)),
        link_(info, robot_),
        session_(robot_, {info.preset, false, static_cast<std::uint64_t>(info.session) + 1}),
        device_(options.device),
        tell_(std::move(tell)),
        drives_(robot_.actuators.size()) {
    if (robot_.gaits.empty()) throw std::invalid_argument(robot_.name + " has no gaits: it does not walk");
    if (!options.gait.empty()) gait_ = gait_named(options.gait);
  }

  std::string run() {
    tell_("gamepad " + device_.name() +
          ": L1 or R1 held, left stick: go, right stick: turn; B: emergency stop; Ctrl-C ends");
    session_.page_opened(kPage, link_.utime_us());
    while (!stop_requested()) {
      if (!device_.read(gamepad_, link_.utime_us())) {
        leave();
        return "the gamepad is gone; the robot stands";
      }
      say_sticks();
      step();
      std::this_thread::sleep_for(kTick);
    }
    leave();
    return "";
  }

 private:
  int gait_named(const std::string& name) const {
    std::string there;
    for (std::size_t i = 0; i < robot_.gaits.size(); ++i) {
      if (robot_.gaits[i].name == name && robot_.gaits[i].duty < 1.0) return static_cast<int>(i);
      if (robot_.gaits[i].duty < 1.0) there += " " + robot_.gaits[i].name;
    }
    throw std::invalid_argument("no gait '" + name + "' to drive in; there are:" + there);
  }

  void say_sticks() {
    const StickInput input = gamepad_.input();
    Json sticks{{"type", "sticks"},
                {"source", "gamepad"},
                {"forward", input.sticks.forward},
                {"left", input.sticks.left},
                {"turning", input.sticks.turning},
                {"dead_man", input.dead_man}};
    if (gait_ >= 0) sticks["gait"] = gait_;
    session_.text(kPage, sticks.dump(), link_.utime_us());
    if (gamepad_.take_stop()) session_.text(kPage, R"({"type":"estop"})", link_.utime_us());
  }

  void step() {
    const std::int64_t now_us = link_.utime_us();
    for (const RobotAnswer& answer : link_.take_answers()) session_.answer(answer, now_us);
    if (link_.drives(drives_)) session_.drives(may_have_torque(drives_), drives_.stamp.utime_us);
    const Outbox out = session_.step(now_us);
    for (const OperatorCommand& command : out.commands) link_.say(command);
    for (const auto& [page, text] : out.texts) show(Json::parse(text));
    const Json sticks = session_.status_json(now_us)["sticks"];
    const std::string state = sticks["state"].get<std::string>();
    if (state != told_) tell_(state == "locked" ? "locked: " + sticks["why"].get<std::string>() : state);
    told_ = state;
  }

  void show(const Json& message) {
    const std::string type = message["type"].get<std::string>();
    if (type == "error") tell_(message["text"].get<std::string>());
    if (type == "estop") tell_("EMERGENCY STOP: " + message["state"].get<std::string>());
  }

  /// Nobody is there any more: what was held ends in a stand.
  void leave() {
    session_.page_closed(kPage, link_.utime_us());
    const std::int64_t end_us = link_.utime_us() + kFarewell_us;
    while (link_.utime_us() < end_us) {
      step();
      std::this_thread::sleep_for(kTick);
    }
  }

  RobotConfig robot_;
  RobotLink link_;
  ConsoleSession session_;
  GamepadDevice device_;
  Gamepad gamepad_;
  std::function<void(const std::string&)> tell_;
  DriveState drives_;
  int gait_ = -1;
  std::string told_;
};

}  // namespace

std::string drive_by_gamepad(const RunInfo& info, const DriveByOptions& options,
                             const std::function<void(const std::string&)>& tell) {
  return DriveBy(info, options, tell).run();
}

}  // namespace sprung::station

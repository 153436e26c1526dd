#include "tools/operate/launcher/launch_view.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "robots/overlay.h"
#include "runtime/session_clock.h"

namespace sprung {
namespace {

constexpr std::int64_t kDraw_us = 200'000;
constexpr std::size_t kLinesLeftBehind = 20;

std::string facts_of(const RunInfo& info) {
  std::string facts = "clock " + info.clock + ", preset " + info.preset;
  if (info.simulation) facts += ", simulated drives";
  if (info.maintenance) facts += ", maintenance mode";
  return facts + ", LCM " + info.lcm_url;
}

/// As it is named from this folder, where it lies below it.
std::string from_here(const std::string& path) {
  std::error_code unknown;
  const std::string near = std::filesystem::proximate(path, unknown).string();
  return unknown || near.rfind("..", 0) == 0 ? path : near;
}

}  // namespace

std::string first_commands(const RobotConfig& robot, bool maintenance) {
  const bool referenced = std::all_of(robot.actuators.begin(), robot.actuators.end(),
                                      [](const ActuatorConfig& actuator) { return actuator.referenced; });
  std::string out = maintenance ? "sprung hold; in a third: " : "";
  if (!referenced) out += "sprung home, ";
  if (maintenance) return out + "sprung move, sprung stand, sprung status, sprung down";
  if (robot.why_not_standing() == nullptr)
    out += robot.gaits.empty() ? "sprung stand, sprung jump, " : "sprung stand, sprung walk, sprung stop, ";
  return out + "sprung status, sprung down";
}

LaunchView::LaunchView(Launcher& launcher, const RobotConfig& robot, bool plain)
    : launcher_(launcher), robot_(robot), begin_us_(monotonic_us()) {
  if (!plain && has_terminal()) terminal_ = std::make_unique<Terminal>();
  launcher_.on_line([this](const LogLine& line) {
    lines_.add(line);
    if (terminal_ == nullptr) std::fprintf(stderr, "%s\n", dated(line).c_str());
  });
  launcher_.on_turn([this] { turn(); });
}

LaunchView::~LaunchView() {
  launcher_.on_line({});
  launcher_.on_turn({});
  if (terminal_ == nullptr) return;
  terminal_.reset();
  const auto& lines = lines_.lines();
  for (std::size_t i = lines.size() - std::min(lines.size(), kLinesLeftBehind); i < lines.size(); ++i)
    std::fprintf(stderr, "%s\n", dated(lines[i]).c_str());
}

void LaunchView::phase(const std::string& phase) {
  phase_ = phase;
  if (terminal_ != nullptr) draw();
}

void LaunchView::announce(double ready_s) {
  phase("up");
  const RunInfo& info = launcher_.info();
  if (terminal_ != nullptr) {
    char text[64];
    std::snprintf(text, sizeof text, "ready in %.1f s", ready_s);
    launcher_.say(text);
    for (const OverlaidNumber& one : robot_.overlay) launcher_.say(overlaid_text(one));
    return;
  }
  std::printf("%s is up: %zu processes, clock %s, preset %s, ready in %.1f s\n", info.robot.c_str(),
              launcher_.running(), info.clock.c_str(), info.preset.c_str(), ready_s);
  std::printf("  LCM  %s\n", info.lcm_url.c_str());
  if (!info.log.empty()) std::printf("  log  %s\n", info.log.c_str());
  if (info.simulation && info.clock == "realtime")
    std::printf(
        "  note simulated drives in real time: the longer simulation_watchdogs of robot.yaml apply\n");
  if (info.maintenance)
    std::printf("  note maintenance mode: a quarter of the speed, half of the torque, and hold to run\n");
  for (const OverlaidNumber& one : robot_.overlay) std::printf("  note %s\n", overlaid_text(one).c_str());
  std::printf("In a second terminal: %s. Ctrl-C here ends it.\n",
              first_commands(robot_, info.maintenance).c_str());
  std::fflush(stdout);
}

void LaunchView::turn() {
  const std::int64_t now_us = monotonic_us();
  if (terminal_ == nullptr || now_us < next_draw_us_) return;
  next_draw_us_ = now_us + kDraw_us;
  draw();
}

ScreenContent LaunchView::content() const {
  ScreenContent content;
  content.robot = robot_.name;
  content.phase = phase_;
  content.facts = facts_of(launcher_.info());
  content.log = launcher_.info().log.empty() ? "" : from_here(launcher_.info().log);
  content.safety = "nothing heard of the bridge yet";
  if (const auto& safety = launcher_.safety()) {
    content.safety = safety->level_name + ", cause " + safety->cause_name;
    if (!safety->detail.empty()) content.safety += ": " + safety->detail;
    content.safety_bad = safety->latched != 0;
  }
  content.up_s = static_cast<double>(monotonic_us() - begin_us_) * 1e-6;
  content.rows = launcher_.rows();
  content.hint = "Ctrl-C ends it, drives first. In a second terminal: " +
                 first_commands(robot_, launcher_.info().maintenance);
  return content;
}

void LaunchView::draw() {
  const Terminal::Size size = terminal_->size();
  terminal_->draw(launch_screen(content(), lines_.lines(), size.width, size.height));
}

}  // namespace sprung

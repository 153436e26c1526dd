/// What a browser page says to `sprung console`: a text a line.
#include <cmath>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "tests/fuzz/fuzz.h"
#include "tools/station/server/console_session.h"

namespace sprung::fuzz::tools_station_session {
namespace {

std::vector<std::string> session_seeds() {
  return {R"({"type":"request","id":1,"command":"stand"})"
          "\n"
          R"({"type":"request","id":2,"command":"walk","parameters":{"forward_m_s":0.2,"gait":"trot"}})"
          "\n"
          R"({"type":"hold","held":true})"
          "\n"
          R"({"type":"estop"})",
          R"({"type":"sticks","source":"pad","forward":0,"left":0,"turning":0,"dead_man":false,"gait":3})"
          "\n"
          R"({"type":"sticks","source":"pad","forward":1,"left":-1e300,"turning":0,"dead_man":true})",
          R"({"type":"request","id":9,"command":"move","parameters":{"joint":"fl_hip","by_deg":5}})"
          "\n"
          R"({"type":"take_over"})"
          "\n"
          R"({"type":"enable","held":true})"};
}

void look_at(const station::Outbox& out) {
  for (const OperatorCommand& command : out.commands) {
    require(command.request_id > 0 && command.kind != OperatorKind::kNone, "a command that means something");
    for (const double speed : command.walk_speed) require(std::isfinite(speed), "a speed");
    require(std::isfinite(command.jump_height_m), "a height");
  }
  for (const auto& [page, text] : out.texts) require(nlohmann::json::accept(text), "JSON to pages");
}

}  // namespace

SPRUNG_FUZZ(tools_station_session, session_seeds) {
  static const RobotConfig robot = load_robot("pegasus");
  station::ConsoleSession session(robot, {"best", true, 1});
  session.page_opened(1, 0);
  std::int64_t now_us = 0;
  const std::string all(input.rest());
  for (std::size_t begin = 0, end = 0; begin <= all.size() && end != std::string::npos; begin = end + 1) {
    end = all.find('\n', begin);
    session.text(1, std::string_view(all).substr(begin, end - begin), now_us += 50'000);
    look_at(session.step(now_us));
  }
}

}  // namespace sprung::fuzz::tools_station_session

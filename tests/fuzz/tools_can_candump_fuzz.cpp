/// Lines of a candump file.
#include "tests/fuzz/fuzz.h"
#include "tools/can/decode/candump_text.h"

namespace sprung::fuzz::tools_can_candump {
namespace {

using namespace cantools;

std::vector<std::string> candump_seeds() {
  return {"(1436509052.249713) can0 044#2A366C2B",
          "(1436509052.249713) can0 044#2A366C2B T",
          " (000.000123)  can0  044   [4]  2A 36 6C 2B",
          "  can0  044   [4]  remote request",
          "(1.000000) can0 044#R4 R",
          "(0.5) vcan1 20000044#0011223344556677",
          "(1436509052.249713) can0 12345678##0112233",
          " can0  TX - -  123   [2]  00 FF"};
}

void look_at(const std::string& line) {
  std::string interface, again_interface;
  ObservedFrame frame, again;
  if (parse_candump(line, interface, frame) != CandumpLine::kFrame) return;
  require(frame.frame.length <= 8, "at most 8 bytes");
  if (frame.time_us < 0 || interface.find('#') != std::string::npos || interface[0] == '(') return;
  const std::string own = candump_line(frame, interface, frame.time_us);
  require(parse_candump(own, again_interface, again) == CandumpLine::kFrame, "own lines are read");
  require(again.time_us == frame.time_us && again_interface == interface, "time and interface come back");
  if (frame.frame.error) return;  // their identifier is cut to 11 bit in neither direction
  require(again.frame == frame.frame, "the frame comes back");
}

}  // namespace

SPRUNG_FUZZ(tools_can_candump, candump_seeds) { look_at(std::string(input.rest())); }

}  // namespace sprung::fuzz::tools_can_candump

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/can/commands/can/can_commands.h"
#include "tools/can/decode/candump_text.h"
#include "tools/can/decode/frame_filter.h"
#include "tools/can/decode/frame_line.h"

namespace sprung::commands {

namespace {

using cantools::BusDescription;
using cantools::ObservedFrame;

constexpr int kTimeout_ms = 100;

struct DumpRequest {
  BusRequest where;
  std::string log;
  bool raw = false;
  bool as_json = false;
  std::vector<std::string> filters;
  std::int64_t count = 0;
  double for_s = 0.0;
};

std::unique_ptr<FrameSource> open_live(const std::optional<RobotConfig>& robot, const DumpRequest& request) {
  const BusRequest& where = request.where;
  if (robot) return open_live_source(robot_buses(*robot, where));
  if (where.can.empty()) {
    throw WrongUse(
        "no robot is up: name one, or --can ADDRESS (socketcan:can0, udp:GROUP:PORT), or --log FILE");
  }
  std::vector<LiveBus> buses;
  for (const std::string& address : where.can) buses.push_back({address, address});
  return open_live_source(buses);
}

/// Prints what passes, until it has enough.
class Printer {
 public:
  Printer(const DumpRequest& request, const BusDescription& description, const FrameSource& source, int bus)
      : request_(request),
        filter_(request.filters, description),
        decoder_(description),
        source_(source),
        bus_(bus) {}

  /// @return false when no more is wanted.
  bool print(const ObservedFrame& frame) {
    if (begin_us_ < 0) begin_us_ = frame.time_us;
    if (request_.for_s > 0.0 && static_cast<double>(frame.time_us - begin_us_) > 1e6 * request_.for_s)
      return false;
    const cantools::DecodedFrame decoded = decoder_.decode(frame);
    if ((bus_ >= 0 && frame.bus != bus_) || !filter_.shows(frame, decoded)) return true;
    std::printf("%s\n", line_of(frame, decoded).c_str());
    return request_.count == 0 || ++printed_ < request_.count;
  }
  /// CAN FD has no node and no service, so that no filter lets it through.
  bool print(const cantools::ObservedFdFrame& frame) {
    if ((bus_ >= 0 && frame.bus != bus_) || !request_.filters.empty()) return true;
    if (begin_us_ < 0) begin_us_ = frame.time_us;
    std::printf("%s\n", line_of(frame).c_str());
    return request_.count == 0 || ++printed_ < request_.count;
  }

 private:
  std::string line_of(const ObservedFrame& frame, const cantools::DecodedFrame& decoded) const {
    const std::string& bus = source_.buses()[frame.bus];
    if (request_.raw) return cantools::candump_line(frame, bus, frame.time_us + source_.utc_offset_us());
    if (request_.as_json) return cantools::frame_json(frame, decoded, bus, begin_us_).dump();
    return cantools::frame_line(frame, decoded, bus, begin_us_);
  }

  std::string line_of(const cantools::ObservedFdFrame& frame) const {
    const std::string& bus = source_.buses()[frame.bus];
    if (request_.raw) return cantools::candump_fd_line(frame, bus, frame.time_us + source_.utc_offset_us());
    if (request_.as_json) return cantools::fd_frame_json(frame, bus, begin_us_).dump();
    return cantools::fd_frame_line(frame, bus, begin_us_);
  }

  const DumpRequest& request_;
  cantools::FrameFilter filter_;
  cantools::FrameDecoder decoder_;
  const FrameSource& source_;
  int bus_;
  std::int64_t begin_us_ = -1;
  std::int64_t printed_ = 0;
};

std::unique_ptr<FrameSource> open_source(const DumpRequest& request, const std::optional<RobotConfig>& robot,
                                         const BusNames& names) {
  if (request.log.empty()) return open_live(robot, request);
  return open_file_source(request.log, names.description.buses, names.interfaces);
}

/// @return false when no more is wanted.
bool print_fd(FrameSource& source, Printer& printer) {
  cantools::ObservedFdFrame frame;
  while (source.next_fd(frame)) {
    if (!printer.print(frame)) return false;
  }
  return true;
}

/// Until the end of the file, enough lines, or a stop; a live bus may also be silent to its end.
void print_all(FrameSource& source, Printer& printer, const DumpRequest& request) {
  const bool ends = request.log.empty() && request.for_s > 0.0;
  const std::int64_t end_us = monotonic_us() + std::llround(1e6 * request.for_s);
  while (!stop_requested() && !(ends && monotonic_us() >= end_us)) {
    ObservedFrame frame;
    const FrameSource::Read read = source.next(frame, kTimeout_ms);
    if (read == FrameSource::Read::kEnd) break;
    if (read == FrameSource::Read::kFrame && !printer.print(frame)) break;
    if (!print_fd(source, printer)) break;
    if (read == FrameSource::Read::kNothingYet) std::fflush(stdout);
  }
  std::fflush(stdout);
}

int run_dump(const DumpRequest& request) {
  const std::optional<RobotConfig> robot = robot_of(request.where, request.log);
  const BusNames names = names_of(robot);
  const auto source = open_source(request, robot, names);
  Printer printer(request, names.description, *source, chosen_bus(request.where, robot, *source));
  print_all(*source, printer, request);
  tell_losses(*source);
  return kExitDone;
}

}  // namespace

void add_can_dump(CommandLine& can) {
  const auto request = std::make_shared<DumpRequest>();
  CommandLine& dump = can.subcommand(
      "dump",
      "Frames in words: of the live buses (listens, never sends), of an LCM log or of a candump file.");
  dump.option("robot", request->where.robot,
              "name of a folder in robots/, or a folder; default: the one that is up, or the log's");
  dump.option("--bus", request->where.bus, "only this bus");
  dump.option(
      "--can", request->where.can,
      "ADDRESS or BUS=ADDRESS instead of robot.yaml's: socketcan:can0, socketcan:can0?fd=1 for CAN FD "
      "too, udp:GROUP:PORT");
  dump.option("--log", request->log, "read this LCM log or candump file instead of a live bus");
  dump.flag("--raw", request->raw, "undecoded, in the format of candump -L");
  dump.option("--filter", request->filters,
              "only nmt, sync, time, emcy, pdo, tpdo, rpdo, sdo, heartbeat, lss, error, unknown, a node's "
              "name or number, or "
              "an identifier (0x181); '!sdo' leaves it out; may be repeated");
  dump.option("--count", request->count, "end after so many lines, 0 = never");
  dump.option("--for", request->for_s, "end after so many seconds, 0 = never");
  dump.flag("--json", request->as_json, "one JSON object a line");
  dump.option("--instance", request->where.instance, "which run, where several robots are up");
  dump.example("sprung can dump single_leg --filter emcy --filter sdo");
  dump.action([=] { return run_dump(*request); });
}

}  // namespace sprung::commands

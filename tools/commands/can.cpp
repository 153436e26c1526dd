#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/canopen/bus_description.h"
#include "tools/canopen/candump_text.h"
#include "tools/canopen/frame_filter.h"
#include "tools/canopen/frame_line.h"
#include "tools/canopen/pcapng_bytes.h"
#include "tools/client/bus_choice.h"
#include "tools/client/frame_source.h"
#include "tools/commands/commands.h"

namespace sprung::commands {

namespace {

using cantools::BusDescription;
using cantools::ObservedFrame;

constexpr int kPatience_ms = 100;

struct DumpRequest {
  BusRequest where;
  std::string log;
  bool raw = false;
  bool as_json = false;
  std::vector<std::string> filters;
  std::int64_t count = 0;
  double for_s = 0.0;
};

/// Names, buses and interfaces of the robot, or of nothing.
struct Names {
  BusDescription description;
  std::vector<std::string> interfaces;  ///< "can0" of socketcan:can0, else ""
};

Names names_of(const RobotConfig& robot) {
  Names names{cantools::describe_buses(robot), {}};
  constexpr const char* kSocketCan = "socketcan:";
  for (const BusConfig& bus : robot.buses) {
    const bool kernel = bus.can.rfind(kSocketCan, 0) == 0;
    names.interfaces.push_back(kernel ? bus.can.substr(std::string(kSocketCan).size()) : "");
  }
  return names;
}

/// The robot that was named, that the log names, or that is up; "" where there is none of these.
std::string robot_of(const BusRequest& where, const std::string& log) {
  if (!where.robot.empty()) return where.robot;
  if (!log.empty()) return is_lcm_log(log) ? log_origin(log).robot : "";
  const std::optional<RunInfo> info = read_run_file(where.instance);
  return info ? info->robot_folder : "";
}

/// A log may come from a robot that this tree does not have: then there are numbers instead of names.
std::optional<RobotConfig> load_named(const std::string& name, bool required) {
  if (name.empty()) return std::nullopt;
  try {
    return load_robot(name);
  } catch (const ConfigError& error) {
    if (required) throw;
    std::fprintf(stderr, "no names of nodes and objects: %s\n", error.what());
    return std::nullopt;
  }
}

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

 private:
  std::string line_of(const ObservedFrame& frame, const cantools::DecodedFrame& decoded) const {
    const std::string& bus = source_.buses()[static_cast<std::size_t>(frame.bus)];
    if (request_.raw) return cantools::candump_line(frame, bus, frame.time_us + source_.utc_offset_us());
    if (request_.as_json) return cantools::frame_json(frame, decoded, bus, begin_us_).dump();
    return cantools::frame_line(frame, decoded, bus, begin_us_);
  }

  const DumpRequest& request_;
  cantools::FrameFilter filter_;
  cantools::FrameDecoder decoder_;
  const FrameSource& source_;
  int bus_;
  std::int64_t begin_us_ = -1;
  std::int64_t printed_ = 0;
};

void tell_losses(const FrameSource& source) {
  const std::string losses = source.losses();
  if (!losses.empty()) std::fprintf(stderr, "%s\n", losses.c_str());
}

int chosen_bus(const BusRequest& where, const std::optional<RobotConfig>& robot, const FrameSource& source) {
  if (where.bus.empty()) return -1;
  if (robot) return bus_index(*robot, where.bus);
  for (std::size_t i = 0; i < source.buses().size(); ++i) {
    if (source.buses()[i] == where.bus) return static_cast<int>(i);
  }
  throw WrongUse("--bus " + where.bus +
                 ": which robot's? Name it first, for example: sprung can dump single_leg");
}

int run_dump(const DumpRequest& request) {
  const bool live = request.log.empty();
  const std::optional<RobotConfig> robot =
      load_named(robot_of(request.where, request.log), live || !request.where.robot.empty());
  const Names names = robot ? names_of(*robot) : Names{};
  const auto source = live ? open_live(robot, request)
                           : open_file_source(request.log, names.description.buses, names.interfaces);
  Printer printer(request, names.description, *source, chosen_bus(request.where, robot, *source));
  const std::int64_t end_us = monotonic_us() + std::llround(1e6 * request.for_s);
  while (!stop_requested()) {
    ObservedFrame frame;
    const FrameSource::Read read = source->next(frame, kPatience_ms);
    if (read == FrameSource::Read::kEnd) break;
    if (read == FrameSource::Read::kFrame && !printer.print(frame)) break;
    if (read == FrameSource::Read::kNothingYet) std::fflush(stdout);
    if (live && request.for_s > 0.0 && monotonic_us() >= end_us) break;
  }
  std::fflush(stdout);
  tell_losses(*source);
  return kExitDone;
}

struct ExportRequest {
  std::string log;
  std::string format = "candump";
  std::string robot;
  std::string bus;
  std::string out = "-";
};

/// Writes to a file or to standard output, and complains when the disk is full.
class Output {
 public:
  explicit Output(const std::string& path)
      : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) throw std::runtime_error("cannot write " + path + ": does its folder exist?");
  }
  ~Output() {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(const std::string& bytes) { std::fwrite(bytes.data(), 1, bytes.size(), file_); }
  void finish() {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0)
      throw std::runtime_error("cannot write all of " + path_ + ": is the disk full?");
  }

 private:
  std::string path_;
  FILE* file_;
};

/// Interfaces are announced when they are first needed: a log's buses are known only when it was read.
class PcapngWriter {
 public:
  explicit PcapngWriter(Output& out) : out_(out) {
    out_.write(cantools::pcapng_section("sprung can export"));
  }
  void write(const ObservedFrame& frame, const FrameSource& source) {
    while (announced_ < source.buses().size())
      out_.write(cantools::pcapng_interface(source.buses()[announced_++]));
    out_.write(cantools::pcapng_packet(frame, frame.time_us + source.utc_offset_us()));
  }

 private:
  Output& out_;
  std::size_t announced_ = 0;
};

int run_export(const ExportRequest& request) {
  const bool pcap = request.format == "pcap";
  if (pcap && request.out == "-" && isatty(STDOUT_FILENO) != 0)
    throw WrongUse("pcap is binary: add -o FILE.pcapng");
  BusRequest where;
  where.robot = request.robot;
  where.bus = request.bus;
  const std::optional<RobotConfig> robot = load_named(robot_of(where, request.log), !request.robot.empty());
  const Names names = robot ? names_of(*robot) : Names{};
  const auto source = open_file_source(request.log, names.description.buses, names.interfaces);
  const int bus = chosen_bus(where, robot, *source);
  Output out(request.out);
  std::optional<PcapngWriter> writer;
  if (pcap) writer.emplace(out);
  std::int64_t frames = 0;
  ObservedFrame frame;
  while (!stop_requested() && source->next(frame, 0) == FrameSource::Read::kFrame) {
    if (bus >= 0 && frame.bus != bus) continue;
    ++frames;
    const std::string& name = source->buses()[static_cast<std::size_t>(frame.bus)];
    if (pcap) {
      writer->write(frame, *source);
    } else {
      out.write(cantools::candump_line(frame, name, frame.time_us + source->utc_offset_us()) + "\n");
    }
  }
  out.finish();
  tell_losses(*source);
  if (frames == 0) {
    std::fprintf(stderr, "%s holds no CAN frames: was CAN_TRACE recorded?\n", request.log.c_str());
    return kExitFailed;
  }
  if (request.out != "-")
    std::printf("%lld frames to %s\n", static_cast<long long>(frames), request.out.c_str());
  return kExitDone;
}

void add_dump(CommandLine& can) {
  const auto request = std::make_shared<DumpRequest>();
  CommandLine& dump = can.subcommand(
      "dump",
      "Frames in words: of the live buses (listens, never sends), of an LCM log or of a candump file.");
  dump.option("robot", request->where.robot,
              "name of a folder in robots/, or a folder; default: the one that is up, or the log's");
  dump.option("--bus", request->where.bus, "only this bus");
  dump.option("--can", request->where.can,
              "ADDRESS or BUS=ADDRESS instead of robot.yaml's: socketcan:can0, udp:GROUP:PORT");
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

void add_export(CommandLine& can) {
  const auto request = std::make_shared<ExportRequest>();
  CommandLine& to =
      can.subcommand("export", "CAN frames of a log for can-utils (candump -L text) or Wireshark (pcapng).");
  to.option("log", request->log, "LCM log or candump file", Need::kRequired);
  to.choice("--format", request->format, {"candump", "pcap"}, "pcap writes pcapng, one interface a bus");
  to.option("--bus", request->bus, "only this bus");
  to.option("--robot", request->robot, "whose buses these are; default: as the log says");
  to.option("-o,--output", request->out, "file, - = standard output");
  to.example("sprung can export logs/single_leg.lcm --format pcap -o single_leg.pcapng");
  to.action([=] { return run_export(*request); });
}

}  // namespace

void add_can(CommandLine& sprung) {
  CommandLine& can = sprung.subcommand("can", "Look at CAN frames, live or recorded.");
  can.example("sprung can dump single_leg");
  add_dump(can);
  add_export(can);
}

}  // namespace sprung::commands

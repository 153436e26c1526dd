#include <unistd.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

#include "runtime/stop_request.h"
#include "tools/can/commands/can/can_commands.h"
#include "tools/can/decode/candump_text.h"
#include "tools/can/decode/pcapng_bytes.h"

namespace sprung::commands {

namespace {

using cantools::ObservedFrame;

struct ExportRequest {
  std::string log;
  std::string format = "candump";
  BusRequest where;  ///< robot and bus only
  std::string out = "-";
};

/// Writes to a file or to standard output, and complains when the disk is full.
class ExportFile {
 public:
  explicit ExportFile(const std::string& path)
      : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) throw std::runtime_error("cannot write " + path + ": does its folder exist?");
  }
  ~ExportFile() {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  }
  ExportFile(const ExportFile&) = delete;
  ExportFile& operator=(const ExportFile&) = delete;

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
  explicit PcapngWriter(ExportFile& out) : out_(out) {
    out_.write(cantools::pcapng_section("sprung can export"));
  }
  void write(const ObservedFrame& frame, const FrameSource& source) {
    while (announced_ < source.buses().size())
      out_.write(cantools::pcapng_interface(source.buses()[announced_++]));
    out_.write(cantools::pcapng_packet(frame, frame.time_us + source.utc_offset_us()));
  }

 private:
  ExportFile& out_;
  std::size_t announced_ = 0;
};

void write_candump(ExportFile& out, const ObservedFrame& frame, const FrameSource& source) {
  const std::string& bus = source.buses()[frame.bus];
  out.write(cantools::candump_line(frame, bus, frame.time_us + source.utc_offset_us()) + "\n");
}

/// @param bus -1 = all. @return how many frames.
std::int64_t write_all(FrameSource& source, int bus, bool pcap, ExportFile& out) {
  std::optional<PcapngWriter> writer;
  if (pcap) writer.emplace(out);
  std::int64_t frames = 0;
  ObservedFrame frame;
  while (!stop_requested() && source.next(frame, 0) == FrameSource::Read::kFrame) {
    if (bus >= 0 && frame.bus != bus) continue;
    ++frames;
    if (writer) {
      writer->write(frame, source);
    } else {
      write_candump(out, frame, source);
    }
  }
  out.finish();
  return frames;
}

/// On standard error where the capture itself goes to standard output.
void tell_wireshark(const std::string& out) {
  const bool piped = out == "-";
  std::fprintf(piped ? stderr : stdout,
               "CANopen in words: wireshark -d can.subdissector,canopen %s (tshark takes it too)\n",
               piped ? "FILE" : out.c_str());
}

int run_export(const ExportRequest& request) {
  const bool pcap = request.format == "pcap";
  if (pcap && request.out == "-" && isatty(STDOUT_FILENO) != 0)
    throw WrongUse("pcap is binary: add -o FILE.pcapng");
  const std::optional<RobotConfig> robot = robot_of(request.where, request.log);
  const BusNames names = names_of(robot);
  const auto source = open_file_source(request.log, names.description.buses, names.interfaces);
  const int bus = chosen_bus(request.where, robot, *source);
  ExportFile out(request.out);
  const std::int64_t frames = write_all(*source, bus, pcap, out);
  tell_losses(*source);
  if (frames == 0) {
    std::fprintf(stderr, "%s holds no CAN frames: was CAN_TRACE recorded?\n", request.log.c_str());
    return kExitFailed;
  }
  if (request.out != "-")
    std::printf("%lld frames to %s\n", static_cast<long long>(frames), request.out.c_str());
  if (pcap) tell_wireshark(request.out);
  return kExitDone;
}

}  // namespace

void add_can_export(CommandLine& can) {
  const auto request = std::make_shared<ExportRequest>();
  CommandLine& to = can.subcommand(
      "export",
      "CAN frames of a log for can-utils (candump -L text) or Wireshark (pcapng; CANopen in words: wireshark "
      "-d can.subdissector,canopen FILE).");
  to.option("log", request->log, "LCM log or candump file", Need::kRequired);
  to.choice("--format", request->format, {"candump", "pcap"}, "pcap writes pcapng, one interface a bus");
  to.option("--bus", request->where.bus, "only this bus");
  to.option("--robot", request->where.robot, "whose buses these are; default: as the log says");
  to.option("-o,--output", request->out, "file, - = standard output");
  to.example("sprung can export logs/single_leg.lcm --format pcap -o single_leg.pcapng");
  to.action([=] { return run_export(*request); });
}

}  // namespace sprung::commands

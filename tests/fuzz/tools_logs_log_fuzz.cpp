/// Any file as a log: read, judged, described, repaired, exported.
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "sprung_msgs/drive_state_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "sprung_msgs/process_status_t.hpp"
#include "sprung_msgs/safety_state_t.hpp"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/own_file.h"
#include "tools/logs/log/csv_export.h"
#include "tools/logs/log/info_text.h"
#include "tools/logs/log/mcap_export.h"
#include "tools/logs/log/rewrite.h"
#include "tools/logs/log/verify.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung::fuzz::tools_logs_log {
namespace {

using namespace log;

class SeedLog {
 public:
  explicit SeedLog(const char* name) : path_(own_folder() + name), writer_(path_) {}
  template <class M>
  SeedLog& add(const char* channel, M message, std::int64_t seq) {
    message.session = 5;
    message.utime = 1000 * (seq + 1);
    message.seq = seq;
    const std::vector<std::uint8_t> bytes = message_bytes(message);
    writer_.write(1'700'000'000'000'000 + message.utime, channel, bytes.data(), bytes.size());
    return *this;
  }
  std::string bytes() {
    writer_.close();
    std::ifstream in(path_, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

 private:
  std::string path_;
  Writer writer_;
};

sprung_msgs::drive_state_t drive_state() {
  sprung_msgs::drive_state_t state{};
  state.n = 1;
  state.actuators.resize(1);
  return state;
}

sprung_msgs::motion_state_t motion_state(int phase) {
  sprung_msgs::motion_state_t state{};
  state.n_legs = 1;
  state.legs.resize(1);
  state.legs[0].phase = static_cast<std::int8_t>(phase);
  state.state = static_cast<std::int8_t>(phase);
  return state;
}

std::vector<std::string> log_seeds() {
  sprung_msgs::log_metadata_t metadata{};
  metadata.robot = "single_leg";
  metadata.robot_yaml = "robot: single_leg\n";
  sprung_msgs::log_end_t end{};
  end.events = 5;
  sprung_msgs::safety_state_t safety{};
  safety.level = 2;
  safety.cause = 5;
  const std::string whole = SeedLog("whole")
                                .add(channels::kLogMetadata, metadata, -1)
                                .add(channels::kDriveState, drive_state(), 0)
                                .add(channels::kDriveState, drive_state(), 1)
                                .add(channels::kDriveState, drive_state(), 4)
                                .add(channels::kSafetyState, safety, 4)
                                .add(channels::kLogEnd, end, -1)
                                .bytes();
  const std::string phases = SeedLog("phases")
                                 .add(channels::kMotionState, motion_state(2), 0)
                                 .add(channels::kMotionState, motion_state(4), 1)
                                 .add(channels::kProcessStatus, sprung_msgs::process_status_t{}, 1)
                                 .bytes();
  return {whole, phases, whole.substr(0, whole.size() / 2), whole.substr(10) + phases};
}

/// Every byte is of an event or of a damage.
std::int64_t read_all(const std::string& path, std::size_t buffer_bytes) {
  ReaderOptions options;
  options.buffer_bytes = buffer_bytes;
  Reader reader(path, options);
  std::uint64_t bytes = 0;
  std::int64_t events = 0;
  for (Event event; reader.next(event); ++events) bytes += event.bytes_in_file();
  require(bytes + reader.skipped_bytes() == reader.file_bytes(), "every byte is accounted for");
  return events;
}

void repair_and_require_whole(const std::string& path, const std::string& repaired) {
  Reader damaged(path);
  Writer writer(repaired);
  repair(damaged, writer);
  writer.close();
  Reader reader(repaired);
  for (Event event; reader.next(event);) {
  }
  require(reader.damages().empty(), "a repaired log is whole");
}

void describe(const std::string& path) {
  Reader reader(path);
  const LogInfo info = collect_info(reader);
  require(!info_text(info).empty(), "a text");
  require(!info_json(info).empty(), "JSON");
  reader.rewind();
  require(!verify_text(path, verify(reader)).empty(), "a verdict");
}

void export_all(const std::string& path) {
  Reader reader(path);
  std::size_t bytes = 0;
  export_csv(reader, FieldSelection({}), {}, {}, [&](std::string_view text) { bytes += text.size(); });
  reader.rewind();
  ChannelFilter all({});
  McapOptions plain;
  plain.compress = false;
  McapWriter mcap([&](std::string_view text) { bytes += text.size(); }, "fuzz", plain);
  export_mcap(reader, all, mcap);
  mcap.finish();
}

}  // namespace

SPRUNG_FUZZ(tools_logs_log, log_seeds) {
  const std::string path = own_folder() + "any.lcm";
  write_file(path, input.rest());
  const std::int64_t events = read_all(path, 64);
  require(read_all(path, std::size_t{1} << 16U) == events, "whatever the buffer's size");
  describe(path);
  repair_and_require_whole(path, own_folder() + "repaired.lcm");
  export_all(path);
}

}  // namespace sprung::fuzz::tools_logs_log

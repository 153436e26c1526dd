#include "tools/station/gateway/remote_robot_shell.h"

#include <sodium.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/key_source.h"
#include "runtime/node.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/gateway/file_parts.h"
#include "tools/station/gateway/gate.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kHelloAgain_us = 300'000, kAlive_us = 20'000, kEstopAgain_us = 20'000;
constexpr std::int64_t kGiveUp_us = 10'000'000;
/// Nothing heard: the link is lost. After the second one it is begun anew.
constexpr std::int64_t kLost_us = 500'000, kAnew_us = 2'000'000;
/// Of a message that was quicker than all before: it must not seem to come from the future (freshness.h).
constexpr std::int64_t kMargin_us = 50'000;
constexpr std::int64_t kStatus_us = 500'000;
constexpr const char* kLinkName = "operator-link";
constexpr std::size_t kPartsAtOnce = 32;
constexpr std::int64_t kPartAgain_us = 400'000;

}  // namespace

/// The conversation, on one thread at a time.
class RemoteRobot::Link {
 public:
  Link(const RemoteOptions& options, const OperatorKeyFile& key)
      : socket_(UdpSocket::connected_to(parse_host_port(options.host, kDefaultPort))),
        key_(key.seed),
        robot_key_(key.robot_key),
        host_(options.host),
        hidden_(options.hidden) {}

  /// @throws std::runtime_error where the gateway does not answer, or refuses.
  void open() {
    const std::int64_t end_us = monotonic_us() + kGiveUp_us;
    while (session_ == 0 && monotonic_us() < end_us && !stop_requested()) {
      begin_if_due(monotonic_us());
      socket_.wait(20);
      hear(monotonic_us());
      if (!refusal_.empty()) throw std::runtime_error(host_ + " refuses: " + refusal_);
    }
    if (session_ == 0)
      throw std::runtime_error("no answer of a gateway at " + host_ +
                               " in 10 s: does sprung-operator-gateway run there, is UDP let through, and is "
                               "this operator's key known to it (sprung operator key list)?");
  }

  /// A whole file of the robot's. @throws std::runtime_error
  std::string fetch(const std::string& file) {
    std::string out;
    std::map<std::uint64_t, std::string> parts;
    std::map<std::uint64_t, std::int64_t> asked_us;
    std::optional<std::uint64_t> total;
    const std::int64_t end_us = monotonic_us() + kGiveUp_us;
    while (!total || out.size() < *total) {
      const std::int64_t now_us = monotonic_us();
      if (now_us > end_us || stop_requested())
        throw std::runtime_error("'" + file + "' of the robot did not arrive in 10 s");
      const std::uint64_t last = total ? *total : out.size() + 1;
      for (std::size_t k = 0; k < kPartsAtOnce; ++k) {
        const std::uint64_t at = out.size() + k * kPartBytes;
        if (at >= last) break;
        if (parts.count(at) != 0 || (asked_us.count(at) != 0 && now_us - asked_us[at] < kPartAgain_us))
          continue;
        asked_us[at] = now_us;
        say(SaidKind::kFile, request_text({file, at}), now_us);
      }
      wait_and_hear(10);
      for (Told& told : take_told()) {
        const auto part = told.kind == ToldKind::kPart ? parse_part(told.text) : std::nullopt;
        if (!part || part->file != file) continue;
        if (part->error == "no robot is up")
          throw NotRunning("no robot is up on " + host_ + ". Start one there: sprung up ROBOT");
        if (!part->error.empty()) throw std::runtime_error(file + ": " + part->error);
        total = part->total;
        parts[part->offset] = part->bytes;
      }
      for (auto next = parts.find(out.size()); next != parts.end() && !next->second.empty();
           next = parts.find(out.size())) {
        out += next->second;
        parts.erase(next);
      }
    }
    return out;
  }

  void wait_and_hear(int timeout_ms) {
    socket_.wait(timeout_ms);
    const std::int64_t now_us = monotonic_us();
    hear(now_us);
    if (now_us >= next_alive_us_) say(SaidKind::kAlive, "", now_us);
    if (silent_us(now_us) > kAnew_us) begin_if_due(now_us);
  }

  void say(SaidKind kind, const std::string& text, std::int64_t now_us) {
    if (session_ == 0) return;
    next_alive_us_ = now_us + kAlive_us;
    socket_.send(signed_packet({session_, ++said_, now_us - offset_us_, kind, text}, key_));
  }

  std::deque<Told> take_told() { return std::exchange(told_, {}); }
  /// Ours less the robot's computer's clock; by the quickest datagram.
  std::int64_t offset_us() const noexcept { return offset_us_; }
  std::int64_t silent_us(std::int64_t now_us) const noexcept { return now_us - heard_us_; }
  const std::string& host() const noexcept { return host_; }
  /// The robot's session's time.
  std::int64_t session_us(std::int64_t now_us) const noexcept { return now_us - offset_us_ - epoch_us_; }

 private:
  void begin_if_due(std::int64_t now_us) {
    if (now_us < next_hello_us_) return;
    next_hello_us_ = now_us + kHelloAgain_us;
    if (!exchange_) {
      exchange_ = ExchangeKey::make();
      randombytes_buf(nonce_.data(), nonce_.size());
    }
    socket_.send(
        hello_packet({key_.public_key(), exchange_->public_key(), nonce_, hidden_}, key_, robot_key_));
  }

  void hear(std::int64_t now_us) {
    std::string from;
    while (const auto packet = socket_.receive(from)) {
      if (kind_of(*packet) == PacketKind::kWelcome) welcome(*packet, now_us);
      if (session_ == 0 || sealed_session(*packet) != session_) continue;
      auto told = read_told(*packet, *seal_);
      if (!told || !seen_.is_new(told->number)) continue;
      seen_.take(told->number);
      note_time(told->time_us, now_us);
      told_.push_back(std::move(*told));
    }
  }

  void welcome(std::string_view packet, std::int64_t now_us) {
    const auto welcome = read_welcome(packet, robot_key_, key_.public_key());
    if (!welcome || !exchange_ || welcome->nonce != nonce_) return;
    refusal_ = welcome->refusal;
    if (welcome->session == 0) return;
    seal_ = Seal::of_operator(*exchange_, welcome->exchange);
    exchange_.reset();
    session_ = welcome->session;
    epoch_us_ = welcome->epoch_us;
    seen_ = ReplayWindow();
    said_ = 0;
    offset_us_ = std::numeric_limits<std::int64_t>::max();
    note_time(welcome->time_us, now_us);
    say(SaidKind::kAlive, "", now_us);
  }

  void note_time(std::int64_t time_us, std::int64_t now_us) {
    heard_us_ = now_us;
    offset_us_ = std::min(offset_us_, now_us - time_us);
  }

  UdpSocket socket_;
  SigningKey key_;
  PublicKey robot_key_;
  std::string host_;
  bool hidden_;
  std::optional<ExchangeKey> exchange_;
  Nonce16 nonce_{};
  std::optional<Seal> seal_;
  std::uint64_t session_ = 0, said_ = 0;
  ReplayWindow seen_;
  std::int64_t offset_us_ = 0, epoch_us_ = 0, heard_us_ = 0, next_hello_us_ = 0, next_alive_us_ = 0;
  std::string refusal_;
  std::deque<Told> told_;
};

namespace {

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

std::optional<sprung_msgs::operator_reply_t> reply_in(const Told& told) {
  const std::string channel = std::string(channels::kOperatorReply) + '\0';
  if (told.kind != ToldKind::kMessage || told.text.compare(0, channel.size(), channel) != 0)
    return std::nullopt;
  ReceiveGuard guard(channels::kOperatorReply, layout_of<sprung_msgs::operator_reply_t>(),
                     CountLimits::none(), 0);
  sprung_msgs::operator_reply_t out;
  if (guard.decode(told.text.data() + channel.size(), told.text.size() - channel.size(), out) !=
      Refusal::kNone)
    return std::nullopt;
  return out;
}

std::string encoded(const sprung_msgs::operator_command_t& command) {
  std::string out(static_cast<std::size_t>(command.getEncodedSize()), '\0');
  command.encode(out.data(), 0, static_cast<int>(out.size()));
  return out;
}

}  // namespace

/// This computer's LCM network with the robot on it.
class RemoteRobot::Mirror {
 public:
  Mirror(Link& link) : link_(link), folder_(private_folder()) {
    try {
      setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
      describe();
    } catch (...) {
      remove();
      throw;
    }
    thread_ = std::thread([this] { run(); });
  }
  ~Mirror() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
    remove();
  }

  std::string driver() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return driver_;
  }
  void ask_hand_over(const std::string& name) {
    const std::lock_guard<std::mutex> lock(mutex_);
    hand_over_ = name;
  }

 private:
  void remove() {
    run_file_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Run file, key and the robot's own files, in a folder of this process.
  void describe() {
    const Json description = Json::parse(link_.fetch("run"));
    info_ = parse_run(description.at("run").dump());
    info_.via = link_.host();
    const fs::path robot = fs::path(folder_) / "robot" / info_.robot;
    fs::create_directories(robot);
    for (const Json& file : description.at("files")) {
      const std::string name = file;
      if (!is_plain_name(name)) throw std::runtime_error("'" + name + "' is no file's name");
      std::ofstream(robot / name, std::ios::binary) << link_.fetch("robot/" + name);
    }
    info_.robot_folder = robot;
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
    node_->start();
    add_channels();
  }

  template <class M>
  void add(const char* channel, const CountLimits& limits) {
    auto guard = std::make_shared<ReceiveGuard>(channel, layout_of<M>(), limits, 0);
    channels_[channel] = [this, channel, guard, message = M()](std::string_view bytes) mutable {
      if (guard->decode(bytes.data(), bytes.size(), message) == Refusal::kNone)
        node_->publish_message(channel, message);
    };
  }

  void add_channels() {
    const std::size_t actuators = robot_->actuators.size(), joints = robot_->joints.size(),
                      legs = robot_->legs.size();
    add<sprung_msgs::drive_state_t>(channels::kDriveState, CountLimits::exactly(actuators));
    add<sprung_msgs::drive_command_t>(channels::kDriveCommand, CountLimits::exactly(actuators));
    add<sprung_msgs::joint_state_t>(channels::kJointState, CountLimits::exactly(joints, legs));
    add<sprung_msgs::leg_command_t>(channels::kLegCommand, CountLimits::exactly(legs));
    add<sprung_msgs::motion_state_t>(channels::kMotionState, CountLimits::exactly(legs));
    add<sprung_msgs::safety_state_t>(channels::kSafetyState, CountLimits::none());
    add<sprung_msgs::imu_t>(channels::kImu, CountLimits::none());
    add<sprung_msgs::bus_state_t>(
        channels::kBusState,
        CountLimits::exactly(robot_->buses.size(), actuators + robot_->encoder_cards.size()));
    add<sprung_msgs::auxiliary_state_t>(channels::kAuxiliaryState, CountLimits::exactly(actuators));
    add<sprung_msgs::process_status_t>(channels::kProcessStatus, CountLimits::none());
    add<sprung_msgs::operator_reply_t>(channels::kOperatorReply, CountLimits::none());
  }

  void run() {
    while (!over_) {
      link_.wait_and_hear(5);
      const std::int64_t now_us = monotonic_us();
      for (const Told& told : link_.take_told()) say_again(told);
      forward(now_us);
      if (now_us >= next_status_us_) say_link(now_us);
    }
    link_.say(SaidKind::kBye, "", monotonic_us());
  }

  void say_again(const Told& told) {
    if (told.kind == ToldKind::kNews) return take_news(told.text);
    const std::size_t end = told.kind == ToldKind::kMessage ? told.text.find('\0') : std::string::npos;
    if (end == std::string::npos) return;
    const std::string channel = told.text.substr(0, end);
    const std::string_view bytes = std::string_view(told.text).substr(end + 1);
    if (const auto reply = reply_in(told); reply && reply->request_id == estop_id_) estop_.clear();
    const auto found = channels_.find(channel);
    if (found != channels_.end()) found->second(bytes);
  }

  void take_news(const std::string& text) {
    const Json news = Json::parse(text, nullptr, false);
    if (!news.is_object()) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    driver_ = news.value("driver", "");
    you_ = news.value("you", "");
    role_ = news.value("role", "");
    gone_ = news.value("session", std::int64_t{0}) != info_.session;
  }

  /// An emergency stop is said until somebody answers.
  void forward(std::int64_t now_us) {
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
  void say_link(std::int64_t now_us) {
    next_status_us_ = now_us + kStatus_us;
    sprung_msgs::process_status_t status{};
    status.utime = node_->utime_us();
    status.pid = getpid();
    status.state = static_cast<std::int8_t>(ProcessState::kRunning);
    status.process = kLinkName;
    status.robot = info_.robot;
    status.clock = info_.clock;
    const std::int64_t silent_us = link_.silent_us(now_us);
    const std::lock_guard<std::mutex> lock(mutex_);
    char text[200];
    if (silent_us > kLost_us)
      std::snprintf(text, sizeof text, "link to %s LOST for %.1f s: a robot that moves stops and stands",
                    info_.via.c_str(), 1e-6 * static_cast<double>(silent_us));
    else
      std::snprintf(text, sizeof text, "via %s as %s (%s); %s%s%s", info_.via.c_str(), you_.c_str(),
                    role_.c_str(), driver_.empty() ? "nobody" : driver_.c_str(), " drives",
                    gone_ ? "; the robot is down" : "");
    status.detail = text;
    node_->publish_message(channels::kProcessStatus, status);
  }

  Link& link_;
  std::string folder_;
  RunInfo info_;
  std::unique_ptr<RobotConfig> robot_;
  std::unique_ptr<RunFile> run_file_;
  InputQueue<sprung_msgs::operator_command_t> commands_{64};
  std::unique_ptr<Node> node_;
  std::map<std::string, std::function<void(std::string_view)>> channels_;
  std::string estop_;
  std::int64_t estop_id_ = 0, next_estop_us_ = 0, next_status_us_ = 0;
  mutable std::mutex mutex_;
  std::string driver_, you_, role_, hand_over_;
  bool gone_ = false;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

std::string RemoteRobot::emergency(const RemoteOptions& options) {
  start_crypto();
  Link link(options, read_operator_key(options.key));
  link.open();
  sprung_msgs::operator_command_t message;
  OperatorCommand stop;
  stop.kind = OperatorKind::kEstop;
  stop.request_id = request_id_at(link.session_us(monotonic_us()));
  to_message(stop, 0, message);
  const std::string text = encoded(message);
  const std::int64_t end_us = monotonic_us() + kGiveUp_us;
  for (std::int64_t next_us = 0; monotonic_us() < end_us && !stop_requested();) {
    if (monotonic_us() >= next_us) {
      link.say(SaidKind::kCommand, text, monotonic_us());
      next_us = monotonic_us() + kEstopAgain_us;
    }
    link.wait_and_hear(5);
    for (const Told& told : link.take_told()) {
      const auto reply = reply_in(told);
      if (reply && reply->request_id == stop.request_id)
        return name(static_cast<OperatorOutcome>(reply->outcome)) +
               (reply->reason.empty() ? "" : ": " + reply->reason);
    }
  }
  return "";
}

std::string stop_in_emergency(const RemoteOptions& options) { return RemoteRobot::emergency(options); }

RemoteRobot::RemoteRobot(const RemoteOptions& options) {
  start_crypto();
  link_ = std::make_unique<Link>(options, read_operator_key(options.key));
  link_->open();
  mirror_ = std::make_unique<Mirror>(*link_);
}

RemoteRobot::~RemoteRobot() = default;

void RemoteRobot::hand_over(const std::string& name) {
  constexpr int kTries = 30;
  for (int k = 0; k < kTries && !stop_requested(); ++k) {
    if (mirror_->driver() == name) return;
    if (k % 5 == 0) mirror_->ask_hand_over(name);
    usleep(100'000);
  }
  const std::string driver = mirror_->driver();
  throw std::runtime_error((driver.empty() ? "nobody" : driver) + " drives, and " + name +
                           " does not: only who drives hands over, to an operator whose key is to drive or "
                           "maintain (on the robot: sprung operator key list)");
}

}  // namespace sprung::gateway

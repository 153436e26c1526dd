#include "tools/station/gateway/operator_link_shell.h"

#include <sodium.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/gateway/file_parts.h"

namespace sprung::gateway {
namespace {

constexpr std::int64_t kHelloAgain_us = 300'000, kAlive_us = 20'000;
/// Nothing heard for as long: the conversation is begun anew.
constexpr std::int64_t kAnew_us = 2'000'000;

}  // namespace

OperatorLink::OperatorLink(const RemoteOptions& options)
    : OperatorLink(options, (start_crypto(), read_operator_key(options.key))) {}

OperatorLink::OperatorLink(const RemoteOptions& options, const OperatorKeyFile& key)
    : socket_(UdpSocket::connected_to(parse_host_port(options.host, kDefaultPort))),
      key_(key.seed),
      robot_key_(key.robot_key),
      host_(options.host),
      hidden_(options.hidden) {}

void OperatorLink::open() {
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

std::string OperatorLink::fetch(const std::string& file) {
  std::string out;
  FileAssembly assembly(file);
  fetch_into(assembly, file, [&](const std::string& piece) { out += piece; });
  return out;
}

void OperatorLink::fetch_into(FileAssembly& assembly, const std::string& file,
                              const std::function<void(const std::string& piece)>& take) {
  std::int64_t end_us = monotonic_us() + kGiveUp_us;
  while (!assembly.whole()) {
    const std::int64_t now_us = monotonic_us();
    if (now_us > end_us || stop_requested())
      throw std::runtime_error("'" + file + "' of the robot: nothing came for 10 s");
    for (const PartRequest& request : assembly.due(now_us))
      say(SaidKind::kFile, request_text(request), now_us);
    wait_and_hear(10);
    hear_parts(assembly, file);
    const std::string piece = assembly.take_bytes();
    if (piece.empty()) continue;
    take(piece);
    end_us = now_us + kGiveUp_us;
  }
}

void OperatorLink::hear_parts(FileAssembly& assembly, const std::string& file) {
  for (const Told& told : take_told()) {
    const auto part = told.kind == ToldKind::kPart ? parse_part(told.text) : std::nullopt;
    if (!part || assembly.take(*part)) continue;
    if (assembly.error() == kNoRobot)
      throw NotRunning("no robot is up on " + host_ + ". Start one there: sprung up ROBOT");
    throw std::runtime_error(file + ": " + assembly.error());
  }
}

void OperatorLink::wait_and_hear(int timeout_ms) {
  socket_.wait(timeout_ms);
  const std::int64_t now_us = monotonic_us();
  hear(now_us);
  if (now_us >= next_alive_us_) say(SaidKind::kAlive, "", now_us);
  if (silent_us(now_us) > kAnew_us) begin_if_due(now_us);
}

void OperatorLink::say(SaidKind kind, const std::string& text, std::int64_t now_us) {
  if (session_ == 0) return;
  next_alive_us_ = now_us + kAlive_us;
  socket_.send(signed_packet({session_, ++said_, now_us - offset_us_, kind, text}, key_));
}

void OperatorLink::begin_if_due(std::int64_t now_us) {
  if (now_us < next_hello_us_) return;
  next_hello_us_ = now_us + kHelloAgain_us;
  if (!exchange_) {
    exchange_ = ExchangeKey::make();
    randombytes_buf(nonce_.data(), nonce_.size());
  }
  socket_.send(hello_packet({key_.public_key(), exchange_->public_key(), nonce_, hidden_}, key_, robot_key_));
}

void OperatorLink::hear(std::int64_t now_us) {
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

void OperatorLink::welcome(std::string_view packet, std::int64_t now_us) {
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

void OperatorLink::note_time(std::int64_t time_us, std::int64_t now_us) {
  heard_us_ = now_us;
  offset_us_ = std::min(offset_us_, now_us - time_us);
}

}  // namespace sprung::gateway

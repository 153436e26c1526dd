#include "tools/can/lss_session.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/can/sdo_session.h"

namespace sprung {

using canopen::LssStatus;

namespace {

std::string refusal_text(const canopen::LssMaster& master) {
  const std::string code = std::to_string(master.error());
  if (master.error() == 1) return "error 1, out of range or not supported by this device";
  if (master.error() == 2) return "error 2, its memory cannot be written";
  if (master.error() == 255) return "the maker's own error " + std::to_string(master.maker_error());
  return "error " + code;
}

}  // namespace

LssStatus LssSession::run() {
  constexpr double kTurn_s = 0.001;  // the master looks at its times that often
  while (master_.status() == LssStatus::kBusy && !stop_requested()) {
    CanFrame request;
    while (master_.step(monotonic_us(), request)) bus_.send(&request, 1);
    if (master_.status() != LssStatus::kBusy) break;
    listen(bus_, kTurn_s, [&](const CanFrame& frame) {
      if (frame.error || !canopen::is_lss_reply(frame)) return true;
      master_.receive(frame);
      return false;
    });
  }
  return master_.status();
}

void LssSession::must(const char* what) {
  const LssStatus status = run();
  if (status == LssStatus::kDone) return;
  const std::string start = bus_.describe() + ", LSS, " + what + ": ";
  if (status == LssStatus::kRefused) throw LssFailed(start + "the device refuses, " + refusal_text(master_));
  throw LssFailed(
      start +
      "no answer. Is the identity right (sprung drive scan shows those with a node id, sprung can "
      "lss find those without), does the device have LSS (its EDS: LSS_Supported=1), is it powered?");
}

std::optional<canopen::LssIdentity> LssSession::find_next() {
  master_.fastscan();
  const LssStatus status = run();
  if (status == LssStatus::kNobody) return std::nullopt;
  if (status == LssStatus::kDone) return master_.identity();
  throw LssFailed(bus_.describe() +
                  ", LSS fastscan: a device answered, and its whole identity then nobody: a "
                  "bad contact, another master on the bus, or an answer that comes later "
                  "than 20 ms. Try again");
}

void LssSession::select(const canopen::LssIdentity& identity) {
  master_.select(identity);
  must(("selecting " + identity_text(identity)).c_str());
}

int LssSession::node() {
  master_.inquire_node();
  must("asking for the node id");
  return static_cast<int>(master_.value());
}

void LssSession::configure_node(int node) {
  master_.configure_node(node);
  must(("node id " + std::to_string(node)).c_str());
}

void LssSession::configure_bit_rate(int kbit_s) {
  master_.configure_bit_rate(canopen::lss_bit_rate_index(kbit_s));
  must(("bit rate " + std::to_string(kbit_s) + " kbit/s").c_str());
}

void LssSession::store() {
  master_.store();
  must("storing");
}

void LssSession::wait_all() {
  master_.switch_all(canopen::LssMode::kWaiting);
  CanFrame request;
  while (master_.step(monotonic_us(), request)) bus_.send(&request, 1);
}

std::string identity_text(const canopen::LssIdentity& identity) {
  char text[64];
  std::snprintf(text, sizeof text, "0x%08X:0x%08X:0x%08X:0x%08X", static_cast<unsigned>(identity[0]),
                static_cast<unsigned>(identity[1]), static_cast<unsigned>(identity[2]),
                static_cast<unsigned>(identity[3]));
  return text;
}

std::optional<canopen::LssIdentity> parse_identity(const std::string& text) {
  canopen::LssIdentity identity{};
  const char* at = text.c_str();
  for (std::size_t i = 0; i < identity.size(); ++i) {
    if (*at < '0' || *at > '9') return std::nullopt;
    char* end = nullptr;
    errno = 0;
    const unsigned long long number = std::strtoull(at, &end, 0);
    const char expected = i + 1 < identity.size() ? ':' : '\0';
    if (errno != 0 || number > std::numeric_limits<std::uint32_t>::max() || *end != expected)
      return std::nullopt;
    identity[i] = static_cast<std::uint32_t>(number);
    at = end + 1;
  }
  return identity;
}

}  // namespace sprung

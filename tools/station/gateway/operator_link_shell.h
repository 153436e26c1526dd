#pragma once
/// The operator's end of a conversation with a robot's gateway: begun, and begun anew after a silence; what
/// is said signed and counted, what is told checked. One thread at a time.
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "tools/station/gateway/file_parts.h"
#include "tools/station/gateway/operator_register_shell.h"
#include "tools/station/gateway/packets.h"
#include "tools/station/gateway/replay_window.h"
#include "tools/station/gateway/udp_socket_shell.h"

namespace sprung::gateway {

/// How often an emergency stop is said until somebody answers.
inline constexpr std::int64_t kEstopAgain_us = 20'000;

struct RemoteOptions {
  std::string host;  ///< HOST or HOST:PORT
  std::string key;   ///< file of the operator's key
  bool hidden = false;
};

class OperatorLink {
 public:
  /// Nothing heard for as long: the link is lost.
  static constexpr std::int64_t kLost_us = 500'000;
  /// [design choice] nobody waits longer for an answer.
  static constexpr std::int64_t kGiveUp_us = 10'000'000;

  /// @throws std::runtime_error where the host is not known, or the key cannot be used.
  explicit OperatorLink(const RemoteOptions& options);

  /// @throws std::runtime_error where the gateway does not answer in 10 s, or refuses.
  void open();
  /// A whole file of the robot's, a short one. @throws as fetch_into().
  std::string fetch(const std::string& file);
  /// A file of any length, as it comes. @param assembly of that file. @param take called with each piece, in
  /// order. @throws std::runtime_error where nothing comes for 10 s, or what take() throws; NotRunning where
  /// no robot is up.
  void fetch_into(FileAssembly& assembly, const std::string& file,
                  const std::function<void(const std::string& piece)>& take);

  /// Waits for what is told, at most so long, and says that it is there when that is due.
  void wait_and_hear(int timeout_ms);
  void say(SaidKind kind, const std::string& text, std::int64_t now_us);
  std::deque<Told> take_told() { return std::exchange(told_, {}); }

  /// Ours less the robot's computer's clock; by the quickest datagram.
  std::int64_t offset_us() const noexcept { return offset_us_; }
  /// The time of the robot's run.
  std::int64_t run_us(std::int64_t now_us) const noexcept { return now_us - offset_us_ - epoch_us_; }
  std::int64_t silent_us(std::int64_t now_us) const noexcept { return now_us - heard_us_; }
  const std::string& host() const noexcept { return host_; }

 private:
  OperatorLink(const RemoteOptions& options, const OperatorKeyFile& key);
  void begin_if_due(std::int64_t now_us);
  void hear(std::int64_t now_us);
  void hear_parts(FileAssembly& assembly, const std::string& file);
  void welcome(std::string_view packet, std::int64_t now_us);
  void note_time(std::int64_t time_us, std::int64_t now_us);

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

}  // namespace sprung::gateway

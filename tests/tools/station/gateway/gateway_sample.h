#pragma once
/// An operator and a gate that know each other.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signals/messages.h"
#include "tools/station/gateway/gate.h"

namespace sprung::gateway {

inline SigningKey key_of_number(std::uint8_t number) {
  start_crypto();
  Seed seed{};
  seed.fill(number);
  return SigningKey(seed);
}

inline constexpr std::int64_t kSampleRun = 5;  ///< session of the robot that is up

inline std::string encoded_command(const OperatorCommand& command) {
  sprung_msgs::operator_command_t message;
  to_message(command, kSampleRun, message);
  std::string out(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(out.data(), 0, static_cast<int>(out.size()));
  return out;
}

inline OperatorCommand command_of(OperatorKind kind, std::int64_t request_id = 1) {
  OperatorCommand out;
  out.kind = kind;
  out.request_id = request_id;
  return out;
}

/// One end of a conversation, datagrams by hand.
class SampleOperator {
 public:
  SampleOperator(std::uint8_t own, const PublicKey& robot, bool hidden = false)
      : key_(key_of_number(own)), robot_(robot), exchange_(ExchangeKey::make()), hidden_(hidden) {
    static std::uint8_t conversations = 0;
    nonce_.fill(++conversations);
  }
  const SigningKey& key() const { return key_; }

  std::string hello() const {
    return hello_packet({key_.public_key(), exchange_.public_key(), nonce_, hidden_}, key_, robot_);
  }
  bool welcomed(const Verdict& verdict) {
    if (verdict.packets.empty()) return false;
    const auto welcome = read_welcome(verdict.packets[0].second, robot_, key_.public_key());
    if (!welcome || welcome->session == 0) return false;
    session = welcome->session;
    seal_ = Seal::of_operator(exchange_, welcome->exchange);
    return true;
  }
  std::string says(SaidKind kind, const std::string& text, std::int64_t time_us) {
    return signed_packet({session, ++number, time_us, kind, text}, key_);
  }
  std::string says(OperatorKind kind, std::int64_t time_us) {
    return says(SaidKind::kCommand, encoded_command(command_of(kind, static_cast<std::int64_t>(number + 1))),
                time_us);
  }
  std::optional<Told> hears(const std::string& packet) const { return read_told(packet, *seal_); }

  std::uint64_t session = 0, number = 0;

 private:
  SigningKey key_;
  PublicKey robot_;
  ExchangeKey exchange_;
  std::optional<Seal> seal_;
  Nonce16 nonce_{};
  bool hidden_;
};

}  // namespace sprung::gateway

#pragma once
/// The datagrams between an operator's computer and the robot's gateway: one each, UDP. Pure. All numbers are
/// little-endian; docs/remote.md has the table.
///
///   Hello    operator's: who he is and half of a key, signed for this robot
///   Welcome  robot's: the other half and the conversation's number, signed for this operator; or why not
///   Signed   operator's, in a conversation: counted, with its time, signed
///   Sealed   robot's, in a conversation: counted, with its time, sealed
///
/// Times are the robot's computer's CLOCK_MONOTONIC, us: the operator knows it from what the robot says.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tools/station/gateway/signing.h"

namespace sprung::gateway {

inline constexpr int kDefaultPort = 7447;
inline constexpr std::size_t kLongestRequest = 1200;  ///< what an operator says fits into any network's frame
inline constexpr std::size_t kLongestSealed = 60'000;  ///< joints of a large robot; networks cut it up

using Nonce16 = std::array<std::uint8_t, 16>;

struct Hello {
  PublicKey operator_key{};
  PublicKey exchange{};
  Nonce16 nonce{};
  bool hidden = false;  ///< what the robot says shall be encrypted
};

struct Welcome {
  Nonce16 nonce{};            ///< of the hello
  std::uint64_t session = 0;  ///< 0: refused
  PublicKey exchange{};
  std::int64_t time_us = 0;
  std::int64_t epoch_us = 0;  ///< when the robot's session began, by the same clock; 0: no robot is up
  std::string refusal;        ///< empty: welcome
};

/// What an operator says.
enum class SaidKind : std::uint8_t {
  kAlive = 0,     ///< nothing: the link is there
  kCommand = 1,   ///< an encoded OPERATOR_COMMAND
  kHandOver = 2,  ///< name of the operator who is to drive
  kFile = 3,      ///< a part of a file (file_parts.h)
  kBye = 4,       ///< the conversation is over
};

struct Said {
  std::uint64_t session = 0;
  std::uint64_t number = 0;  ///< from 1, one more each time
  std::int64_t time_us = 0;
  SaidKind kind = SaidKind::kAlive;
  std::string text;
};

/// What a robot says.
enum class ToldKind : std::uint8_t {
  kMessage = 0,  ///< channel's name, a zero byte, the encoded message
  kPart = 1,     ///< of a file (file_parts.h)
  kNews = 2,     ///< JSON: who drives, what this operator may do
};

struct Told {
  std::uint64_t session = 0;
  std::uint64_t number = 0;
  std::int64_t time_us = 0;
  ToldKind kind = ToldKind::kMessage;
  std::string text;
};

enum class PacketKind : std::uint8_t { kNone = 0, kHello = 1, kWelcome = 2, kSigned = 3, kSealed = 4 };
/// By its first bytes; kNone: not ours.
PacketKind kind_of(std::string_view packet) noexcept;

std::string hello_packet(const Hello& hello, const SigningKey& by, const PublicKey& robot);
/// Its content, not checked: who says it is needed for that.
std::optional<Hello> read_hello(std::string_view packet);
bool hello_is_genuine(std::string_view packet, const PublicKey& by, const PublicKey& robot);

std::string welcome_packet(const Welcome& welcome, const SigningKey& by, const PublicKey& operator_key);
/// nullopt: malformed, or not said by this robot to this operator.
std::optional<Welcome> read_welcome(std::string_view packet, const PublicKey& robot,
                                    const PublicKey& operator_key);

std::string signed_packet(const Said& said, const SigningKey& by);
std::optional<Said> read_said(std::string_view packet);
bool said_is_genuine(std::string_view packet, const PublicKey& by);

std::string sealed_packet(const Told& told, const Seal& seal, bool hidden);
/// Number of the conversation, without a key; 0: malformed.
std::uint64_t sealed_session(std::string_view packet) noexcept;
std::optional<Told> read_told(std::string_view packet, const Seal& seal);

}  // namespace sprung::gateway

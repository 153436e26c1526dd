#pragma once
/// What of an operator's datagrams may reach a robot: the gateway without its sockets. Pure; times are the
/// robot's computer's, us.
///
/// A datagram is let in when its conversation is open, its number is new, its time is of now, its signature
/// is right and its sender's rate is kept, looked at in this order; a command when it is for the run that is
/// up, its sender's role may say it, and it is his to drive. Who moves the robot first while nobody drives,
/// drives; from then on he may hand it over. Everybody may stop it in an emergency, and whoever may drive may
/// say `stop`.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signals/operator.h"
#include "tools/station/gateway/known_operators.h"
#include "tools/station/gateway/packets.h"
#include "tools/station/gateway/replay_window.h"
#include "tools/station/gateway/token_bucket.h"

namespace sprung::gateway {

/// Why a datagram, or the command in it, went no further.
enum class Turned : std::uint8_t {
  kNone = 0,
  kMalformed,
  kUnknown,  ///< no such operator, or no such conversation
  kRevoked,
  kTooMany,
  kReplayed,
  kLate,  ///< or too early
  kForged,
  kRole,       ///< it may not be said in this role
  kNotDriver,  ///< somebody else drives
  kOtherRun,   ///< no robot is up, or it was started anew since the operator's end has begun
};
constexpr auto words_of(Turned) {
  using E = Turned;
  return words<E>({{E::kNone, "let in"},
                   {E::kMalformed, "malformed"},
                   {E::kUnknown, "unknown"},
                   {E::kRevoked, "revoked"},
                   {E::kTooMany, "too many"},
                   {E::kReplayed, "replayed"},
                   {E::kLate, "late"},
                   {E::kForged, "forged"},
                   {E::kRole, "not in this role"},
                   {E::kNotDriver, "not the driver"},
                   {E::kOtherRun, "for another run"}});
}

/// Lowest role that may say it.
Role role_for(OperatorKind kind) noexcept;

/// Where a datagram came from and an answer goes: the socket's address, as bytes.
using Address = std::string;

/// Of a request at this time of the robot's session: later ones are greater (lcmtypes/operator.lcm).
constexpr std::int64_t request_id_at(std::int64_t session_us) noexcept { return 1024 * session_us; }

/// What is to be done.
struct Verdict {
  Turned turned = Turned::kNone;
  std::string who;                                       ///< operator's name; empty: a stranger
  std::vector<std::pair<Address, std::string>> packets;  ///< to be sent
  std::optional<OperatorCommand> command;                ///< to be said to the robot
  std::string event;       ///< for the audit log, of what was let in; empty: nothing worth saying
  std::string part_asked;  ///< of a file, by this session
  std::uint64_t session = 0;
};

class Gate {
 public:
  /// [design choice] of a command's time against ours: 100 ms of delay, as much of jitter, a gap's length
  /// less than what would be old.
  static constexpr std::int64_t kOldest_us = 1'000'000, kMostAhead_us = 250'000;
  /// Nothing heard for as long while the robot moves: the link is lost. With the gait's last steps, and
  /// rising to the stand, the robot stands within 2 s. An operator says something every 20 ms: with 100 ms of
  /// jitter seven in a row must be lost.
  static constexpr std::int64_t kLost_us = 250'000;
  /// Nothing heard for as long: the conversation is over, and so is driving, once the robot does not move.
  static constexpr std::int64_t kOver_us = 10'000'000;
  static constexpr std::size_t kMostSessions = 32;
  /// Of one conversation: an emergency stop said 50 times a second, and parts of files.
  static constexpr double kMostEachSecond = 500.0;

  Gate(const SigningKey& own, std::vector<KnownOperator> operators);

  /// The register has changed. Conversations of who is revoked are over.
  void know(std::vector<KnownOperator> operators);

  /// @param session, random: of a conversation that may begin now.
  Verdict take(const Address& from, std::string_view packet, std::int64_t now_us, std::uint64_t session);

  /// The run that is up: its random session, and when it began, us. Commands of another session are refused,
  /// but for an emergency stop.
  void robot_is_up(std::int64_t run, std::int64_t epoch_us) noexcept;
  void robot_is_down() noexcept { robot_is_up(0, 0); }

  /// Who the robot moves for has not been heard: `stop` is to be said. To be asked every 50 ms.
  /// @param moves the robot walks, complies or jumps.
  bool link_is_lost(bool moves, std::int64_t now_us);
  /// Ends what is long silent. @return names of those who drive no more.
  std::vector<std::string> tidy(bool moves, std::int64_t now_us);

  const std::string& driver() const noexcept { return driver_; }  ///< empty: nobody
  std::vector<std::uint64_t> sessions() const;
  /// A packet of an open conversation. @return address and bytes; nothing where it is over.
  std::optional<std::pair<Address, std::string>> tell(std::uint64_t session, ToldKind kind, std::string text,
                                                      std::int64_t now_us);
  /// Who drives, and what this operator may: JSON.
  std::string news(std::uint64_t session) const;
  const std::map<Turned, std::int64_t>& counts() const noexcept { return counts_; }

 private:
  struct Session {
    explicit Session(const Seal& closed) : seal(closed) {}
    PublicKey key{};
    std::string name;
    Role role = Role::kWatch;
    Address address;
    Seal seal;
    bool hidden = false;
    Nonce16 nonce{};
    std::string welcome;  ///< said again where it was lost
    ReplayWindow seen;
    TokenBucket rate{kMostEachSecond, kMostEachSecond};
    std::uint64_t told = 0;
    std::int64_t heard_us = 0;
    std::int64_t request = 0;  ///< the last one that was let in; it is said again and again
    bool spoke = false;        ///< said something signed: its address is genuine
  };
  Verdict hello(const Address& from, std::string_view packet, std::int64_t now_us, std::uint64_t session);
  Verdict said(const Address& from, std::string_view packet, std::int64_t now_us);
  Verdict command(Session& session, std::uint64_t id, const Said& said, std::int64_t now_us);
  /// What an operator's command says, and for which run.
  struct Asked {
    OperatorCommand command;
    std::int64_t run = 0;
  };
  static std::optional<Asked> decoded(const std::string& text);
  Turned may_say(const Session& session, const Asked& asked) const;
  Verdict hand_over(Session& session, const std::string& to, std::int64_t now_us);
  Verdict refused_command(std::uint64_t id, const OperatorCommand& command, Turned why, std::int64_t now_us);
  Verdict turned(Turned why, std::string who);
  const KnownOperator* known(const PublicKey& key) const;
  bool heard_of(const std::string& name, std::int64_t since_us) const;
  void make_room();
  bool is_ahead(const OperatorCommand& command, std::int64_t now_us) const noexcept;
  bool is_over(const OperatorCommand& command) const;
  void note_stop(const OperatorCommand& command);
  void note_motion(const Session& session, const OperatorCommand& command, std::int64_t now_us);

  SigningKey own_;
  std::vector<KnownOperator> operators_;
  std::map<std::uint64_t, Session> sessions_;
  TokenBucket hellos_;
  std::string driver_;
  std::int64_t driver_heard_us_ = 0;
  std::string mover_;            ///< whose command moves the robot
  std::int64_t moved_us_ = 0;    ///< when he said it
  bool ends_by_itself_ = false;  ///< what he asked for
  bool left_ = false;            ///< he said goodbye since
  /// Emergency stops that were let in, said again and again: those before a `clear` are over, and a copy that
  /// comes late would stop the robot once more.
  static constexpr std::size_t kRemembered = 16;
  std::vector<std::int64_t> stops_, stops_over_;
  std::int64_t run_ = 0;  ///< session of the robot that is up; 0: none
  std::int64_t epoch_us_ = 0;
  std::map<Turned, std::int64_t> counts_;
};

}  // namespace sprung::gateway

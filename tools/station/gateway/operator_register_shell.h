#pragma once
/// Who may command a robot from elsewhere, as a file on the robot: names, public keys, roles. What belongs to
/// an operator, his secret, is a file on his own computer. Reads and writes files, but for parse and text.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "signals/enumeration.h"
#include "tools/station/gateway/signing.h"

namespace sprung::gateway {

/// Each may what the one before may.
enum class Role : std::uint8_t {
  kWatch = 0,     ///< look, and stop the robot in an emergency
  kDrive = 1,     ///< and move it: stand, sit, walk, jump, comply, clear
  kMaintain = 2,  ///< and what a workshop does: home, move single joints, hold in maintenance
};
constexpr auto words_of(Role) {
  using E = Role;
  return words<E>({{E::kWatch, "watch"}, {E::kDrive, "drive"}, {E::kMaintain, "maintain"}});
}

struct KnownOperator {
  std::string name;
  PublicKey key{};
  Role role = Role::kWatch;
  std::string made;     ///< UTC
  std::string revoked;  ///< UTC; empty: it holds
};

/// operators.json in the state folder (runtime/private_file.h). @throws std::runtime_error where there is
/// none.
std::string register_path();
/// @throws std::runtime_error naming file and remedy where it is malformed, or others may write it.
std::vector<KnownOperator> read_register(const std::string& path);
/// Written whole or not at all, for its owner alone. @throws std::runtime_error
void write_register(const std::string& path, const std::vector<KnownOperator>& operators);

/// @throws std::runtime_error on what is none.
std::vector<KnownOperator> parse_register(std::string_view text, const std::string& path);
std::string register_text(const std::vector<KnownOperator>& operators);

/// The robot's own key, made when there is none: gateway.key beside the register. @throws std::runtime_error
/// as read_key_file.
SigningKey robot_key(const std::string& folder);

/// What an operator carries away: his secret, and the robot's public key by which he knows it.
struct OperatorKeyFile {
  std::string name;
  std::string robot;  ///< its name, for people
  Seed seed{};
  PublicKey robot_key{};
};
/// @throws std::runtime_error where it stands already or cannot be written.
void write_operator_key(const std::string& path, const OperatorKeyFile& key);
/// @throws std::runtime_error naming the remedy where it is not there, open to others, or no key.
OperatorKeyFile read_operator_key(const std::string& path);
/// $SPRUNG_OPERATOR_KEY, else ~/.config/sprung/operator.key.
std::string operator_key_path();

}  // namespace sprung::gateway

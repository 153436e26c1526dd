#pragma once
/// Who may command a robot from elsewhere, as a file on the robot. What belongs to an operator, his secret,
/// is a file on his own computer. Reads and writes files.
#include <string>
#include <vector>

#include "runtime/open_file.h"
#include "tools/station/gateway/known_operators.h"

namespace sprung::gateway {

/// operators.json in the state folder (runtime/private_file.h). @throws std::runtime_error where there is
/// none.
std::string register_path();
/// @throws std::runtime_error naming file and remedy where it is malformed, or others may write it.
std::vector<KnownOperator> read_register(const std::string& path);
/// Who reads it to write it again holds this meanwhile, so that no key and no revocation is lost: it waits
/// for the other one. @throws std::runtime_error where the file beside it cannot be made.
class RegisterLock {
 public:
  explicit RegisterLock(const std::string& path);

 private:
  OpenFile file_;  ///< closed, it is free
};
/// Written whole or not at all, for its owner alone. @throws std::runtime_error
void write_register(const std::string& path, const std::vector<KnownOperator>& operators);

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

#pragma once
/// Who may command a robot from elsewhere: names, public keys, roles; and their register as text. Pure.
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

/// @param path stands for the file in messages. @throws std::runtime_error on what is none.
std::vector<KnownOperator> parse_register(std::string_view text, const std::string& path);
std::string register_text(const std::vector<KnownOperator>& operators);

}  // namespace sprung::gateway

#pragma once
/// Who says something over a network that nobody guards: Ed25519 signatures of operators and robots, and keys
/// that one conversation agrees on (X25519, libsodium's crypto_kx). Secrets are wiped when their object ends.
/// Pure, but for make_*(), which take the kernel's random numbers.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sprung::gateway {

using PublicKey = std::array<std::uint8_t, 32>;
using Signature = std::array<std::uint8_t, 64>;
using Seed = std::array<std::uint8_t, 32>;

/// To be called once before anything else here. @throws std::runtime_error where libsodium cannot start.
void start_crypto();

class SigningKey {
 public:
  static SigningKey make();
  explicit SigningKey(const Seed& seed) noexcept;
  ~SigningKey();
  SigningKey(const SigningKey&) = default;
  SigningKey& operator=(const SigningKey&) = default;

  const PublicKey& public_key() const noexcept { return public_; }
  Seed seed() const noexcept;
  /// Of `said`; `purpose` keeps what is signed for one thing from being used for another.
  Signature sign(std::string_view purpose, std::string_view said) const;

 private:
  std::array<std::uint8_t, 64> secret_{};
  PublicKey public_{};
};

bool is_signed(const PublicKey& by, std::string_view purpose, std::string_view said,
               const Signature& signature);

/// One end's half of a conversation's keys, fresh for each.
class ExchangeKey {
 public:
  static ExchangeKey make();
  ~ExchangeKey();
  ExchangeKey(const ExchangeKey&) = default;
  ExchangeKey& operator=(const ExchangeKey&) = default;
  const PublicKey& public_key() const noexcept { return public_; }

 private:
  ExchangeKey() = default;
  friend class Seal;
  PublicKey public_{};
  std::array<std::uint8_t, 32> secret_{};
};

/// What the robot says in one conversation, sealed (XChaCha20-Poly1305): nobody else can have said it, and
/// where it is hidden nobody else can read it.
class Seal {
 public:
  static constexpr std::size_t kTagBytes = 16;
  /// The robot's end. @throws std::runtime_error on a public key that is none.
  static Seal of_robot(const ExchangeKey& own, const PublicKey& operators);
  static Seal of_operator(const ExchangeKey& own, const PublicKey& robots);
  ~Seal();
  Seal(const Seal&) = default;
  Seal& operator=(const Seal&) = default;

  /// @param number a different one for each text. @param hidden else it can be read on the way.
  std::string close(std::string_view text, std::uint64_t number, bool hidden) const;
  /// @return whether it is genuine; then `text` is what was said.
  bool open(std::string_view sealed, std::uint64_t number, bool hidden, std::string& text) const;

 private:
  Seal() = default;
  std::array<std::uint8_t, 32> key_{};
};

/// In hexadecimal digits, and back; false on anything else.
std::string to_hex(const PublicKey& bytes);
bool from_hex(std::string_view text, PublicKey& bytes);
/// What people compare and logs name: the first eight digits.
std::string short_name(const PublicKey& key);

}  // namespace sprung::gateway

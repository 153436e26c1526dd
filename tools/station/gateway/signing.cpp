#include "tools/station/gateway/signing.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

namespace sprung::gateway {
namespace {

const std::uint8_t* bytes(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}
std::uint8_t* bytes(std::string& text) { return reinterpret_cast<std::uint8_t*>(text.data()); }

std::string with_purpose(std::string_view purpose, std::string_view said) {
  std::string out(purpose);
  out += '\0';
  out += said;
  return out;
}

using Nonce = std::array<std::uint8_t, crypto_aead_xchacha20poly1305_ietf_NPUBBYTES>;

Nonce nonce_of(std::uint64_t number) {
  Nonce out{};
  for (std::size_t i = 0; i < sizeof number; ++i) out[i] = static_cast<std::uint8_t>(number >> (8 * i));
  return out;
}

}  // namespace

void start_crypto() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot start: has this system random numbers?");
}

SigningKey SigningKey::make() {
  Seed seed{};
  randombytes_buf(seed.data(), seed.size());
  SigningKey out(seed);
  sodium_memzero(seed.data(), seed.size());
  return out;
}

SigningKey::SigningKey(const Seed& seed) noexcept {
  crypto_sign_seed_keypair(public_.data(), secret_.data(), seed.data());
}

SigningKey::~SigningKey() { sodium_memzero(secret_.data(), secret_.size()); }

Seed SigningKey::seed() const noexcept {
  Seed out{};
  crypto_sign_ed25519_sk_to_seed(out.data(), secret_.data());
  return out;
}

Signature SigningKey::sign(std::string_view purpose, std::string_view said) const {
  const std::string all = with_purpose(purpose, said);
  Signature out{};
  crypto_sign_detached(out.data(), nullptr, bytes(std::string_view(all)), all.size(), secret_.data());
  return out;
}

bool is_signed(const PublicKey& by, std::string_view purpose, std::string_view said,
               const Signature& signature) {
  const std::string all = with_purpose(purpose, said);
  return crypto_sign_verify_detached(signature.data(), bytes(std::string_view(all)), all.size(), by.data()) ==
         0;
}

ExchangeKey ExchangeKey::make() {
  ExchangeKey out;
  crypto_kx_keypair(out.public_.data(), out.secret_.data());
  return out;
}

ExchangeKey::~ExchangeKey() { sodium_memzero(secret_.data(), secret_.size()); }

Seal Seal::of_robot(const ExchangeKey& own, const PublicKey& operators) {
  Seal out;
  // Only the robot seals; what the operator says is signed.
  if (crypto_kx_server_session_keys(nullptr, out.key_.data(), own.public_.data(), own.secret_.data(),
                                    operators.data()) != 0)
    throw std::runtime_error("that exchange key is none");
  return out;
}

Seal Seal::of_operator(const ExchangeKey& own, const PublicKey& robots) {
  Seal out;
  if (crypto_kx_client_session_keys(out.key_.data(), nullptr, own.public_.data(), own.secret_.data(),
                                    robots.data()) != 0)
    throw std::runtime_error("that exchange key is none");
  return out;
}

Seal::~Seal() { sodium_memzero(key_.data(), key_.size()); }

std::string Seal::close(std::string_view text, std::uint64_t number, bool hidden) const {
  const Nonce nonce = nonce_of(number);
  std::string out(hidden ? text.size() : 0, '\0');
  out.resize(out.size() + kTagBytes);
  const std::string_view secret = hidden ? text : std::string_view(),
                         open = hidden ? std::string_view() : text;
  crypto_aead_xchacha20poly1305_ietf_encrypt(bytes(out), nullptr, bytes(secret), secret.size(), bytes(open),
                                             open.size(), nullptr, nonce.data(), key_.data());
  return hidden ? out : std::string(text) + out;
}

bool Seal::open(std::string_view sealed, std::uint64_t number, bool hidden, std::string& text) const {
  if (sealed.size() < kTagBytes) return false;
  const Nonce nonce = nonce_of(number);
  const std::size_t length = sealed.size() - kTagBytes;
  text.assign(hidden ? length : 0, '\0');
  const std::string_view tagged = hidden ? sealed : sealed.substr(length);
  const std::string_view read = hidden ? std::string_view() : sealed.substr(0, length);
  if (crypto_aead_xchacha20poly1305_ietf_decrypt(bytes(text), nullptr, nullptr, bytes(tagged), tagged.size(),
                                                 bytes(read), read.size(), nonce.data(), key_.data()) != 0)
    return false;
  if (!hidden) text = read;
  return true;
}

std::string to_hex(const PublicKey& key) {
  std::string out(2 * key.size() + 1, '\0');
  sodium_bin2hex(out.data(), out.size(), key.data(), key.size());
  out.pop_back();
  return out;
}

bool from_hex(std::string_view text, PublicKey& key) {
  std::size_t length = 0;
  return text.size() == 2 * key.size() &&
         sodium_hex2bin(key.data(), key.size(), text.data(), text.size(), nullptr, &length, nullptr) == 0 &&
         length == key.size();
}

std::string short_name(const PublicKey& key) { return to_hex(key).substr(0, 8); }

}  // namespace sprung::gateway

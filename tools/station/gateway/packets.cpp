#include "tools/station/gateway/packets.h"

#include <algorithm>

namespace sprung::gateway {
namespace {

constexpr std::string_view kMagic = "SPG1";
constexpr std::size_t kHeader = 5;
constexpr std::string_view kHelloPurpose = "sprung hello 1", kWelcomePurpose = "sprung welcome 1",
                           kSaidPurpose = "sprung said 1";

/// Appends.
class Writer {
 public:
  explicit Writer(PacketKind kind) : out_(kMagic) { out_ += static_cast<char>(kind); }
  template <std::size_t N>
  Writer& bytes(const std::array<std::uint8_t, N>& value) {
    out_.append(reinterpret_cast<const char*>(value.data()), N);
    return *this;
  }
  Writer& number(std::uint64_t value) {
    for (int i = 0; i < 8; ++i) out_ += static_cast<char>(value >> (8 * i));
    return *this;
  }
  Writer& byte(std::uint8_t value) {
    out_ += static_cast<char>(value);
    return *this;
  }
  Writer& text(std::string_view value) {
    out_ += value;
    return *this;
  }
  std::string& out() { return out_; }

 private:
  std::string out_;
};

/// Takes from the front; good() is false once there was too little.
class Reader {
 public:
  explicit Reader(std::string_view packet) : left_(packet) { skip(kHeader); }
  template <std::size_t N>
  void bytes(std::array<std::uint8_t, N>& out) {
    const std::string_view in = take(N);
    std::copy(in.begin(), in.end(), reinterpret_cast<char*>(out.data()));
  }
  std::uint64_t number() {
    std::uint64_t out = 0;
    const std::string_view in = take(8);
    for (std::size_t i = 0; i < in.size(); ++i)
      out |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(in[i])) << (8 * i);
    return out;
  }
  std::uint8_t byte() {
    const std::string_view in = take(1);
    return in.empty() ? 0 : static_cast<std::uint8_t>(in[0]);
  }
  std::string_view rest() { return take(left_.size()); }
  void skip(std::size_t count) { take(count); }
  bool good() const noexcept { return good_; }

 private:
  std::string_view take(std::size_t count) {
    good_ = good_ && count <= left_.size();
    if (!good_) return {};
    const std::string_view out = left_.substr(0, count);
    left_.remove_prefix(count);
    return out;
  }
  std::string_view left_;
  bool good_ = true;
};

constexpr std::size_t kSignatureBytes = sizeof(Signature);

std::string_view without_signature(std::string_view packet) {
  return packet.substr(0, packet.size() - kSignatureBytes);
}

Signature signature_of(std::string_view packet) {
  Signature out{};
  const std::string_view end = packet.substr(packet.size() - kSignatureBytes);
  std::copy(end.begin(), end.end(), reinterpret_cast<char*>(out.data()));
  return out;
}

std::string signed_by(std::string packet, const SigningKey& by, std::string_view purpose,
                      const PublicKey& to) {
  const Signature signature = by.sign(purpose, packet + to_hex(to));
  packet.append(reinterpret_cast<const char*>(signature.data()), signature.size());
  return packet;
}

bool is_signed_by(std::string_view packet, const PublicKey& by, std::string_view purpose,
                  const PublicKey& to) {
  return is_signed(by, purpose, std::string(without_signature(packet)) + to_hex(to), signature_of(packet));
}

bool long_enough(std::string_view packet, PacketKind kind) {
  return kind_of(packet) == kind && packet.size() >= kHeader + kSignatureBytes;
}

constexpr std::uint8_t kHidden = 1;
constexpr std::size_t kSealedHeader = kHeader + 8 + 8 + 1;

}  // namespace

PacketKind kind_of(std::string_view packet) noexcept {
  if (packet.size() < kHeader || packet.substr(0, kMagic.size()) != kMagic) return PacketKind::kNone;
  const auto kind = static_cast<std::uint8_t>(packet[kMagic.size()]);
  return kind <= static_cast<std::uint8_t>(PacketKind::kSealed) ? static_cast<PacketKind>(kind)
                                                                : PacketKind::kNone;
}

std::string hello_packet(const Hello& hello, const SigningKey& by, const PublicKey& robot) {
  Writer out(PacketKind::kHello);
  out.byte(hello.hidden ? kHidden : 0).bytes(hello.operator_key).bytes(hello.exchange).bytes(hello.nonce);
  return signed_by(out.out(), by, kHelloPurpose, robot);
}

std::optional<Hello> read_hello(std::string_view packet) {
  if (!long_enough(packet, PacketKind::kHello)) return std::nullopt;
  Hello out;
  Reader in(without_signature(packet));
  out.hidden = (in.byte() & kHidden) != 0;
  in.bytes(out.operator_key);
  in.bytes(out.exchange);
  in.bytes(out.nonce);
  if (!in.good() || !in.rest().empty()) return std::nullopt;
  return out;
}

bool hello_is_genuine(std::string_view packet, const PublicKey& by, const PublicKey& robot) {
  return long_enough(packet, PacketKind::kHello) && is_signed_by(packet, by, kHelloPurpose, robot);
}

std::string welcome_packet(const Welcome& welcome, const SigningKey& by, const PublicKey& operator_key) {
  Writer out(PacketKind::kWelcome);
  out.bytes(welcome.nonce)
      .number(welcome.session)
      .bytes(welcome.exchange)
      .number(static_cast<std::uint64_t>(welcome.time_us))
      .number(static_cast<std::uint64_t>(welcome.epoch_us))
      .text(welcome.refusal);
  return signed_by(out.out(), by, kWelcomePurpose, operator_key);
}

std::optional<Welcome> read_welcome(std::string_view packet, const PublicKey& robot,
                                    const PublicKey& operator_key) {
  if (!long_enough(packet, PacketKind::kWelcome) ||
      !is_signed_by(packet, robot, kWelcomePurpose, operator_key))
    return std::nullopt;
  Welcome out;
  Reader in(without_signature(packet));
  in.bytes(out.nonce);
  out.session = in.number();
  in.bytes(out.exchange);
  out.time_us = static_cast<std::int64_t>(in.number());
  out.epoch_us = static_cast<std::int64_t>(in.number());
  if (!in.good()) return std::nullopt;
  out.refusal = in.rest();
  return out;
}

std::string signed_packet(const Said& said, const SigningKey& by) {
  Writer out(PacketKind::kSigned);
  out.number(said.session)
      .number(said.number)
      .number(static_cast<std::uint64_t>(said.time_us))
      .byte(static_cast<std::uint8_t>(said.kind))
      .text(said.text);
  return signed_by(out.out(), by, kSaidPurpose, by.public_key());
}

std::optional<Said> read_said(std::string_view packet) {
  if (!long_enough(packet, PacketKind::kSigned) || packet.size() > kLongestRequest) return std::nullopt;
  Said out;
  Reader in(without_signature(packet));
  out.session = in.number();
  out.number = in.number();
  out.time_us = static_cast<std::int64_t>(in.number());
  const std::uint8_t kind = in.byte();
  if (!in.good() || kind > static_cast<std::uint8_t>(SaidKind::kBye)) return std::nullopt;
  out.kind = static_cast<SaidKind>(kind);
  out.text = in.rest();
  return out;
}

bool said_is_genuine(std::string_view packet, const PublicKey& by) {
  return long_enough(packet, PacketKind::kSigned) && is_signed_by(packet, by, kSaidPurpose, by);
}

std::string sealed_packet(const Told& told, const Seal& seal, bool hidden) {
  Writer body(PacketKind::kSealed);
  body.number(told.session).number(told.number).number(static_cast<std::uint64_t>(told.time_us));
  body.byte(static_cast<std::uint8_t>(told.kind)).text(told.text);
  Writer out(PacketKind::kSealed);
  out.number(told.session).number(told.number).byte(hidden ? kHidden : 0);
  out.text(seal.close(body.out(), told.number, hidden));
  return out.out();
}

std::uint64_t sealed_session(std::string_view packet) noexcept {
  if (kind_of(packet) != PacketKind::kSealed || packet.size() < kSealedHeader) return 0;
  return Reader(packet).number();
}

std::optional<Told> read_told(std::string_view packet, const Seal& seal) {
  if (sealed_session(packet) == 0) return std::nullopt;
  Reader header(packet);
  const std::uint64_t session = header.number(), number = header.number();
  const std::uint8_t flags = header.byte();
  const bool hidden = flags == kHidden;
  std::string body;
  if (flags > kHidden || !seal.open(header.rest(), number, hidden, body)) return std::nullopt;
  Told out;
  Reader in(body);
  out.session = in.number();
  out.number = in.number();
  out.time_us = static_cast<std::int64_t>(in.number());
  const std::uint8_t kind = in.byte();
  if (!in.good() || out.session != session || out.number != number ||
      kind > static_cast<std::uint8_t>(ToldKind::kNews))
    return std::nullopt;
  out.kind = static_cast<ToldKind>(kind);
  out.text = in.rest();
  return out;
}

}  // namespace sprung::gateway

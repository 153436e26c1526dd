#pragma once
/// Who may talk to the server of a page: it listens on this machine's own addresses, but any page that a
/// browser has open, and any user of this machine, can reach these. Pure.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "signals/enumeration.h"

namespace sprung::station {

enum class Admission : std::uint8_t {
  kAdmitted,
  kForeignHost,    ///< the name that was typed is not this machine's: DNS rebinding
  kForeignOrigin,  ///< a page from elsewhere asks
  kWrongToken,     ///< the path does not begin with the token
};
constexpr auto words_of(Admission) {
  using E = Admission;
  return words<E>({{E::kAdmitted, "admitted"},
                   {E::kForeignHost, "refused: the Host header is not localhost, 127.0.0.1 or [::1]"},
                   {E::kForeignOrigin, "refused: a page of another origin asks"},
                   {E::kWrongToken, "refused: the address lacks the token that the command has printed"}});
}

/// Of an HTTP request, or of the one that becomes a WebSocket.
struct WebRequest {
  std::string_view host;    ///< header; "127.0.0.1:8137"
  std::string_view origin;  ///< header; empty where there is none, as of programs and typed addresses
  std::string_view path;    ///< "/TOKEN/main.js"
};

class Doorkeeper {
 public:
  /// @param token not empty; what every path begins with. @param other_origins of pages from elsewhere that
  /// may connect too: "https://app.foxglove.dev".
  explicit Doorkeeper(std::string token, std::vector<std::string> other_origins = {});

  Admission judge(const WebRequest& request) const noexcept;
  /// What follows the token: "" or "main.js"; of an admitted request only.
  std::string_view inner_path(std::string_view path) const noexcept;
  const std::string& token() const noexcept { return token_; }

 private:
  std::string token_;
  std::vector<std::string> other_origins_;
};

}  // namespace sprung::station

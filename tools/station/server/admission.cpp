#include "tools/station/server/admission.h"

#include <algorithm>

namespace sprung::station {
namespace {

/// "localhost" of "localhost:8137", "[::1]" of "[::1]:8137".
std::string_view host_name(std::string_view host) noexcept {
  const std::size_t bracket = host.find(']');
  const std::size_t colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
  return host.substr(0, colon);
}

bool is_here(std::string_view host) noexcept {
  const std::string_view name = host_name(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

/// Takes as long whatever differs, so that nobody finds a token byte by byte.
bool same(std::string_view a, std::string_view b) noexcept {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

}  // namespace

Doorkeeper::Doorkeeper(std::string token, std::vector<std::string> other_origins)
    : token_(std::move(token)), other_origins_(std::move(other_origins)) {}

Admission Doorkeeper::judge(const WebRequest& request) const noexcept {
  if (!is_here(request.host)) return Admission::kForeignHost;
  constexpr std::string_view kScheme = "http://";
  const bool own = request.origin.empty() || (request.origin.substr(0, kScheme.size()) == kScheme &&
                                              request.origin.substr(kScheme.size()) == request.host);
  const bool other = std::find(other_origins_.begin(), other_origins_.end(), request.origin) !=
                     other_origins_.end();
  if (!own && !other) return Admission::kForeignOrigin;
  const bool rooted = !request.path.empty() && request.path.front() == '/';
  const std::string_view rest = rooted ? request.path.substr(1) : std::string_view();
  const bool known = same(rest.substr(0, rest.find('/')), token_);
  return known ? Admission::kAdmitted : Admission::kWrongToken;
}

std::string_view Doorkeeper::inner_path(std::string_view path) const noexcept {
  return path.substr(std::min(path.size(), token_.size() + 2));
}

}  // namespace sprung::station

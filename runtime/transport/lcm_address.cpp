#include "runtime/transport/lcm_address.h"

#include <arpa/inet.h>

#include <charconv>
#include <stdexcept>
#include <string_view>

namespace sprung {
namespace {

/// The whole text as a number from `least` to `most`, or -1.
long number_of(std::string_view text, long least, long most) {
  long value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= least && value <= most ? value : -1;
}

std::string_view up_to(std::string_view& rest, char mark) {
  const std::size_t found = rest.find(mark);
  const std::string_view part = rest.substr(0, found);
  rest = found == std::string_view::npos ? std::string_view() : rest.substr(found + 1);
  return part;
}

}  // namespace

LcmAddress LcmAddress::of(const std::string& url) {
  const auto refuse = [&](const std::string& why) {
    return std::invalid_argument("LCM address '" + url + "': " + why +
                                 "; give one like 'udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'");
  };
  constexpr std::string_view kScheme = "udpm://";
  std::string_view rest = url;
  if (rest.substr(0, kScheme.size()) != kScheme) throw refuse("only udpm:// is a network of robots");
  rest.remove_prefix(kScheme.size());
  std::string_view place = up_to(rest, '?');
  LcmAddress out;
  out.group = up_to(place, ':');
  in_addr group{};
  if (inet_pton(AF_INET, out.group.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr)))
    throw refuse("'" + out.group + "' is no IPv4 multicast address (224.0.0.0 to 239.255.255.255)");
  const long port = number_of(place, 1, 65'535);
  if (port < 0) throw refuse("'" + std::string(place) + "' is no port (1 to 65535)");
  out.port = static_cast<std::uint16_t>(port);
  while (!rest.empty()) {
    std::string_view option = up_to(rest, '&');
    const std::string name(up_to(option, '='));
    if (name == "interface" && !option.empty()) {
      out.interface = option;
      continue;
    }
    const long value = number_of(option, 0, name == "ttl" ? 255 : 1 << 30);
    if ((name != "ttl" && name != "recv_buf_size") || value < 0)
      throw refuse("'" + name + "=" + std::string(option) +
                   "' is none of ttl=0..255, recv_buf_size=BYTES and interface=NAME");
    (name == "ttl" ? out.ttl : out.receive_buffer_bytes) = static_cast<int>(value);
  }
  return out;
}

std::string LcmAddress::url() const {
  return "udpm://" + group + ":" + std::to_string(port) + "?ttl=" + std::to_string(ttl) +
         (receive_buffer_bytes > 0 ? "&recv_buf_size=" + std::to_string(receive_buffer_bytes) : "");
}

}  // namespace sprung

#pragma once
/// LCM sends to itself, on a port of its own, so that a robot that is up is not disturbed.
#include <string>

#include "tools/operate/doctor/machine_facts.h"

namespace sprung::doctor {

/// @param url of which group, ttl and buffer are taken; @param port instead of the url's. Takes at most a
/// second.
LoopbackFacts probe_loopback(const std::string& url, int port, int messages);

/// The url with another port. An url without one is returned as it is.
std::string with_port(const std::string& url, int port);

}  // namespace sprung::doctor

#pragma once
/// A port of one's own, for LCM networks and `udp:` buses that nobody may meet by chance. Multicast sockets
/// share a port without complaint, so two runs that choose the same number hear each other.

namespace sprung {

/// Another one at every call, until this process ends nobody else's who asks here (or
/// tests/conformance/programs.py), on this machine.
/// @throws std::runtime_error when none is left.
int own_port();

}  // namespace sprung

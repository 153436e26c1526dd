#pragma once
/// How a CAN interface is set up, and what is wrong with that for a robot. Needs `ip` of iproute2, which also
/// sets it up.
#include <optional>
#include <string>
#include <vector>

namespace sprung {

struct InterfaceFacts {
  std::string name;
  std::string kind;   ///< "can" or "vcan"
  std::string state;  ///< of the controller: ERROR-ACTIVE, ERROR-WARNING, ERROR-PASSIVE, BUS-OFF, STOPPED;
                      ///< empty on vcan
  bool up = false;
  int bit_rate = 0;      ///< bit/s; 0 = not set, or vcan
  int restart_ms = 0;    ///< 0 = stays off after bus-off
  int queue_length = 0;  ///< txqueuelen, frames
};

/// What people should know before the robot moves, one sentence each with the command that mends it; nothing
/// when all is well.
/// @param frames_per_cycle that one bus gets at once. A long queue is wrong too: a set-point that waits in it
/// is worse than one that is lost (facts canopen 5). @param bit_rate that the robot asks for, bit/s.
std::vector<std::string> interface_advice(const InterfaceFacts& facts, int frames_per_cycle, int bit_rate);

/// A controller at another rate than its bus disturbs everybody on it, and the bus load was reckoned for the
/// robot's own. A rate that is not known (not set yet, vcan, slcan) is left to interface_advice(). @throws
/// std::invalid_argument when it is another one.
void check_bit_rate(const InterfaceFacts& facts, int bit_rate);

/// What was started with --sim has the watchdogs of a simulation, or is simulated drives: neither may meet
/// real ones. @throws std::invalid_argument when this interface has a controller.
void require_virtual(const InterfaceFacts& facts);

/// @param json of `ip -details -json link show dev NAME`. Nothing when that is no CAN interface.
std::optional<InterfaceFacts> parse_interface(const std::string& json);

/// Its name, of socketcan:INTERFACE and socketcan:INTERFACE?fd=1; "" of other addresses.
std::string interface_of(const std::string& address);

/// @param address of a bus; nothing when it is no socketcan:INTERFACE, or `ip` cannot be had. Starts a
/// process: not for the loop.
std::optional<InterfaceFacts> read_interface(const std::string& address);

}  // namespace sprung

#pragma once
/// Layer setting services in real time: shell around canopen::LssMaster. Sends, waits, and tells what to do
/// when nobody answers or a device refuses.
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/canopen/lss_master.h"

namespace sprung {

/// No answer, or a refusal; what() says of what, why, and what to do.
struct LssFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Every device of the bus is back in waiting mode when a session ends, however it ends.
class LssSession {
 public:
  explicit LssSession(CanBus& bus) : bus_(bus) { wait_all(); }
  ~LssSession() { wait_all(); }
  LssSession(const LssSession&) = delete;
  LssSession& operator=(const LssSession&) = delete;

  /// One device that has no node id, which is selected then; nothing where there is none. Three seconds.
  /// @throws LssFailed where one answers and is not there at the end.
  std::optional<canopen::LssIdentity> find_next();
  /// @throws LssFailed where no device has this identity (or it has no LSS).
  void select(const canopen::LssIdentity& identity);
  // Of the device that is selected. @throws LssFailed
  int node();
  void configure_node(int node);
  void configure_bit_rate(int kbit_s);
  void store();
  /// Nobody is selected any more; a device that got its first node id boots.
  void wait_all();

 private:
  canopen::LssStatus run();
  void must(const char* what);

  CanBus& bus_;
  canopen::LssMaster master_;
};

/// "0x000000FB:0x62100000:0x01260000:0x00000001": vendor, product, revision, serial number.
std::string identity_text(const canopen::LssIdentity& identity);
/// The other way; decimal and hexadecimal numbers. Nothing where it is none.
std::optional<canopen::LssIdentity> parse_identity(const std::string& text);

}  // namespace sprung

#pragma once
/// A CANopen device in front of an object dictionary: NMT slave, boot-up, heartbeats both ways and node
/// guarding, SDO server, PDOs, emergencies, stored parameters (CiA 301; facts canopen 1, 4). Stepped by
/// frames and times; no clock, no allocation after construction.
#include <cstdint>

#include "drivers/canopen/protocol.h"
#include "drivers/canopen/sdo_server.h"
#include "simulation/node/error_record.h"
#include "simulation/node/lss_slave.h"
#include "simulation/node/master_watch.h"
#include "simulation/node/pdo_exchange.h"

namespace sprung::sim {

/// What the device asks and tells the application that lives in it.
class DeviceApplication : public WriteListener {
 public:
  /// May this SDO write, in range already, be done now? For rules that hang on other objects or on the
  /// device's state.
  /// @param value of numbers; 0 for texts. @return 0 or an abort code.
  virtual std::uint32_t check_write(canopen::ObjectId /*id*/, std::int64_t /*value*/) noexcept { return 0; }
  /// The same for an SDO read.
  virtual std::uint32_t check_read(canopen::ObjectId /*id*/) noexcept { return 0; }
  /// SYNC in operational, before the PDOs that it makes due: the moment to sample.
  virtual void synced() noexcept {}
  /// Operational was left, or the master or the bus is gone: object 0x6007 says what to do.
  virtual void connection_lost() noexcept = 0;
  /// The cause of a communication error is gone.
  virtual void connection_back() noexcept = 0;
  /// NMT reset node, or power on: all objects have their stored values again.
  virtual void reset() noexcept = 0;
};

/// Where makes differ.
struct DevicePolicy {
  /// Abort code for writes to PDO objects in NMT operational; 0 = they are taken, by CiA 301's rules. An
  /// EPOS2 has 0F00FFC0 for a wrong NMT state; that it uses it here is [U].
  std::uint32_t remap_in_operational = 0;
  /// 8210 counts as a lost connection, and stands until it is cleared; else the next PDO that is long enough
  /// ends it. On an EPOS2 as on an EPOS4 [U] (facts canopen 2.5).
  bool short_pdo_loses_connection = false;
  /// NMT state after a communication error where there is no 0x1029: 0 = pre-operational, 1 = no change, 2 =
  /// stopped.
  int after_communication_error = 1;
  /// TPDOs of types 254 and 255 are sent when their objects change; else by their event timer alone, since
  /// what else makes them due is the maker's own affair (a Gold's 0x2F20).
  bool events_on_change = true;
  bool lss = false;  ///< it gets node id and bit rate by layer setting services (CiA 305)
  /// What the device was delivered with, canopen::kNoNode = none; 0 = the node id of its dictionary.
  int factory_node = 0;
};

class CanopenDevice : private canopen::SdoObjects {
 public:
  /// The references must outlive the device. The first tick sends the boot-up frame, where it has a node id.
  /// @param node 1..127, of the identifiers in the dictionary.
  CanopenDevice(int node, ObjectDictionary& dictionary, DeviceApplication& application, Outbox& outbox,
                const DevicePolicy& policy = {}) noexcept;

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Heartbeats, supervision of the master, event TPDOs, late frames of the outbox. Times must not go back.
  void tick(std::int64_t time_us) noexcept;

  bool operational() const noexcept { return state_ == canopen::NmtState::kOperational; }
  canopen::NmtState state() const noexcept { return state_; }
  int node() const noexcept { return lss_.node(); }  ///< canopen::kNoNode = it has none
  /// Master's heartbeat or guarding lost and not heard again, nor reset.
  bool master_lost() const noexcept { return watch_.lost(); }

  /// An error begins to stand: emergency frame, error register and history; nothing when it stands already.
  /// @param code CiA 301 / 402 error code.
  void raise(std::uint16_t code) noexcept;
  /// An error is over; when it was the last, the emergency that says so.
  void clear(std::uint16_t code) noexcept;
  /// All errors are over.
  void clear_errors() noexcept;
  const ErrorRecord& errors() const noexcept { return errors_; }

  /// Power off and on: stored values, no history; the next tick sends the boot-up frame.
  void power_cycle() noexcept;

 private:
  std::uint32_t read(canopen::ObjectId id, std::uint8_t* bytes, std::size_t capacity,
                     std::size_t& size) noexcept override;
  std::uint32_t write(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size,
                      bool size_told) noexcept override;
  std::uint32_t check_write(canopen::ObjectId id, std::int64_t value) noexcept;
  void after_write(canopen::ObjectId id) noexcept;

  void boot_up() noexcept;
  void take_node() noexcept;
  void receive_lss(const CanFrame& frame) noexcept;
  void nmt(canopen::NmtCommand command) noexcept;
  void enter(canopen::NmtState state) noexcept;
  void restart() noexcept;
  void serve(const CanFrame& frame, std::int64_t time_us) noexcept;
  void answer_guard(std::int64_t time_us) noexcept;
  void sync() noexcept;
  void receive_pdo(const CanFrame& frame) noexcept;
  void follow(MasterWatch::Change change) noexcept;
  void communication_error(std::uint16_t code) noexcept;
  void watch_bus() noexcept;
  void produce_heartbeat(std::int64_t time_us) noexcept;
  void send_emergency(std::uint16_t code) noexcept;

  int node_;  ///< of the identifiers in the dictionary
  ObjectDictionary& dictionary_;
  DeviceApplication& application_;
  Outbox& outbox_;
  DevicePolicy policy_;
  LssSlave lss_;
  PdoExchange pdos_;
  canopen::SdoServer sdo_;
  ErrorRecord errors_;
  MasterWatch watch_;
  canopen::NmtState state_ = canopen::NmtState::kBootUp;
  std::int64_t next_heartbeat_us_ = 0;
  std::uint16_t bus_error_ = 0;  ///< what the CAN controller says
};

}  // namespace sprung::sim

#pragma once
/// A CANopen device in front of an object dictionary: NMT slave, boot-up, heartbeats both ways, SDO server,
/// PDOs, emergencies (CiA 301; facts canopen 1, 4). Stepped by frames and times; no clock, no allocation
/// after construction.
#include <array>
#include <cstdint>

#include "drivers/canopen/protocol.h"
#include "drivers/sim/pdo_exchange.h"

namespace sprung::sim {

/// What the device tells the application that lives in it.
class DeviceApplication : public WriteListener {
 public:
  /// Operational was left, or the master's heartbeat is gone: object 0x6007 says what to do.
  virtual void connection_lost() noexcept = 0;
  /// The cause of a communication error is gone.
  virtual void connection_back() noexcept = 0;
  /// NMT reset node: as after power-on.
  virtual void reset() noexcept = 0;
};

class CanopenDevice {
 public:
  /// The references must outlive the device. The first tick sends the boot-up frame.
  CanopenDevice(int node, ObjectDictionary& dictionary, DeviceApplication& application,
                Outbox& outbox) noexcept;

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Heartbeats, their supervision, and event TPDOs. Times must not go back.
  void tick(std::int64_t time_us) noexcept;

  bool operational() const noexcept { return state_ == canopen::NmtState::kOperational; }
  canopen::NmtState state() const noexcept { return state_; }
  /// Emergency frame, error register and history. @param code CiA 301 / 402 error code, not 0.
  void raise(std::uint16_t code) noexcept;
  /// Error register 0 and, if it was not, the emergency that says so.
  void clear_errors() noexcept;

 private:
  struct Guard {  ///< one entry of 0x1016
    std::int64_t last_us = 0;
    bool heard = false;
    bool lost = false;
  };
  void boot_up() noexcept;
  void nmt(canopen::NmtCommand command) noexcept;
  void enter(canopen::NmtState state) noexcept;
  void serve(const CanFrame& frame) noexcept;
  std::uint32_t write(const canopen::SdoMessage& request) noexcept;
  void after_write(canopen::ObjectId id) noexcept;
  void hear(const CanFrame& frame, std::int64_t time_us) noexcept;
  void produce_heartbeat(std::int64_t time_us) noexcept;
  void supervise(std::int64_t time_us) noexcept;
  void push_history(std::uint16_t code) noexcept;
  void send_emergency(std::uint16_t code) noexcept;

  int node_;
  ObjectDictionary& dictionary_;
  DeviceApplication& application_;
  Outbox& outbox_;
  PdoExchange pdos_;
  canopen::NmtState state_ = canopen::NmtState::kBootUp;
  std::int64_t next_heartbeat_us_ = 0;
  std::array<Guard, 2> guards_{};
};

}  // namespace sprung::sim

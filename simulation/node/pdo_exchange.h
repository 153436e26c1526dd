#pragma once
/// Process data at run time: RPDOs into the dictionary, TPDOs out of it, by SYNC or by event (facts
/// canopen 1.5).
#include <array>
#include <cstdint>

#include "simulation/node/outbox.h"
#include "simulation/node/pdo_map.h"

namespace sprung::sim {

/// Told of every object that the master wrote, by SDO or RPDO.
class WriteListener {
 public:
  virtual ~WriteListener() = default;
  virtual void written(canopen::ObjectId id) noexcept = 0;
};

/// What became of a frame.
enum class PdoReception : std::uint8_t {
  kForeign,   ///< none of this device's PDOs
  kTaken,     ///< one that is too long is taken by its first bytes (CiA 301 leaves it open to complain with
              ///< 8220)
  kTooShort,  ///< not applied; an emergency is due
};

class PdoExchange {
 public:
  /// @param events_on_change see DevicePolicy.
  PdoExchange(ObjectDictionary& dictionary, WriteListener& listener, Outbox& outbox,
              bool events_on_change = true) noexcept;

  /// When the device becomes operational: every PDO begins anew, and every event TPDO is sent once.
  void configure() noexcept;
  /// After a change of this PDO's objects: it alone begins anew.
  void configure(const PdoObject& pdo) noexcept;
  /// Several RPDOs may share an identifier.
  PdoReception receive(const CanFrame& frame) noexcept;
  /// A remote frame: sends the TPDO that it asks for, where that one lets itself be asked for. What is bound
  /// to SYNC says how it was at the last one.
  void answer_remote(const CanFrame& request) noexcept;
  /// Sends what is due by SYNC, then applies what waited for it.
  void sync() noexcept;
  /// Sends event TPDOs that changed or whose timer is up.
  void send_events(std::int64_t time_us) noexcept;

 private:
  struct Receive {
    PdoMap map;
    CanFrame waiting;
    bool has_waiting = false;
  };
  struct Transmit {
    PdoMap map;
    FrameKind kind = FrameKind::kOther;
    CanFrame last;
    bool sent = false;
    CanFrame sampled;  ///< at the last SYNC
    bool has_sampled = false;
    int syncs = 0;
    std::int64_t last_us = 0;
    std::int64_t inhibit_us = 0;
    std::int64_t event_us = 0;  ///< 0 = no timer
  };
  void configure(PdoDirection direction, int n) noexcept;
  void apply(const PdoMap& map, const CanFrame& frame) noexcept;
  CanFrame pack(const PdoMap& map) const noexcept;
  bool due_by_sync(Transmit& pdo, const CanFrame& frame) noexcept;
  void send(Transmit& pdo, const CanFrame& frame) noexcept;

  ObjectDictionary& dictionary_;
  WriteListener& listener_;
  Outbox& outbox_;
  bool events_on_change_;
  std::array<Receive, canopen::kPdoCount> receive_;
  std::array<Transmit, canopen::kPdoCount> transmit_;
};

}  // namespace sprung::sim

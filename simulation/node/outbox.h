#pragma once
/// Where a simulated device puts its frames, and what a bad bus does to them on demand (`sprung fault`).
/// Which frames are hit is a hash of (seed, node, number of the frame): the same in every run, and none of a
/// fault's frames changes another fault's.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/can/can_frame.h"
#include "signals/modes.h"

namespace sprung::sim {

/// What a frame is for; some faults hit only some of them.
enum class FrameKind : std::uint8_t {
  kOther,
  kSample,     ///< TPDO1
  kHeartbeat,  ///< also the answer to node guarding
  kSdo,
};

class Outbox {
 public:
  static constexpr std::size_t kLateCapacity = 256;  ///< more are lost [design choice]

  explicit Outbox(int bus) noexcept : bus_(bus) {}
  /// For the hash of faults; call before the first frame. @param signal number of this node, unique within a
  /// run.
  void set_seed(std::uint64_t seed, std::uint64_t signal) noexcept;

  /// Frames go here from now on; nullptr = they are lost.
  void open(FrameBatch* batch) noexcept { batch_ = batch; }
  /// A cut cable: nothing goes out or comes in.
  void set_cut(bool cut) noexcept { cut_ = cut; }
  bool cut() const noexcept { return cut_ || active(FaultKind::kBusOff) || active(FaultKind::kLinkDown); }

  /// Whether this kind acts on frames, so that it is the outbox's and not the device's.
  static bool handles(FaultKind kind) noexcept;
  /// Starts or ends a fault; kinds that do not act on frames do nothing. @param value as FaultKind says.
  void set_fault(FaultKind kind, double value, bool on) noexcept;
  bool active(FaultKind kind) const noexcept { return faults_[index(kind)].on; }

  void send(const CanFrame& frame, FrameKind kind = FrameKind::kOther) noexcept;
  /// Time goes on: late frames that are due go out. Times must not go back.
  void release(std::int64_t time_us) noexcept;
  /// Whether a frame from the bus gets through to the device; to be asked once for each.
  bool hears() noexcept;

 private:
  static constexpr std::size_t kKinds = 20;  ///< of FaultKind
  struct Fault {
    bool on = false;
    double value = 0.0;
  };
  struct Late {
    std::int64_t time_us = 0;
    CanFrame frame;
  };
  static constexpr std::size_t index(FaultKind kind) noexcept { return static_cast<std::size_t>(kind); }
  std::uint64_t bits(std::uint64_t salt, std::uint64_t number) const noexcept;
  bool hit(FaultKind kind, std::uint64_t number) const noexcept;
  void flip(CanFrame& frame) const noexcept;
  void put(const CanFrame& frame) noexcept;
  void delay(const CanFrame& frame) noexcept;
  void answer_twice(const CanFrame& frame, FrameKind kind) noexcept;

  int bus_;
  bool cut_ = false;
  FrameBatch* batch_ = nullptr;
  std::uint64_t seed_ = 0;
  std::uint64_t sent_ = 0;   ///< number of the next frame out
  std::uint64_t heard_ = 0;  ///< number of the next frame in
  std::int64_t now_us_ = 0;
  std::array<Fault, kKinds> faults_{};
  std::array<Late, kLateCapacity> late_{};  ///< a ring: late_count_ frames from late_first_
  std::size_t late_first_ = 0;
  std::size_t late_count_ = 0;
};

}  // namespace sprung::sim

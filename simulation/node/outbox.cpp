#include "simulation/node/outbox.h"

#include <cmath>

#include "drivers/canopen/nmt.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

/// Keeps the numbers of frames in apart from those of frames out.
constexpr std::uint64_t kIncoming = 1ULL << 63;

}  // namespace

void Outbox::set_seed(std::uint64_t seed, std::uint64_t signal) noexcept {
  seed_ = mix_bits(mix_bits(seed) ^ signal);
}

bool Outbox::handles(FaultKind kind) noexcept {
  switch (kind) {
    case FaultKind::kFramesLost:
    case FaultKind::kFramesLate:
    case FaultKind::kFramesDuplicated:
    case FaultKind::kFramesFlipped:
    case FaultKind::kHeartbeatStopped:
    case FaultKind::kBusOff:
    case FaultKind::kErrorPassive:
    case FaultKind::kDuplicateNode:
    case FaultKind::kShortPdo:
    case FaultKind::kLinkDown:
      return true;
    default:
      return false;
  }
}

void Outbox::set_fault(FaultKind kind, double value, bool on) noexcept {
  if (handles(kind)) faults_[index(kind)] = {on, value};
}

std::uint64_t Outbox::bits(std::uint64_t salt, std::uint64_t number) const noexcept {
  return mix_bits(mix_bits(seed_ ^ salt) ^ number);
}

/// The fault's share of all frames, spread by the hash.
bool Outbox::hit(FaultKind kind, std::uint64_t number) const noexcept {
  if (!active(kind)) return false;
  constexpr double kTwoToMinus53 = 1.0 / 9007199254740992.0;
  return static_cast<double>(bits(index(kind), number) >> 11) * kTwoToMinus53 < faults_[index(kind)].value;
}

void Outbox::flip(CanFrame& frame) const noexcept {
  if (frame.length == 0) return;
  const std::uint64_t bit = (bits(index(FaultKind::kFramesFlipped), sent_) & 0x7FF) %
                            (std::uint64_t{8} * frame.length);
  frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << (bit % 8)));
}

void Outbox::send(const CanFrame& frame, FrameKind kind) noexcept {
  if (kind == FrameKind::kHeartbeat && active(FaultKind::kHeartbeatStopped)) return;
  ++sent_;
  if (cut() || hit(FaultKind::kFramesLost, sent_)) return;
  CanFrame changed = frame;
  if (kind == FrameKind::kSample && active(FaultKind::kShortPdo) && changed.length > 0)
    changed.data[--changed.length] = 0;
  if (hit(FaultKind::kFramesFlipped, sent_)) flip(changed);
  put(changed);
  if (hit(FaultKind::kFramesDuplicated, sent_)) put(changed);
  if (active(FaultKind::kDuplicateNode)) answer_twice(changed, kind);
}

/// A second device with the same node id: it answers SDO as well, it samples something else, and its
/// heartbeat says that nobody started it.
void Outbox::answer_twice(const CanFrame& frame, FrameKind kind) noexcept {
  if (kind == FrameKind::kSdo) return put(frame);
  if (kind == FrameKind::kSample) {
    CanFrame other = frame;
    other.data[0] = static_cast<std::uint8_t>(~other.data[0]);
    return put(other);
  }
  if (kind != FrameKind::kHeartbeat) return;
  const int node = static_cast<int>(frame.id & 0x7F);
  put(canopen::heartbeat_frame(node, canopen::NmtState::kPreOperational));
}

void Outbox::put(const CanFrame& frame) noexcept {
  if (active(FaultKind::kFramesLate)) return delay(frame);
  if (batch_ != nullptr) batch_->push(bus_, frame);
}

void Outbox::delay(const CanFrame& frame) noexcept {
  if (late_count_ == kLateCapacity) return;
  const std::int64_t delay_us = std::llround(1e6 * faults_[index(FaultKind::kFramesLate)].value);
  late_[(late_first_ + late_count_) % kLateCapacity] = {now_us_ + delay_us, frame};
  ++late_count_;
}

void Outbox::release(std::int64_t time_us) noexcept {
  now_us_ = time_us;
  while (late_count_ > 0 && late_[late_first_].time_us <= time_us) {
    if (batch_ != nullptr && !cut()) batch_->push(bus_, late_[late_first_].frame);
    late_first_ = (late_first_ + 1) % kLateCapacity;
    --late_count_;
  }
}

bool Outbox::hears() noexcept {
  ++heard_;
  return !cut() && !hit(FaultKind::kFramesLost, kIncoming | heard_);
}

}  // namespace sprung::sim

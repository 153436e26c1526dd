#include "drivers/bridge/reference_watch.h"

#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {

// [design choice] more than a loaded gear twists, less than half a motor turn at 50:1 (0.063 rad) and 100:1
// tells
constexpr double kApart_rad = 0.05;
constexpr int kApartCycles = 10;

}  // namespace

void ReferenceWatch::set(const Reference& reference) noexcept {
  reference_ = reference;
  loss_ = "";
  apart_ = false;
  cycles_apart_ = 0;
}

void ReferenceWatch::lose(const char* why) noexcept {
  if (reference_.known) loss_ = why;
  reference_.known = false;
}

void ReferenceWatch::doubt() noexcept {
  if (!absolute_encoder_) lose("reference lost: it may have restarted");
}

void ReferenceWatch::compare(double motor_rad, double link_rad) noexcept {
  if (!reference_.known) return;
  const double difference_rad = std::remainder(link_rad - motor_rad, kTurn_rad);
  cycles_apart_ = std::abs(difference_rad) > kApart_rad ? cycles_apart_ + 1 : 0;
  if (cycles_apart_ < kApartCycles) return;
  apart_ = true;
  lose("reference lost: encoders disagree");
}

void ReferenceWatch::show(NodeHealth& out) const noexcept {
  out.reference_offset_rad = reference_.known ? reference_.offset_rad : kNaN;
  out.reference_source = reference_.source;
}

}  // namespace sprung

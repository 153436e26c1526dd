#include "drivers/bridge/encoder_card_node.h"

#include <cmath>

#include "signals/angles.h"

namespace sprung {
EncoderCardNode::EncoderCardNode(const EncoderCardConfig& card, double cycle_s,
                                 const WatchdogConfig& watchdogs)
    : EncoderCardNode(card, watchdogs, make_card_profile(card, timing_of(cycle_s, watchdogs))) {}

EncoderCardNode::EncoderCardNode(const EncoderCardConfig& card, const WatchdogConfig& watchdogs,
                                 std::unique_ptr<CardProfile> profile)
    : BusNode({card.name, card.bus, card.node, -1, watchdogs, card.watch}, card.identity, *profile, false),
      profile_(std::move(profile)) {}

bool EncoderCardNode::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  const NodeEvents events = link().receive(frame, time_us);
  if (events.sample) profile_->decode_sample(frame, sample_);
  return events.expected;
}

void EncoderCardNode::end_sampling() noexcept {
  const bool accepted = link().samples().to_be_judged() && accept_sample();
  link().end_sampling(accepted);
}

/// The counter goes up by one with each sample. Answers that were lost on the bus are counted when they are
/// missed; here are counted those that the card never measured.
bool EncoderCardNode::accept_sample() noexcept {
  const int modulus = profile_->counter_modulus();
  const int steps = (sample_.counter - last_counter_ + modulus) % modulus;
  fresh_ = !counter_known_ || steps != 0;
  if (!fresh_) return false;  // it repeats itself: stuck
  const int expected = link().samples().age_cycles() + 1;
  if (counter_known_ && steps > expected) link().samples().count_missing(steps - expected);
  last_counter_ = sample_.counter;
  counter_known_ = true;
  return true;
}

double EncoderCardNode::measured_link_position_rad(const LinkEncoderConfig& encoder) const noexcept {
  const bool has_channel = encoder.channel >= 0 && encoder.channel < sample_.channels;
  if (!link().samples().answered() || !fresh_ || !has_channel) return kNaN;
  const double counts = sample_.counts[encoder.channel];
  const double turned_rad = encoder.direction * counts * kTurn_rad / encoder.counts_per_turn;
  return std::remainder(turned_rad + encoder.offset_rad, kTurn_rad);
}

void EncoderCardNode::reset_faults(bool reset) noexcept {
  if (reset) link().forget_emergency();
}

void EncoderCardNode::restart() noexcept {
  link().restart();
  fresh_ = counter_known_ = false;
}

}  // namespace sprung

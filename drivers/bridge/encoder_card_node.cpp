#include "drivers/bridge/encoder_card_node.h"

#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {}  // namespace

EncoderCardNode::EncoderCardNode(const EncoderCardConfig& card, double cycle_s,
                                 const WatchdogConfig& watchdogs)
    : EncoderCardNode(
          card, watchdogs,
          make_card_profile(card, {cycle_s, watchdogs.heartbeat_s, watchdogs.heartbeat_consumer_s})) {}

EncoderCardNode::EncoderCardNode(const EncoderCardConfig& card, const WatchdogConfig& watchdogs,
                                 std::unique_ptr<CardProfile> profile)
    : NodeLink({card.name, card.bus, card.node, -1, watchdogs}, card.identity, *profile, false),
      profile_(std::move(profile)) {}

void EncoderCardNode::take_sample(const CanFrame& frame, std::int64_t) noexcept {
  profile_->decode_sample(frame, sample_);
}

/// The counter goes up by one with each sample. Answers that were lost on the bus are counted when they are
/// missed; here are counted those that the card never measured.
bool EncoderCardNode::accept_sample() noexcept {
  const int modulus = profile_->counter_modulus();
  const int steps = (sample_.counter - last_counter_ + modulus) % modulus;
  fresh_ = !counter_known_ || steps != 0;
  if (!fresh_) return false;  // it repeats itself: stuck
  const int expected = age_cycles() + 1;
  if (counter_known_ && steps > expected) count_missing(steps - expected);
  last_counter_ = sample_.counter;
  counter_known_ = true;
  return true;
}

double EncoderCardNode::measured_link_position_rad(const LinkEncoderConfig& encoder) const noexcept {
  const bool has_channel = encoder.channel >= 0 && encoder.channel < sample_.channels;
  if (!answered() || !fresh_ || !has_channel) return kNaN;
  const double counts = sample_.counts[static_cast<std::size_t>(encoder.channel)];
  const double turned_rad = encoder.direction * counts * kTurn_rad / encoder.counts_per_turn;
  return std::remainder(turned_rad + encoder.offset_rad, kTurn_rad);
}

/// A card has no fault reset of its own.
bool EncoderCardNode::needs_restart(std::int64_t time_us) const noexcept {
  return faulted() || NodeLink::needs_restart(time_us);
}

void EncoderCardNode::restart() noexcept {
  NodeLink::restart();
  fresh_ = counter_known_ = false;
}

}  // namespace sprung

#pragma once
/// One encoder card as the bridge sees it: link-side positions of the actuators that name it. Its sample
/// counter shows samples that were lost, or a card that repeats itself. Stepped by time.
#include <memory>

#include "drivers/bridge/bus_node.h"

namespace sprung {

class EncoderCardNode final : public BusNode {
 public:
  EncoderCardNode(const EncoderCardConfig& card, double cycle_s, const WatchdogConfig& watchdogs);

  /// Position at the output, within half a turn of 0, by the actuator's own link encoder settings. NaN unless
  /// this SYNC was answered with a new sample.
  double measured_link_position_rad(const LinkEncoderConfig& encoder) const noexcept;

  int channels() const noexcept { return profile_->channels(); }
  void step(std::int64_t time_us, FrameBatch& out) noexcept override { link().step(time_us, out); }
  bool receive(const CanFrame& frame, std::int64_t time_us) noexcept override;
  void end_sampling() noexcept override;
  bool fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept override {
    return link().fault(time_us, ignore_faults, out);
  }
  NodeCondition condition() const noexcept override { return {link().emergencies().stands(), false, ""}; }
  /// A card has no fault reset of its own: only a restart heals it.
  void reset_faults(bool reset) noexcept override;
  void restart() noexcept override;

 private:
  EncoderCardNode(const EncoderCardConfig& card, const WatchdogConfig& watchdogs,
                  std::unique_ptr<CardProfile> profile);
  bool accept_sample() noexcept;

  std::unique_ptr<CardProfile> profile_;
  CardSample sample_;
  bool fresh_ = false;          ///< accepted in this cycle
  bool counter_known_ = false;  ///< of an accepted sample
  std::uint8_t last_counter_ = 0;
};

}  // namespace sprung

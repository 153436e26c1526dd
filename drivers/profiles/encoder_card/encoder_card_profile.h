#pragma once
/// Card that reads three absolute 20-bit encoders on the link side of gears (design section 2): one 64-bit
/// object in one PDO at every SYNC. Layout in encoder_card_layout.h. What a real card does is [unverified]:
/// facts canopen section 9.
#include "drivers/profiles/drive_profile.h"

namespace sprung::encoder_card {

class EncoderCardProfile final : public CardProfile {
 public:
  /// @throws std::invalid_argument on heartbeat times that the card's objects cannot hold.
  EncoderCardProfile(const EncoderCardConfig& card, const DriveTiming& timing);

  std::vector<DriveSetting> settings() const override;
  std::vector<PdoSetting> pdos() const override;
  bool decode_sample(const CanFrame& frame, CardSample& sample) const noexcept override;
  int channels() const noexcept override;
  int counter_modulus() const noexcept override;

 private:
  EncoderCardConfig card_;
  DriveTiming timing_;
};

}  // namespace sprung::encoder_card

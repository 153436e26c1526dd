#include "drivers/profiles/encoder_card/encoder_card_profile.h"

#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "drivers/profiles/profile_registry.h"
#include "drivers/profiles/profile_values.h"
#include "sprung_embedded/encoder_card_eds_extra_text.h"
#include "sprung_embedded/encoder_card_eds_text.h"

namespace sprung::encoder_card {
namespace {

using namespace sprung::profiles;

constexpr std::uint16_t kSampleObject = 0x2100;  ///< u64, the packed sample
constexpr int kSamplePdo = 0;                    ///< the card's only one
static_assert(kChannels <= CardSample::kMaxChannels);

std::uint64_t get_u64(const std::uint8_t* bytes) noexcept {
  return canopen::get_le(bytes, 4) | static_cast<std::uint64_t>(canopen::get_le(bytes + 4, 4)) << 32;
}

}  // namespace

EncoderCardProfile::EncoderCardProfile(const EncoderCardConfig& card, const DriveTiming& timing)
    : card_(card), timing_(timing) {
  (void)settings();  // refuse now rather than while booting
}

std::vector<DriveSetting> EncoderCardProfile::settings() const {
  return {heartbeat_producer(timing_, owner(card_)), heartbeat_consumer(timing_, owner(card_))};
}

std::vector<PdoSetting> EncoderCardProfile::pdos() const {
  return {{true, kSamplePdo, canopen::kTypeEverySync, {{{kSampleObject, 0}, 64}}}};
}

bool EncoderCardProfile::decode_sample(const CanFrame& frame, CardSample& sample) const noexcept {
  if (frame.id != canopen::tpdo_id(kSamplePdo, card_.node) || frame.length != 8) return false;
  const Sample unpacked = unpack(get_u64(frame.data.data()));
  sample.channels = channels();
  for (std::size_t i = 0; i < kChannels; ++i) sample.counts[i] = unpacked.counts[i];
  sample.counter = unpacked.counter;
  return true;
}

int EncoderCardProfile::channels() const noexcept { return static_cast<int>(kChannels); }

int EncoderCardProfile::counter_modulus() const noexcept { return kCounterMask + 1; }

}  // namespace sprung::encoder_card

namespace sprung::profiles {

extern const ProfileKind encoder_card_profile_kind{
    "encoder_card", nullptr,
    [](const EncoderCardConfig& card, const DriveTiming& timing) -> std::unique_ptr<CardProfile> {
      return std::make_unique<encoder_card::EncoderCardProfile>(card, timing);
    },
    encoder_card_eds_text, encoder_card_eds_extra_text};

}  // namespace sprung::profiles

#pragma once
/// Why a message was not taken.
#include <cstdint>

#include "signals/enumeration.h"

namespace sprung {

enum class Refusal : std::int8_t {
  kNone = 0,
  kTooShort,      ///< not even a header and its counts
  kWrongHash,     ///< another type, or another version of it
  kWrongSession,  ///< of another `sprung up`, or a replay
  kBadCount,      ///< negative, or not this robot's
  kWrongLength,   ///< truncated, trailing bytes, or a string that does not fit
  kForged,        ///< its MAC is not of this run's key
  kReplayed,      ///< authentic, and was taken before, or older than what began anew since
  kLate,          ///< authentic, but older than may be
  kFuture,        ///< authentic, but further ahead than clocks may differ
  kNotDecodable,  ///< LCM's decoder refused it
  kBadValue,      ///< an enumeration value that is unknown here
};
constexpr auto words_of(Refusal) {
  using E = Refusal;
  return words<E>({{E::kNone, "accepted"},
                   {E::kTooShort, "too short"},
                   {E::kWrongHash, "wrong hash"},
                   {E::kWrongSession, "wrong session"},
                   {E::kBadCount, "bad count"},
                   {E::kWrongLength, "wrong length"},
                   {E::kForged, "forged"},
                   {E::kReplayed, "replayed"},
                   {E::kLate, "late"},
                   {E::kFuture, "from the future"},
                   {E::kNotDecodable, "not decodable"},
                   {E::kBadValue, "bad value"}});
}

}  // namespace sprung

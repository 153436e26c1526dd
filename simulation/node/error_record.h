#pragma once
/// What is wrong with a device at present, and what was: error register 0x1001, error history 0x1003 (facts
/// canopen 1.3, 2.5). Several errors may stand at one time; the register is the OR of their classes.
#include <array>
#include <cstddef>
#include <cstdint>

#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

/// Bits of 0x1001 for an error code's class, always with the generic bit; 0 for code 0.
std::uint8_t register_bits(std::uint16_t code) noexcept;

class ErrorRecord {
 public:
  static constexpr std::size_t kStanding = 32;  ///< errors at one time; the oldest is forgotten for one more

  explicit ErrorRecord(ObjectDictionary& dictionary) noexcept : dictionary_(dictionary) {}

  /// Into register and history, newest first, as many as the dictionary has room for. @return false when it
  /// stands already.
  bool raise(std::uint16_t code) noexcept;
  /// @return whether it stood, and was the last one.
  bool clear(std::uint16_t code) noexcept;
  /// @return whether there was any.
  bool clear_all() noexcept;
  bool stands(std::uint16_t code) const noexcept;
  std::uint8_t error_register() const noexcept;
  /// 0x1003:00 was written.
  void clear_history() noexcept;
  /// Power on: the dictionary has its start values already.
  void restart() noexcept { count_ = 0; }

 private:
  void push_history(std::uint16_t code) noexcept;
  void show() noexcept;

  ObjectDictionary& dictionary_;
  std::array<std::uint16_t, kStanding> codes_{};  ///< oldest first
  std::size_t count_ = 0;
};

}  // namespace sprung::sim

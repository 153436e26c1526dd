#pragma once
/// The bytes of one segmented or block SDO transfer, going out or coming in; the rules about lengths are the
/// same for client and server. Pure; fixed capacity.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_aborts.h"

namespace sprung::canopen {

/// Longest value that a transfer can carry [design choice: names have some tens of bytes, a maker's table or
/// a recording some thousands].
inline constexpr std::size_t kMaxTransfer = 8192;

class SdoBuffer {
 public:
  /// Data of the next outgoing segment, 0..7 bytes.
  struct Chunk {
    const std::uint8_t* bytes = nullptr;
    int count = 0;
    bool last = false;
  };

  /// Bytes to send. @return false, leaving it empty, when they are too many.
  bool assign(const std::uint8_t* bytes, std::size_t count) noexcept;
  /// After writing `size` bytes to send straight to data(), at most kMaxTransfer.
  void filled(std::size_t size) noexcept;
  /// Sends from the beginning again.
  void rewind() noexcept { at_ = 0; }
  /// The next 7 bytes or what is left.
  Chunk next() noexcept;

  /// Empties it for bytes to come. @param told whether the sender announced `size` of them.
  /// @return 0, or kAbortMemory when they are more than fit.
  std::uint32_t expect(bool told, std::uint32_t size) noexcept;
  /// Bytes of one incoming segment. @return 0, or kAbortTooLong, kAbortTooShort (against what was announced),
  /// kAbortMemory (more than fit); then nothing of the segment is kept.
  std::uint32_t append(const std::uint8_t* bytes, int count, bool last) noexcept;

  std::uint8_t* data() noexcept { return bytes_.data(); }
  const std::uint8_t* data() const noexcept { return bytes_.data(); }
  std::size_t size() const noexcept { return size_; }

 private:
  std::array<std::uint8_t, kMaxTransfer> bytes_{};
  std::size_t size_ = 0;
  std::size_t at_ = 0;  ///< of the next outgoing byte
  std::size_t announced_ = 0;
  bool told_ = false;
};

}  // namespace sprung::canopen

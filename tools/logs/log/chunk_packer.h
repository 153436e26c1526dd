#pragma once
/// Compresses with zstd in another thread while the caller goes on. Shell: makes threads.
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <string_view>

struct ZSTD_CCtx_s;

namespace sprung::log {

struct PackedChunk {
  std::string_view bytes;            ///< compressed; valid until the packer's next begin()
  std::uint32_t plain_checksum = 0;  ///< CRC-32 of what they were made from
};

/// One stretch of bytes at a time, so that memory is bounded and order is kept.
class ChunkPacker {
 public:
  explicit ChunkPacker(int zstd_level);
  ~ChunkPacker();

  /// Must not be called again before finish(). @param plain stays as it is until then.
  void begin(const std::string& plain);
  /// Waits. @return what begin() was given. @throws std::runtime_error what went wrong.
  PackedChunk finish();

 private:
  void pack(const std::string& plain);

  struct Free {
    void operator()(ZSTD_CCtx_s* context) const noexcept;
  };
  int zstd_level_;
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::string packed_;
  std::uint32_t plain_checksum_ = 0;
  std::future<void> packing_;  // last: it is waited for before the others are gone
};

}  // namespace sprung::log

#pragma once
/// Compresses with zstd in another thread while the caller goes on. Shell: makes threads.
#include <future>
#include <memory>
#include <string>

struct ZSTD_CCtx_s;

namespace sprung::log {

/// One stretch of bytes at a time, so that memory is bounded and order is kept.
class ChunkPacker {
 public:
  explicit ChunkPacker(int zstd_level);
  ~ChunkPacker();

  /// Must not be called again before finish(). @param plain stays as it is until then.
  void begin(const std::string& plain);
  /// Waits. @return what begin() was given, compressed; valid until the next begin(). @throws std::runtime_error what went wrong.
  const std::string& finish();

 private:
  void pack(const std::string& plain);

  struct Free {
    void operator()(ZSTD_CCtx_s* context) const noexcept;
  };
  int zstd_level_;
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::string packed_;
  std::future<void> packing_;  // last: it is waited for before the others are gone
};

}  // namespace sprung::log

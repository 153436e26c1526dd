#include "tools/logs/log/chunk_packer.h"

#include <zstd.h>

#include <new>
#include <stdexcept>

#include "tools/logs/log/checksum.h"

namespace sprung::log {

void ChunkPacker::Free::operator()(ZSTD_CCtx_s* context) const noexcept { ZSTD_freeCCtx(context); }

ChunkPacker::ChunkPacker(int zstd_level) : zstd_level_(zstd_level), context_(ZSTD_createCCtx()) {
  if (context_ == nullptr) throw std::bad_alloc();
}

ChunkPacker::~ChunkPacker() = default;

void ChunkPacker::begin(const std::string& plain) {
  packing_ = std::async(std::launch::async, [this, &plain] { pack(plain); });
}

PackedChunk ChunkPacker::finish() {
  packing_.get();
  return {packed_, plain_checksum_};
}

void ChunkPacker::pack(const std::string& plain) {
  packed_.resize(ZSTD_compressBound(plain.size()));
  const std::size_t size = ZSTD_compressCCtx(context_.get(), packed_.data(), packed_.size(), plain.data(),
                                             plain.size(), zstd_level_);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  packed_.resize(size);
  plain_checksum_ = checksum(plain);
}

}  // namespace sprung::log

#include "tools/logs/log/chunk_packer.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include "tools/logs/log/checksum.h"

namespace sprung::log {
namespace {

std::string unpacked(std::string_view packed, std::size_t size) {
  std::string plain(size, '\0');
  EXPECT_EQ(ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()), size);
  return plain;
}

TEST(ChunkPacker, PacksOneAfterTheOther) {
  ChunkPacker packer(1);
  for (int i = 0; i < 20; ++i) {
    const std::string plain(static_cast<std::size_t>(i) * 50'000, static_cast<char>('a' + i));
    packer.begin(plain);
    const PackedChunk packed = packer.finish();
    EXPECT_EQ(unpacked(packed.bytes, plain.size()), plain);
    EXPECT_LT(packed.bytes.size(), 20 + plain.size() / 100);
    EXPECT_EQ(packed.plain_checksum, checksum(plain));
  }
}

TEST(ChunkPacker, MayBeLeftWhileItIsAtWork) {
  const std::string plain(1'000'000, 'x');
  ChunkPacker packer(1);
  packer.begin(plain);
}

TEST(ChunkPacker, AHigherLevelPacksTighter) {
  std::string plain;
  for (unsigned i = 0; i < 50'000; ++i) plain += std::to_string(i * i % 977);
  ChunkPacker fast(-10), tight(9);
  fast.begin(plain);
  tight.begin(plain);
  EXPECT_LT(tight.finish().bytes.size(), fast.finish().bytes.size());
}

}  // namespace
}  // namespace sprung::log

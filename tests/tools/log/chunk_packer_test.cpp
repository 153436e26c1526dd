#include "tools/log/chunk_packer.h"

#include <gtest/gtest.h>
#include <zstd.h>

namespace sprung::log {
namespace {

std::string unpacked(const std::string& packed, std::size_t size) {
  std::string plain(size, '\0');
  EXPECT_EQ(ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()), size);
  return plain;
}

TEST(ChunkPacker, PacksOneAfterTheOther) {
  ChunkPacker packer(1);
  for (int i = 0; i < 20; ++i) {
    const std::string plain(static_cast<std::size_t>(i) * 50'000, static_cast<char>('a' + i));
    packer.begin(plain);
    const std::string& packed = packer.finish();
    EXPECT_EQ(unpacked(packed, plain.size()), plain);
    EXPECT_LT(packed.size(), 20 + plain.size() / 100);
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
  EXPECT_LT(tight.finish().size(), fast.finish().size());
}

}  // namespace
}  // namespace sprung::log

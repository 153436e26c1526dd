#include "tools/station/play/packing.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>

namespace sprung::station {
namespace {

TEST(Packing, RoundingIsWithinItsBits) {
  std::mt19937 random(1);
  std::normal_distribution<float> draw(0.0F, 100.0F);
  for (int i = 0; i < 10000; ++i) {
    const float value = draw(random);
    EXPECT_LE(std::abs(rounded(value, 13) - value), std::ldexp(std::abs(value), -13));
    EXPECT_EQ(rounded(rounded(value, 13), 13), rounded(value, 13));
  }
  EXPECT_TRUE(std::isnan(rounded(std::numeric_limits<float>::quiet_NaN(), 13)));
  const float most = std::numeric_limits<float>::max();
  EXPECT_TRUE(std::isfinite(rounded(most, 13)));
  EXPECT_EQ(rounded(-std::numeric_limits<float>::infinity(), 13), -std::numeric_limits<float>::infinity());
}

TEST(Packing, Base64IsThatOfItsStandard) {  // RFC 4648 section 10
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64("\xff\xfe\x00"), "//4=");  // the literal ends before its zero
}

TEST(Packing, GzipIsReadByZlib) {
  const std::string bytes(100'000, 'a');
  const std::string packed = gzip(bytes);
  EXPECT_LT(packed.size(), 1000u);
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  std::string out(bytes.size() + 1, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  EXPECT_EQ(out, bytes);
}

}  // namespace
}  // namespace sprung::station

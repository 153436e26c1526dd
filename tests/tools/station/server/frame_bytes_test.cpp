#include "tools/station/server/frame_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace sprung::station {
namespace {

TEST(FrameBytes, AreTimeAsADoubleThenAFloatForEachField) {
  Frame frame;
  frame.time_s = 12.5;
  frame.values = {1.0F, -0.25F, std::numeric_limits<float>::quiet_NaN()};
  const std::string bytes = frame_bytes(frame);
  ASSERT_EQ(bytes.size(), 8u + 3 * 4u);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\0\0\0\0\0\0\x29\x40", 8))
      << "little endian, whatever this machine is";
  EXPECT_EQ(bytes.substr(8, 8), std::string("\0\0\x80\x3f\0\0\x80\xbe", 8));
  float last = 0.0F;
  std::memcpy(&last, bytes.data() + 16, 4);
  EXPECT_TRUE(std::isnan(last));
}

}  // namespace
}  // namespace sprung::station

#include "runtime/resource_use.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sprung {
namespace {

TEST(CpuMeter, ShareIsOfOneCore) {
  EXPECT_DOUBLE_EQ(CpuMeter::share(250'000, 1'000'000), 0.25);
  EXPECT_DOUBLE_EQ(CpuMeter::share(1'500'000, 1'000'000), 1.5);
  EXPECT_DOUBLE_EQ(CpuMeter::share(5, 0), 0.0);
}

TEST(CpuMeter, WorkIsSeen) {
  CpuMeter meter;
  volatile double sum = 0.0;
  for (int i = 0; i < 3'000'000; ++i) sum = sum + std::sqrt(static_cast<double>(i));
  EXPECT_GT(meter.cpu_share(), 0.0);
}

TEST(Resident, GrowsWithWhatIsTouched) {
  const std::int64_t before_kB = resident_kB();
  EXPECT_GT(before_kB, 0);
  const std::vector<char> touched(64U << 20U, 'x');
  EXPECT_GT(resident_kB(), before_kB + 32'000);
  EXPECT_EQ(touched.back(), 'x');
}

TEST(HostName, IsSomething) { EXPECT_FALSE(host_name().empty()); }

}  // namespace
}  // namespace sprung

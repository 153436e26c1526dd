/// Any bytes on the line of an IMU, with cycles and silences between them.
#include <cmath>
#include <memory>

#include "drivers/imu/imu_core.h"
#include "tests/drivers/imu/xbus_bytes.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::drivers_imu {
namespace {

ImuDriverConfig imu_config() {
  ImuDriverConfig config;
  config.mounting_roll_rad = 3.1;
  config.mounting_yaw_rad = -1.5;
  config.latency_s = 0.002;
  config.range_rad_s = 34.0;
  config.range_m_s2 = 150.0;
  config.longest_silence_s = 0.02;
  return config;
}

std::string line_of(const test::Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::vector<std::string> imu_seeds() {
  test::XbusSample sample, other;
  sample.counter = 7;
  other.status = 1U << 9;
  other.quaternion_id = 0x2014;
  const std::string one = line_of(sample.bytes()), two = line_of(other.bytes());
  return {Output().byte(0).piece(one).byte(1).byte(2).byte(0).piece(one).bytes(),
          Output().byte(0).piece(two + one).byte(2).byte(200).byte(1).byte(9).byte(0).piece(one).bytes(),
          Output().byte(3).piece(line_of(sample.data())).bytes(),
          Output().byte(0).piece(std::string("\xFA\xFF\x36\xFF\x01\x00", 6) + std::string(256, 'x')).bytes()};
}

void require_sane(const Imu& imu, std::int64_t& last_seq) {
  require(imu.stamp.seq > last_seq, "each cycle has one sample");
  last_seq = imu.stamp.seq;
  const bool numbers = imu.status == ImuStatus::kGood || imu.status == ImuStatus::kNoAttitude;
  for (std::size_t i = 0; i < 3; ++i) {
    require(std::isfinite(imu.measured_angular_velocity_rad_s[i]) == numbers, "numbers where it says so");
    require(std::isfinite(imu.measured_specific_force_m_s2[i]) == numbers, "numbers where it says so");
  }
  require(imu.status != ImuStatus::kStarting, "what is given was measured, or is a fault");
}

}  // namespace

SPRUNG_FUZZ(drivers_imu, imu_seeds) {
  const auto core = std::make_unique<imu::ImuCore>(imu_config(), 0.002);
  std::int64_t time_us = 1'000'000, seq = 100, last_seq = -1;
  core->cycle({time_us, seq});
  Imu out;
  while (!input.done()) {
    switch (input.byte() % 4) {
      case 0:
        for (const char byte : input.piece())
          if (core->take(static_cast<std::uint8_t>(byte), time_us, out)) require_sane(out, last_seq);
        break;
      case 1:
        time_us += 2000 * std::int64_t{input.byte()};
        seq += input.byte() % 3;
        core->cycle({time_us, seq});
        break;
      case 2:
        time_us += 500 * std::int64_t{input.byte()};
        if (core->watch(time_us, out)) require_sane(out, last_seq);
        (void)core->not_understood(time_us);
        break;
      default: {
        const std::string_view data = input.piece();
        imu::MtData2 decoded;
        (void)imu::decode_mtdata2(reinterpret_cast<const std::uint8_t*>(data.data()), data.size(), decoded);
      }
    }
  }
}

}  // namespace sprung::fuzz::drivers_imu

#include "drivers/can/can_filter.h"

#include <algorithm>

#include "robots/robot_config.h"

namespace sprung {
namespace {

// CiA 301 predefined connection set (facts canopen 1.1).
constexpr std::uint32_t kNodeMask = 0x07F;
constexpr std::uint32_t kFunctionMask = 0x780;
constexpr CanFilter kNmt{0x000};
constexpr CanFilter kSync{0x080};
constexpr CanFilter kAnyHeartbeat{0x700, kFunctionMask};
constexpr CanFilter kAnswerOfOwnId{0x5FF};

}  // namespace

bool passes(const CanFilter* filters, int count, std::uint32_t id) noexcept {
  return count == 0 || std::any_of(filters, filters + count, [id](const CanFilter& filter) {
           return (id & filter.mask) == (filter.id & filter.mask);
         });
}

std::vector<CanFilter> bus_filters(const RobotConfig& robot, int bus) {
  std::vector<CanFilter> filters{kNmt, kSync, kAnyHeartbeat, kAnswerOfOwnId};
  const auto add = [&filters, bus](const auto& device) {
    if (device.bus == bus) filters.push_back({static_cast<std::uint32_t>(device.node), kNodeMask});
  };
  std::for_each(robot.actuators.begin(), robot.actuators.end(), add);
  std::for_each(robot.encoder_cards.begin(), robot.encoder_cards.end(), add);
  add(robot.battery);
  return filters;
}

}  // namespace sprung

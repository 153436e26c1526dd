#include "simulation/plant/plant_draw.h"

#include <cmath>
#include <cstring>

#include "robots/robot_loader.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

using Section = VariedQuantity::Section;

constexpr double kMostDraws = 1e6;

/// FNV-1a: the same on every machine, which std::hash does not promise.
std::uint64_t hash_of(const std::string& text) noexcept {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return hash;
}

/// Uniform in [0, 1).
double share_of(const std::string& what, std::uint64_t number) noexcept {
  return static_cast<double>(mix_bits(mix_bits(hash_of(what)) ^ number) >> 11) * 0x1p-53;
}

/// Names of the items that a section has a value for each.
std::vector<std::string> items_of(Section section, const SimConfig& config) {
  std::vector<std::string> items;
  switch (section) {
    case Section::kBody:
      for (const PlantBodyConfig& body : config.plant.bodies) items.push_back(body.name);
      return items;
    case Section::kJoint:
    case Section::kFriction:
    case Section::kFamily:
      for (const PlantJointConfig& joint : config.plant.joints) items.push_back(joint.name);
      return items;
    case Section::kDrive:
      for (const SimDriveConfig& drive : config.drives) items.push_back(drive.actuator);
      return items;
    case Section::kImu:
      if (!config.imu) throw ConfigError("variation.yaml: imu: sim.yaml has no IMU; remove it, or add one");
      break;
    case Section::kPlant:
      break;
  }
  return {""};
}

class Drawer {
 public:
  Drawer(const RobotConfig& robot, const PlantDraw& draw, SimConfig& config)
      : prefix_(robot.name + "/" + draw.family + "/"), number_(draw.number), config_(config) {}

  void draw(const VariedSpan& span) {
    const VariedQuantity& quantity = *span.quantity;
    const std::vector<std::string> items = items_of(quantity.section, config_);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const double share = number_ == 0 ? 0.5 : share_of(prefix_ + quantity.key + "/" + items[i], number_);
      const double value = span.from + share * (span.to - span.from);
      quantity.apply(config_, i, value);
      drawn_.push_back({items[i], quantity.key, value, quantity.unit});
    }
  }
  std::vector<DrawnValue> drawn() && { return std::move(drawn_); }

 private:
  std::string prefix_;
  std::uint64_t number_;
  SimConfig& config_;
  std::vector<DrawnValue> drawn_;
};

const std::vector<VariedSpan>& family_of(const Variation& variation, const std::string& name) {
  const auto found = variation.families.find(name);
  if (found != variation.families.end()) return found->second;
  std::string known;
  for (const auto& family : variation.families) known += (known.empty() ? "" : ", ") + family.first;
  throw ConfigError("--plant family=" + name + ": variation.yaml has no such family; there are " + known);
}

void make_elastic(SimConfig& config) {
  for (const PlantJointConfig& joint : config.plant.joints) {
    if (joint.torsion) config.plant.torsion = true;
  }
}

}  // namespace

std::optional<PlantDraw> take_draw(std::map<std::string, double>& changes) {
  PlantDraw draw;
  bool asked = false;
  if (const auto number = changes.find("draw"); number != changes.end()) {
    const double value = number->second;
    if (!(value >= 0.0 && value <= kMostDraws) || std::floor(value) != value)
      throw ConfigError("--plant draw: found " + std::to_string(value) +
                        ", expected a whole number from 0, which is nominal, to 1000000");
    draw.number = static_cast<std::uint64_t>(value);
    asked = true;
    changes.erase(number);
  }
  for (auto family = changes.lower_bound(kFamilyKey);
       family != changes.end() && family->first.rfind(kFamilyKey, 0) == 0; family = changes.erase(family)) {
    if (!draw.family.empty())
      throw ConfigError("--plant family: found two, " + draw.family + " and " +
                        family->first.substr(std::strlen(kFamilyKey)) + "; a plant has one");
    draw.family = family->first.substr(std::strlen(kFamilyKey));
    asked = true;
  }
  return asked ? std::optional<PlantDraw>(draw) : std::nullopt;
}

std::vector<DrawnValue> draw_plant(const RobotConfig& robot, const Variation& variation,
                                   const PlantDraw& draw, SimConfig& config) {
  Drawer drawer(robot, draw, config);
  if (!draw.family.empty()) {
    const std::vector<VariedSpan>& family = family_of(variation, draw.family);
    for (PlantJointConfig& joint : config.plant.joints) joint.friction = FrictionConfig{};
    for (const VariedSpan& span : family) drawer.draw(span);
  }
  if (draw.number > 0) {
    if (variation.elastic_gears) make_elastic(config);
    if (variation.real_windings) config.real_windings = true;
    for (const VariedSpan& span : variation.spans) {
      const bool of_sim_yamls_class = span.quantity->section == Section::kFriction;
      if (!of_sim_yamls_class || draw.family.empty()) drawer.draw(span);
    }
  }
  return std::move(drawer).drawn();
}

}  // namespace sprung::sim

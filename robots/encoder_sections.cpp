#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "robots/robot_sections.h"
#include "signals/angles.h"

namespace sprung::robot_sections {

namespace {

/// Those of CiA 301 that carry a robot's cycle; slower ones exist.
constexpr std::array<double, 5> kBitRates_kbit_s{1000, 800, 500, 250, 125};
constexpr int kMostChannels = 4;  ///< of an encoder card
constexpr double kFarthest_rad = 100;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Range {
  double min_rad = 0.0;
  double max_rad = 0.0;
};

/// Of an actuator, from the row of the inverse transmission that gives its position.
Range actuator_range(const Eigen::VectorXd& row, const RobotConfig& robot, const LegConfig& leg) {
  Range range;
  for (std::size_t k = 0; k < leg.joints.size(); ++k) {
    const JointConfig& joint = robot.joints[leg.joints[k]];
    const double share = row[static_cast<Eigen::Index>(k)];
    range.min_rad += std::min(share * joint.position_min_rad, share * joint.position_max_rad);
    range.max_rad += std::max(share * joint.position_min_rad, share * joint.position_max_rad);
  }
  return range;
}

void refuse_folded(const YamlMap& file, const ActuatorConfig& actuator, const Range& range) {
  if (range.min_rad > -kPi && range.max_rad < kPi) return;
  char text[80];
  std::snprintf(text, sizeof text, " turns from %.6g to %.6g rad", range.min_rad, range.max_rad);
  file.fail("actuators",
            "actuator " + actuator.name + text +
                " within its joints' limits, and a link_encoder tells positions between -3.14159 and "
                "3.14159 rad: narrow the limits, move the zero, or leave the link_encoder out");
}

constexpr double kSoftest_Nm_rad = 1.0, kHardest_Nm_rad = 1e7;

KinematicErrorTerm read_term(const YamlMap& map) {
  KinematicErrorTerm term;
  term.order = map.quantity("order", "", 1e-3, 1000);
  term.cosine_rad = map.quantity("cosine", "rad", -0.1, 0.1);
  term.sine_rad = map.quantity("sine", "rad", -0.1, 0.1);
  map.finish();
  return term;
}

void read_kinematic_error(const YamlMap& map, GearTorsion& torsion) {
  for (const YamlMap& term : map.list("kinematic_error")) {
    if (torsion.kinematic_terms == GearTorsion::kMostTerms)
      map.fail("kinematic_error", "expected at most " + std::to_string(GearTorsion::kMostTerms) + " terms");
    torsion.kinematic_error[torsion.kinematic_terms++] = read_term(term);
  }
}

}  // namespace

int choice(const YamlMap& map, const std::string& key, const std::vector<std::string>& known) {
  const std::string found = map.text(key);
  const auto at = std::find(known.begin(), known.end(), found);
  if (at != known.end()) {
    return static_cast<int>(at - known.begin());
  }
  std::string names;
  for (const std::string& name : known) {
    names += (names.empty() ? "" : ", ") + name;
  }
  map.fail(key, "found '" + found + "', expected one of: " + names);
}

double read_bit_rate(const YamlMap& file) {
  const double rate = file.quantity_or("bit_rate", "kbit/s", 0, 1e6, kBitRates_kbit_s.front());
  if (std::find(kBitRates_kbit_s.begin(), kBitRates_kbit_s.end(), rate) == kBitRates_kbit_s.end()) {
    file.fail("bit_rate", "expected 1000, 800, 500, 250 or 125 kbit/s");
  }
  return 1e3 * rate;
}

double read_direction(const YamlMap& map) {
  const auto direction = static_cast<double>(map.integer("direction", -1, 1));
  if (direction == 0.0) {
    map.fail("direction", "expected 1 or -1, found 0");
  }
  return direction;
}

IdentityConfig read_identity(const YamlMap& map) {
  const std::int64_t top = 0xFFFFFFFF;
  IdentityConfig identity;
  identity.vendor = static_cast<std::uint32_t>(map.integer("vendor", 0, top));
  identity.product = static_cast<std::uint32_t>(map.integer("product", 0, top));
  identity.revision = static_cast<std::uint32_t>(map.integer_or("revision", 0, top, 0));
  identity.serial = static_cast<std::uint32_t>(map.integer_or("serial", 0, top, 0));
  map.finish();
  return identity;
}

NodeWatch read_node_watch(const YamlMap& map) {
  const bool guarding = map.has("watch") && choice(map, "watch", {"heartbeat", "guarding"}) == 1;
  return guarding ? NodeWatch::kGuarding : NodeWatch::kHeartbeat;
}

EncoderCardConfig read_encoder_card(const YamlMap& map, const std::vector<BusConfig>& buses) {
  EncoderCardConfig card;
  card.name = map.text("name");
  card.bus = index_of(buses, map.text("bus"), map, "bus");
  card.node = static_cast<int>(map.integer("node", 1, 126));
  card.profile = map.text("profile");
  card.identity = read_identity(map.map("identity"));
  card.watch = read_node_watch(map);
  map.finish();
  return card;
}

LinkEncoderConfig read_link_encoder(const YamlMap& map, const std::vector<EncoderCardConfig>& cards) {
  LinkEncoderConfig encoder;
  encoder.card = index_of(cards, map.text("card"), map, "card");
  encoder.channel = static_cast<int>(map.integer("channel", 0, kMostChannels - 1));
  encoder.counts_per_turn = static_cast<double>(map.integer("counts", 16, 1LL << 32));
  encoder.direction = read_direction(map);
  encoder.offset_rad = map.quantity("offset", "rad", -kFarthest_rad, kFarthest_rad);
  map.finish();
  return encoder;
}

ReferenceConfig read_reference(const YamlMap& map) {
  ReferenceConfig reference;
  reference.method = static_cast<ReferenceMethod>(choice(map, "method", {"none", "link", "index", "jig"}));
  reference.absolute_encoder = choice(map, "encoder", {"absolute", "incremental"}) == 0;
  const bool index = reference.method == ReferenceMethod::kIndex;
  if (index || reference.method == ReferenceMethod::kJig) {
    reference.jig_position_rad = map.quantity("jig", "rad", -kFarthest_rad, kFarthest_rad);
  }
  if (index) {
    reference.index_position_rad = map.quantity("index", "rad", -kFarthest_rad, kFarthest_rad);
  }
  reference.max_age_days = static_cast<int>(map.integer_or("max_age_days", 1, 3650, reference.max_age_days));
  if (reference.method == ReferenceMethod::kNone && !reference.absolute_encoder) {
    map.fail("method", "an incremental encoder needs one: link, index or jig, for `sprung home`");
  }
  map.finish();
  return reference;
}

void refuse_folded_link_positions(const YamlMap& file, const RobotConfig& robot) {
  for (const LegConfig& leg : robot.legs) {
    const auto size = static_cast<Eigen::Index>(leg.actuators.size());
    const Eigen::FullPivLU<Matrix> lu(Eigen::Map<const Matrix>(leg.transmission.data(), size, size));
    if (!lu.isInvertible()) continue;  // whoever moves the leg refuses that
    const Matrix to_actuator = lu.inverse();
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto index = static_cast<std::size_t>(leg.actuators[static_cast<std::size_t>(i)]);
      const ActuatorConfig& actuator = robot.actuators[index];
      if (actuator.link_encoder.card < 0) continue;
      refuse_folded(file, actuator, actuator_range(to_actuator.row(i), robot, leg));
    }
  }
}

GearTorsion read_torsion(const YamlMap& map) {
  GearTorsion torsion;
  torsion.stiffness_Nm_rad = map.quantity("stiffness", "Nm/rad", kSoftest_Nm_rad, kHardest_Nm_rad);
  torsion.second_stiffness_Nm_rad = torsion.stiffness_Nm_rad;
  if (map.has("second_stiffness") != map.has("second_from"))
    map.fail("second_stiffness", "second_stiffness and second_from belong together");
  if (map.has("second_stiffness")) {
    torsion.second_stiffness_Nm_rad = map.quantity("second_stiffness", "Nm/rad", kSoftest_Nm_rad,
                                                   kHardest_Nm_rad);
    torsion.second_from_Nm = map.quantity("second_from", "Nm", 0, 1e4);
  }
  torsion.angle_std_rad = map.quantity("angle_std", "rad", 1e-9, 0.1);
  if (map.has("kinematic_error")) read_kinematic_error(map, torsion);
  map.finish();
  return torsion;
}

}  // namespace sprung::robot_sections

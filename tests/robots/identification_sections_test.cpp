#include "robots/identification_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "robots/robot_loader.h"
#include "robots/robot_sections.h"
#include "tests/model/friction/parameter_sets.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kPlain = R"(    name: knee
    position: {min: 0.05 rad, max: 2.62 rad}
    armature: 0.6 kg m^2
    coulomb_friction: 1.79 Nm
    friction_source: "S0 section II-A"
)";
const char* const kFriction =
    "    friction: {model: stribeck, coulomb: 7.3 Nm, breakaway: 8.1 Nm, stribeck_speed: 0.1 rad/s, "
    "viscous: 1.2 Nm s/rad}\n";
const char* const kIdentified = R"(    identified:
      date: 2026-11-21
      log: sweep.log
      sha256: "0123456789abcdef"
      samples: 12345
      held_out_r2: 0.99
      held_out_rms: 0.4 Nm
      command: "sprung identify sweep.log --robot single_leg"
)";

JointConfig read(const std::string& text) {
  return robot_sections::read_joint(YamlMap::parse(text, "r.yaml"));
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = std::string(kPlain) + kFriction + kIdentified;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  try {
    (void)read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// Of one friction section, with its provenance.
std::string friction_complaint(const std::string& friction) {
  return complaint(std::string(kPlain) + "    friction: {" + friction + "}\n" + kIdentified);
}

TEST(IdentificationSections, JointWithoutThemHasThePapersFriction) {
  const JointConfig joint = read(kPlain);
  EXPECT_FALSE(joint.friction.has_value());
  EXPECT_EQ(to_vector(joint.estimated_friction()), to_vector(joint.papers_friction()));
  EXPECT_EQ(joint.papers_friction().coulomb_Nm, 1.79);
  EXPECT_EQ(joint.uncertainty.friction, kPapersFrictionUncertainty);
  EXPECT_EQ(joint.thermal.time_constant_s, 0.0);
}

TEST(IdentificationSections, IdentifiedFrictionStandsBesideThePapers) {
  const JointConfig joint = read(std::string(kPlain) + kFriction + kIdentified);
  ASSERT_TRUE(joint.friction.has_value());
  EXPECT_EQ(joint.friction->model, FrictionModelKind::kStribeck);
  EXPECT_EQ(joint.papers_friction().coulomb_Nm, 1.79);
  const FrictionParameters p = joint.estimated_friction();
  EXPECT_EQ(p.coulomb_Nm, 7.3);
  EXPECT_NEAR(p.stribeck_Nm, 0.8, 1e-12);
  EXPECT_EQ(p.stribeck_speed_rad_s, 0.1);
  EXPECT_EQ(p.viscous_Nm_s_rad, 1.2);
  EXPECT_EQ(joint.uncertainty.friction, JointUncertainty{}.friction);
}

TEST(IdentificationSections, RecordSaysWhereTheNumbersComeFrom) {
  const IdentificationRecord record = read(std::string(kPlain) + kFriction + kIdentified).friction->record;
  EXPECT_EQ(record.date, "2026-11-21");
  EXPECT_EQ(record.log, "sweep.log");
  EXPECT_EQ(record.sha256, "0123456789abcdef");
  EXPECT_EQ(record.samples, 12345);
  EXPECT_EQ(record.held_out_r2, 0.99);
  EXPECT_EQ(record.held_out_rms_Nm, 0.4);
  EXPECT_THAT(record.command, HasSubstr("sprung identify"));
}

TEST(IdentificationSections, UncertaintyAndThermalAreReadAndMayBeIncomplete) {
  const JointConfig joint = read(
      std::string(kPlain) + "    uncertainty: {armature: 0.05}\n" +
      "    thermal: {resistance: 0.8 K/W, time_constant: 600 s, ambient: 22 degC}\n");
  EXPECT_EQ(joint.uncertainty.armature, 0.05);
  EXPECT_EQ(joint.uncertainty.friction, kPapersFrictionUncertainty);
  EXPECT_EQ(joint.uncertainty.mass, JointUncertainty{}.mass);
  EXPECT_EQ(joint.thermal.resistance_K_W, 0.8);
  EXPECT_EQ(joint.thermal.time_constant_s, 600.0);
  EXPECT_EQ(joint.thermal.ambient_C, 22.0);
  EXPECT_EQ(joint.thermal.ambient_std_K, ThermalParameters{}.ambient_std_K);
}

TEST(IdentificationSections, EveryParameterOfTheRichestModelIsRead) {
  const JointConfig joint = read(
      std::string(kPlain) + kIdentified +
      "    friction: {model: presliding, coulomb: 1 Nm, breakaway: 3 Nm, stribeck_speed: 4 rad/s,\n"
      "      stribeck_exponent: 1.5, viscous: 6 Nm s/rad, viscous_exponent: 0.7, load_share_driving: 0.08,\n"
      "      load_share_driven: 0.09, asymmetry: -0.1, presliding: 0.011 rad, viscous_temperature: 0.012 "
      "1/K,\n"
      "      coulomb_temperature: 0.013 1/K, reference_temperature: 30 degC}\n");
  const FrictionVector expected = {1, 2, 4, 1.5, 6, 0.7, 0.08, 0.09, -0.1, 0.011, 0.012, 0.013};
  EXPECT_EQ(to_vector(joint.estimated_friction()), expected);
  EXPECT_EQ(joint.estimated_friction().reference_temperature_C, 30.0);
}

TEST(IdentificationSections, ARecordOfNobodyOrOfThisRobotIsNotAnothers) {
  IdentificationRecord record;
  EXPECT_FALSE(identified_on_another(record, "mine"));
  record.robot = "mine";
  EXPECT_FALSE(identified_on_another(record, "mine"));
  record.robot = "yours";
  EXPECT_TRUE(identified_on_another(record, "mine"));
}

TEST(IdentificationSections, WhatIsWrittenIsReadBack) {
  JointConfig joint = read(std::string(kPlain) + kFriction + kIdentified);
  joint.friction->model = FrictionModelKind::kLoad;
  joint.friction->parameters.load_share_driven = 1.0 / 3.0;
  joint.friction->parameters.viscous_exponent = 0.7;
  joint.friction->parameters.viscous_temperature_1_K = 0.035;
  joint.friction->record.command = "sprung identify \"a b\\c\"";
  joint.friction->record.robot = "another one";
  joint.uncertainty.mass = 0.07;
  joint.thermal = {0.8, 600.0, 22.0, 1.5};
  const JointConfig again = read(kPlain + identification_text(joint));
  EXPECT_EQ(again.friction->model, joint.friction->model);
  for (const FrictionParameterInfo& row : friction_parameter_table()) {
    EXPECT_NEAR(again.friction->parameters.*(row.member), joint.friction->parameters.*(row.member), 1e-13)
        << row.name;
  }
  EXPECT_EQ(again.friction->record.robot, "another one");
  EXPECT_EQ(again.friction->record.command, joint.friction->record.command);
  EXPECT_EQ(again.friction->record.sha256, joint.friction->record.sha256);
  EXPECT_EQ(again.uncertainty.mass, 0.07);
  EXPECT_EQ(again.thermal.time_constant_s, 600.0);
  EXPECT_EQ(again.thermal.ambient_std_K, 1.5);
}

TEST(IdentificationSections, EverySubsetOfTermsIsReadBackUnderItsSmallestModel) {
  const FrictionVector full = {1, 2, 4, 1.5, 6, 0.7, 0.08, 0.09, -0.1, 0.011, 0.012, 0.013};
  JointConfig joint = read(std::string(kPlain) + kFriction + kIdentified);
  for (unsigned subset = 0; subset < 1u << kFrictionParameters; ++subset) {
    FrictionVector vector = to_vector(FrictionParameters{});
    for (std::size_t i = 0; i < kFrictionParameters; ++i) {
      if ((subset >> i & 1u) != 0) vector[i] = full[i];
    }
    const FrictionParameters p = test::from_vector(vector);
    const bool shapes_nothing = p.viscous_Nm_s_rad == 0.0 &&
                                (p.viscous_exponent != 1.0 || p.viscous_temperature_1_K != 0.0);
    if (shapes_nothing) continue;  // refused, see HalfATermIsRefused
    joint.friction->parameters = p;
    joint.friction->model = test::smallest_model(p);
    const JointConfig again = read(kPlain + identification_text(joint));
    FrictionParameters expected = p;
    if (p.stribeck_Nm == 0.0) {
      expected.stribeck_speed_rad_s = again.friction->parameters.stribeck_speed_rad_s;
      expected.stribeck_exponent = 2.0;
    }
    ASSERT_EQ(to_vector(again.friction->parameters), to_vector(expected)) << identification_text(joint);
  }
}

TEST(IdentificationSections, ExampleInTheDocsIsOne) {
  std::ifstream in(test::source_dir() + "/docs/friction.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t begin = page.find("```yaml\n") + 8;
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  const JointConfig joint = robot_sections::read_joint(
      YamlMap::parse(example, "friction.md").list("joints").at(0));
  EXPECT_EQ(joint.friction->parameters.coulomb_Nm, 7.3);
  EXPECT_EQ(joint.coulomb_friction_Nm, 1.79);
  EXPECT_EQ(joint.thermal.time_constant_s, 600.0);
}

EstimationConfig read_estimation(const std::string& text) {
  return robot_sections::read_estimation(YamlMap::parse(text, "r.yaml"));
}

TEST(IdentificationSections, WhatTheEstimatorTakesForGrantedIsReadAndMayBeMissing) {
  const EstimationConfig all = read_estimation(
      "drive_loop: 8 kHz\nsampling_jitter: 5 us\ncurrent_noise: 0.2 Nm\nload_walk: 20 Nm/sqrt(s)\n"
      "floor_force: 50 N\nadapts_friction: false\n");
  EXPECT_EQ(all.drive_loop_kHz, 8.0);
  EXPECT_EQ(all.sampling_jitter_us, 5.0);
  EXPECT_EQ(all.current_noise_Nm, 0.2);
  EXPECT_EQ(all.load_walk_Nm_sqrt_s, 20.0);
  EXPECT_EQ(all.floor_force_N, 50.0);
  EXPECT_FALSE(all.adapts_friction);
  const EstimationConfig one = read_estimation("sampling_jitter: 5 us\n");
  EXPECT_EQ(one.sampling_jitter_us, 5.0);
  EXPECT_TRUE(one.adapts_friction);
  EXPECT_EQ(one.load_walk_Nm_sqrt_s, EstimationConfig{}.load_walk_Nm_sqrt_s);
}

TEST(IdentificationSections, EstimationThatCannotBeIsRefused) {
  EXPECT_THROW(read_estimation("drive_loop: 0 kHz\n"), ConfigError);
  EXPECT_THROW(read_estimation("drive_loop: 4000 Hz\n"), ConfigError);
  EXPECT_THROW(read_estimation("load_walk: 0 Nm/sqrt(s)\n"), ConfigError);
  EXPECT_THROW(read_estimation("floor_force: -1 N\n"), ConfigError);
  EXPECT_THROW(read_estimation("jitter: 2 us\n"), ConfigError);
  EXPECT_THROW(read_estimation("adapts_friction: no\n"), ConfigError);
}

TEST(IdentificationSections, JointThatIsNotIdentifiedCannotBeWritten) {
  EXPECT_THROW((void)identification_text(read(kPlain)), std::invalid_argument);
}

TEST(IdentificationSections, NumbersWithoutTheirSourceAreRefusedAndTheReverse) {
  EXPECT_THAT(complaint(std::string(kPlain) + kFriction),
              AllOf(HasSubstr("r.yaml:6"), HasSubstr("belong together")));
  EXPECT_THAT(complaint(std::string(kPlain) + kIdentified), HasSubstr("belong together"));
}

TEST(IdentificationSections, UnknownModelIsRefusedWithTheKnownOnes) {
  EXPECT_THAT(friction_complaint("model: lugre, coulomb: 1 Nm"),
              AllOf(HasSubstr("r.yaml:6"), HasSubstr("'lugre'"), HasSubstr("stribeck, load, presliding")));
}

TEST(IdentificationSections, TermThatTheModelDoesNotHaveIsRefused) {
  EXPECT_THAT(
      friction_complaint("model: viscous, coulomb: 1 Nm, viscous: 1 Nm s/rad, load_share_driven: 0.1"),
      AllOf(HasSubstr("load_share_driven"), HasSubstr("model viscous has no such term")));
}

TEST(IdentificationSections, ModelWithoutItsOwnTermsIsRefused) {
  EXPECT_THAT(friction_complaint("model: load, coulomb: 1 Nm, viscous: 1 Nm s/rad"),
              AllOf(HasSubstr("needs at least one of"), HasSubstr("load_share_driving")));
}

TEST(IdentificationSections, HalfATermIsRefused) {
  EXPECT_THAT(friction_complaint("model: stribeck, coulomb: 1 Nm, breakaway: 2 Nm"),
              HasSubstr("stribeck_speed"));
  EXPECT_THAT(
      friction_complaint("model: viscous, coulomb: 1 Nm, viscous: 1 Nm s/rad, viscous_temperature: 0.03 1/K"),
      HasSubstr("reference_temperature"));
  EXPECT_THAT(friction_complaint("model: viscous, coulomb: 1 Nm, viscous: 0 Nm s/rad, viscous_exponent: 0.7"),
              HasSubstr("what shapes it is there"));
}

TEST(IdentificationSections, MissingAndWrongUnitsAreRefused) {
  EXPECT_THAT(complaint(changed("viscous: 1.2 Nm s/rad", "viscous: 1.2")), HasSubstr("unit is missing"));
  EXPECT_THAT(complaint(changed("coulomb: 7.3 Nm,", "coulomb: 7.3 N,")), HasSubstr("wrong unit 'N'"));
  EXPECT_THAT(complaint(changed("held_out_rms: 0.4 Nm", "held_out_rms: 0.4")), HasSubstr("unit is missing"));
}

TEST(IdentificationSections, ImpossibleValuesAreRefused) {
  EXPECT_THAT(complaint(changed("breakaway: 8.1 Nm", "breakaway: 7.2 Nm")), HasSubstr("out of range"));
  EXPECT_THAT(complaint(changed("stribeck_speed: 0.1", "stribeck_speed: 0")), HasSubstr("out of range"));
  EXPECT_THAT(friction_complaint("model: load, coulomb: 1 Nm, load_share_driven: 0.9"),
              HasSubstr("out of range"));
  EXPECT_THAT(complaint(changed("held_out_r2: 0.99", "held_out_r2: 1.1")), HasSubstr("out of range"));
  EXPECT_THAT(complaint(std::string(kPlain) + "    uncertainty: {friction: -0.1}\n"),
              HasSubstr("out of range"));
  EXPECT_THAT(complaint(std::string(kPlain) +
                        "    thermal: {resistance: 1 K/W, time_constant: 0 s, ambient: 20 degC}\n"),
              HasSubstr("out of range"));
}

TEST(IdentificationSections, UnreadableSourcesAreRefused) {
  EXPECT_THAT(complaint(changed("2026-11-21", "21.11.2026")), HasSubstr("expected YYYY-MM-DD"));
  EXPECT_THAT(complaint(changed("0123456789abcdef", "0123")), HasSubstr("hexadecimal"));
  EXPECT_THAT(complaint(changed("samples: 12345", "samples: 0")), HasSubstr("out of range"));
}

TEST(IdentificationSections, UnknownKeysAreRefused) {
  EXPECT_THAT(complaint(changed("viscous: 1.2", "viscosity: 1.2")), HasSubstr("viscosity' is unknown"));
  EXPECT_THAT(complaint(changed("samples:", "count: 1\n      samples:")), HasSubstr("count' is unknown"));
  EXPECT_THAT(complaint(std::string(kPlain) + "    uncertainty: {speed: 0.1}\n"),
              HasSubstr("speed' is unknown"));
}

}  // namespace
}  // namespace sprung

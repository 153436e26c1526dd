#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/tools/lab/identify/identify_sample.h"
#include "tools/lab/identify/fragment.h"
#include "tools/lab/identify/leg_comparison.h"
#include "tools/lab/identify/result_json.h"
#include "tools/lab/identify/result_report.h"
#include "tools/lab/identify/result_table.h"

namespace sprung::identify {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<double> kPose_rad = {1.0, 1.2};

/// Of the shank about the knee: single_leg/robot.yaml, parallel axes.
double shank_kg_m2() {
  const LinkConfig shank = load_robot("single_leg").legs[0].links[1];
  return shank.inertia_kg_m2 + shank.mass_kg * shank.com_m * shank.com_m;
}

/// Identified once: every test here reads it.
const IdentifiedJoint& knee() {
  static const IdentifiedJoint joint = [] {
    IdentifiedJoint out = sample_joint(sample_series({}, shank_kg_m2()));
    out.armature = armature_of(load_robot("single_leg"), 1, kPose_rad, out.chosen());
    return out;
  }();
  return joint;
}

TEST(LegComparison, ArmatureIsTheInertiaWithoutTheLinks) {
  ASSERT_TRUE(knee().armature);
  EXPECT_NEAR(knee().armature->links_kg_m2, shank_kg_m2(), 1e-12);
  EXPECT_NEAR(knee().armature->value_kg_m2, SampleTruth().armature_kg_m2,
              0.05 * SampleTruth().armature_kg_m2);
  EXPECT_THAT(knee().armature->note, HasSubstr("robot.yaml's masses"));
}

TEST(LegComparison, JointsAloneHaveNoArmature) {
  RobotConfig joints = load_robot("pegasus");
  for (LegConfig& leg : joints.legs) leg.kinematics = kNoKinematics;
  EXPECT_FALSE(armature_of(joints, 0, {0, 0, 0}, knee().chosen()));
  EXPECT_FALSE(torque_constant_of(joints, 0, {0, 0, 0}, knee().chosen()));
}

TEST(LegComparison, WeightOfKnownLinksGivesTheTorqueConstant) {
  // The arm of test_axis, recorded by a drive whose torque constant is believed 10 % too small: all torques
  // are.
  const RobotConfig bench = load_robot("test_axis");
  const LinkConfig& arm = bench.legs[0].links[0];
  SampleTruth truth;
  truth.gravity_Nm = arm.mass_kg * 9.81 * arm.com_m;
  identification::RawSeries series = sample_series(truth, 0.5);
  for (double& torque_Nm : series.measured_torque) torque_Nm /= 1.1;
  const auto found = torque_constant_of(bench, 0, {0.0}, sample_joint(series).chosen());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->factor, 1.1, 0.03);
  EXPECT_GT(found->standard_error, 0.0);
}

TEST(ResultJson, HasParametersErrorsAndHeldOutScoresOfEveryModel) {
  const json found = json::parse(result_json({knee()}, sample_provenance()));
  EXPECT_EQ(found["sha256"], "0123456789abcdef");
  EXPECT_EQ(found["joint"], "knee");
  EXPECT_EQ(found["chosen"], "viscous");
  EXPECT_THAT(found["criterion"].get<std::string>(), HasSubstr("one-standard-error"));
  ASSERT_EQ(found["models"].size(), 2u);
  const json& model = found["models"][1];
  EXPECT_EQ(model["name"], "viscous");
  EXPECT_NEAR(model["parameters"]["coulomb"]["value"].get<double>(), 6.0, 0.2);
  EXPECT_EQ(model["parameters"]["coulomb"]["unit"], "Nm");
  EXPECT_GT(model["parameters"]["coulomb"]["standard_error"].get<double>(), 0.0);
  EXPECT_GT(model["held_out_r2"].get<double>(), 0.98);
  EXPECT_NEAR(model["held_out_rms"].get<double>(), knee().chosen().held_out.rms, 1e-12);
  EXPECT_EQ(model["correlations"].size(), model["parameters"].size());
  EXPECT_NEAR(found["armature"]["value"].get<double>(), 0.75, 0.04);
}

TEST(ResultJson, SeveralJointsAreAList) {
  const json found = json::parse(result_json({knee(), knee()}, sample_provenance()));
  EXPECT_EQ(found["joints"].size(), 2u);
  EXPECT_FALSE(found.contains("models"));
}

TEST(ResultTable, SaysWhatWasChosenAndWhy) {
  const std::string text = result_table(knee());
  EXPECT_THAT(text, HasSubstr("joint knee"));
  EXPECT_THAT(text, HasSubstr("* viscous "));
  EXPECT_THAT(text, HasSubstr("* chosen: 'viscous'"));
  EXPECT_THAT(text, HasSubstr("one-standard-error rule"));
  EXPECT_THAT(text, HasSubstr("armature"));
}

TEST(ResultTable, NumbersHaveAsManyDigitsAsTheirError) {
  EXPECT_THAT(with_error(1.78912, 0.0234, "Nm"), HasSubstr("1.789 +- 0.023 Nm"));
  EXPECT_THAT(with_error(178.912, 23.4, ""), HasSubstr("179 +- 23"));
  EXPECT_THAT(with_error(0.5, std::nan(""), "rad"), HasSubstr("0.5 rad"));
}

/// single_leg with the fragment's keys of the knee in the place of its own.
RobotConfig loaded_with(const std::string& fragment) {
  const std::string folder = test::temp_dir() + "identify_fragment";
  std::filesystem::create_directories(folder);
  std::ifstream in(load_robot("single_leg").folder + "/robot.yaml");
  std::string line;
  std::ofstream out(folder + "/robot.yaml");
  bool in_knee = false;
  for (bool written = false; std::getline(in, line);) {
    if (line.rfind("  - name: knee", 0) == 0 && line.find("motor") == std::string::npos) in_knee = true;
    if (line.rfind("legs:", 0) == 0) in_knee = false;
    const bool kept = line.rfind("    position:", 0) == 0 ||
                      line.find("friction_source:") != std::string::npos ||
                      line.find("coulomb_friction:") != std::string::npos;
    if (!in_knee || kept) out << line << "\n";
    if (in_knee && !written) {
      out << fragment.substr(fragment.find("  - name"));
      written = true;
    }
  }
  out.close();
  return load_robot(folder);
}

/// Recorded at 24 and at 40 degC, so that its law may tell warmth.
IdentifiedJoint warmed_joint() {
  identification::RawSeries series = sample_series({}, 0.05);
  for (std::size_t i = 0; i < series.time_s.size(); ++i)
    series.temperature_C.push_back(i < series.time_s.size() / 2 ? 24.0 : 40.0);
  IdentifiedJoint joint = sample_joint(
      series, {{identification::JointTerm::kViscous, identification::JointTerm::kTemperature}});
  joint.armature = knee().armature;
  return joint;
}

/// robot.yaml refuses a factor on viscous friction that is not there.
TEST(Fragment, WarmthShapesNoViscousFrictionThatIsNone) {
  IdentifiedJoint joint = warmed_joint();
  const RobotConfig robot = load_robot("single_leg");
  const JointConfig& known = robot.joints[1];
  Eigen::VectorXd& found = joint.result.models[joint.result.chosen].fit.parameters;
  const auto& parameters = joint.chosen().model->parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == "viscous_temperature") found[static_cast<Eigen::Index>(i)] = 0.03;
  }
  EXPECT_EQ(identified_config(joint, known, sample_provenance()).friction->parameters.viscous_temperature_1_K,
            0.03);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == "viscous") found[static_cast<Eigen::Index>(i)] = 0.0;
  }
  const JointConfig out = identified_config(joint, known, sample_provenance());
  EXPECT_EQ(out.friction->parameters.viscous_temperature_1_K, 0.0);
  EXPECT_EQ(loaded_with(fragment_text({joint}, {out})).joints[1].friction->parameters.viscous_Nm_s_rad, 0.0);
}

/// In a room whose temperature is known a law that tells warmth needs no room for warmth.
TEST(Fragment, ARoomsTemperatureIsWrittenForALawThatTellsWarmthAndForNoOther) {
  IdentifiedJoint joint = warmed_joint();
  const auto& parameters = joint.chosen().model->parameters();
  Eigen::VectorXd& found = joint.result.models[joint.result.chosen].fit.parameters;
  const auto with_warmth = [&](double share_1_K) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].name == "viscous_temperature") found[static_cast<Eigen::Index>(i)] = share_1_K;
    }
    OtherDays days;
    days.ambient_C = 18.0;
    return identified_config(joint, load_robot("single_leg").joints[1], sample_provenance(), days);
  };
  const JointConfig warm = with_warmth(0.03), none = with_warmth(0.0);
  const JointConfig loaded = loaded_with(fragment_text({joint}, {warm})).joints[1];
  EXPECT_EQ(loaded.thermal.ambient_C, 18.0);
  EXPECT_EQ(loaded.thermal.ambient_std_K, 1.5);
  EXPECT_GT(loaded.thermal.time_constant_s, 0.0);
  EXPECT_EQ(none.thermal.time_constant_s, 0.0);
  EXPECT_LT(warm.uncertainty.friction, 0.5 * none.uncertainty.friction);
}

TEST(Fragment, LoadsBackAsPartOfARobot) {
  const RobotConfig robot = load_robot("single_leg");
  const JointConfig found = identified_config(knee(), robot.joints[1], sample_provenance());
  const JointConfig loaded = loaded_with(fragment_text({knee()}, {found})).joints[1];
  ASSERT_TRUE(loaded.friction);
  EXPECT_EQ(loaded.friction->model, FrictionModelKind::kViscous);
  EXPECT_NEAR(loaded.friction->parameters.coulomb_Nm, found.friction->parameters.coulomb_Nm, 1e-9);
  EXPECT_NEAR(loaded.friction->parameters.viscous_Nm_s_rad, 3.0, 0.2);
  EXPECT_NEAR(loaded.armature_kg_m2, 0.75, 0.04);
  EXPECT_EQ(loaded.friction->record.sha256, "0123456789abcdef");
  EXPECT_EQ(loaded.friction->record.command, "sprung identify --log logs/knee.lcm");
  EXPECT_EQ(loaded.friction->record.samples, knee().chosen().train.samples);
  EXPECT_NEAR(loaded.friction->record.held_out_r2, knee().chosen().held_out.r2, 1e-9);
  EXPECT_EQ(loaded.coulomb_friction_Nm, robot.joints[1].coulomb_friction_Nm);
}

TEST(Fragment, AmperesAreRefusedWithTheRemedy) {
  IdentifiedJoint amperes = knee();
  for (auto& piece : amperes.result.training) piece.data.torque_unit = "A";
  try {
    identified_config(amperes, JointConfig(), sample_provenance());
    FAIL() << "was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("--torque-constant"));
  }
}

TEST(ResultReport, DrawsFrictionOverSpeedAndResidualsOverEverythingElse) {
  const report::Report found = result_report({knee()}, sample_provenance());
  ASSERT_EQ(found.sections.size(), 1u);
  const report::Section& section = found.sections[0];
  ASSERT_EQ(section.plots.size(), 5u);
  EXPECT_EQ(section.plots[0].series.size(), 2u);
  EXPECT_EQ(section.plots[0].series[0].x.size(), static_cast<std::size_t>(knee().chosen().held_out.samples));
  // Friction, and nothing else: at most Coulomb plus viscous at the fastest.
  for (const double torque_Nm : section.plots[0].series[1].y)
    EXPECT_LT(std::abs(torque_Nm), 6.0 + 3.0 * 1.0 + 0.5);
  EXPECT_THAT(report::to_html(found), HasSubstr("Residual over speed"));
  EXPECT_EQ(found.command, "sprung identify --log logs/knee.lcm");
}

}  // namespace
}  // namespace sprung::identify

#include "tools/logs/log/csv_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

using testing::ElementsAre;

using Lines = std::vector<std::string>;

class CsvExport : public testing::Test {
 protected:
  Lines csv(const std::vector<Kept>& events, const std::vector<std::string>& fields,
            const CsvOptions& options = {}, const std::string& from = "", const std::string& to = "") {
    write_all(path_, events);
    Reader reader(path_);
    std::string text;
    result_ = export_csv(reader, FieldSelection(fields, {{"joints", {"hip", "knee"}}}), options,
                         parse_span(from, to), [&text](std::string_view part) { text += part; });
    std::istringstream in(text);
    Lines lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
  CsvResult result_;
};

const std::string kTorque = "JOINT_STATE.joints[*].gear_output_torque_Nm";

TEST_F(CsvExport, ARowIsACycleWithUnitsInTheHeading) {
  const Lines lines = csv(robot_events(3), {kTorque, "MOTION_STATE.state_name"});
  EXPECT_THAT(lines, ElementsAre("time (s),cycle,JOINT_STATE.joints[0].gear_output_torque_Nm (Nm),"
                                 "JOINT_STATE.joints[1].gear_output_torque_Nm (Nm),MOTION_STATE.state_name",
                                 "0.000000,0,0,1,standing", "0.002000,1,0.01,1.01,walking",
                                 "0.004000,2,0.02,1.02,walking"));
  EXPECT_EQ(result_.rows, 3);
  EXPECT_EQ(result_.columns, 3u);
}

TEST_F(CsvExport, NumbersReadBackAsTheSameBits) {
  const Lines lines = csv(robot_events(200), {"JOINT_STATE.joints[0].gear_output_torque_Nm"});
  ASSERT_EQ(lines.size(), 201u);
  for (std::size_t k = 0; k < 200; ++k) {
    const std::string cell = lines[k + 1].substr(lines[k + 1].rfind(',') + 1);
    EXPECT_EQ(std::stod(cell), static_cast<double>(k) / 100.0);
  }
}

TEST_F(CsvExport, NanIsNanAndTruthsAreNumbers) {
  const Lines lines = csv({joint_event(8), joint_event(9)}, {"JOINT_STATE.joints[knee].gear_output_torque_Nm",
                                                             "JOINT_STATE.joints[1].at_rest"});
  EXPECT_THAT(lines[1], testing::EndsWith(",8,1.08,1"));
  EXPECT_THAT(lines[2], testing::EndsWith(",9,nan,0"));
}

TEST_F(CsvExport, CyclesThatCameInAnyOrderAndTwiceAreOneRowEach) {
  const std::vector<Kept> events{joint_event(0),
                                 joint_event(1),
                                 motion_event(0, "standing"),
                                 joint_event(1),
                                 motion_event(1, "walking"),
                                 motion_event(3, "late"),
                                 joint_event(2)};
  const Lines lines = csv(events, {"JOINT_STATE.joints[0].gear_output_torque_Nm", "MOTION_STATE.state_name"});
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[1], "0.000000,0,0,standing");
  EXPECT_EQ(lines[2], "0.002000,1,0.01,walking");
  EXPECT_EQ(lines[3], "0.006000,3,,late");
  EXPECT_EQ(lines[4], "0.004000,2,0.02,");
}

TEST_F(CsvExport, EachMessageMayHaveARow) {
  CsvOptions options;
  options.one_row_a_message = true;
  const Lines lines = csv({joint_event(0), motion_event(0, "standing"), joint_event(0)},
                          {"JOINT_STATE.joints[0].gear_output_torque_Nm", "MOTION_STATE.state_name"},
                          options);
  EXPECT_THAT(lines, ElementsAre(testing::_, "0.000000,0,0,", "0.000000,0,,standing", "0.000000,0,0,"));
}

TEST_F(CsvExport, ChannelsThatAreNotCyclicHaveRowsOfTheirOwn) {
  const Lines lines = csv({joint_event(0), safety_event(0, "damping", "none", ""), joint_event(1)},
                          {"JOINT_STATE.joints[0].gear_output_torque_Nm", "SAFETY_STATE.level_name"});
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[1], "0.000000,0,0,");
  EXPECT_THAT(lines[2], testing::EndsWith(",0,,damping"));
}

TEST_F(CsvExport, MoreRowsThanWaitComeOutAllTheSame) {
  EXPECT_EQ(csv(robot_events(1000), {kTorque}).size(), 1001u);
}

TEST_F(CsvExport, TextsThatNeedQuotesHaveThem) {
  const Lines lines = csv({motion_event(0, "a,b"), motion_event(1, "say \"no\"")},
                          {"MOTION_STATE.state_name"});
  EXPECT_THAT(lines[1], testing::EndsWith(",0,\"a,b\""));
  EXPECT_THAT(lines[2], testing::EndsWith(",1,\"say \"\"no\"\"\""));
}

TEST_F(CsvExport, HeadingsMayHaveTheNamesOfJoints) {
  CsvOptions options;
  options.joint_names = true;
  const Lines lines = csv({joint_event(0)}, {"JOINT_STATE.joints[1].gear_output_torque_Nm"}, options);
  EXPECT_EQ(lines[0], "time (s),cycle,JOINT_STATE.joints[knee].gear_output_torque_Nm (Nm)");
}

TEST_F(CsvExport, ASpanIsARangeOfRows) {
  const Lines lines = csv(robot_events(100), {"JOINT_STATE.joints[0].gear_output_torque_Nm"}, {}, "0.1",
                          "0.104");
  EXPECT_THAT(lines, ElementsAre(testing::_, "0.100000,50,0.5", "0.102000,51,0.51"));
}

TEST_F(CsvExport, WithoutFieldsEverythingIsThereAndAWrongNameGivesNoColumn) {
  csv(robot_events(2), {});
  EXPECT_GT(result_.columns, 60u);
  csv(robot_events(2), {"JOINT_STATE.no_such_field"});
  EXPECT_EQ(result_.columns, 0u);
  EXPECT_EQ(result_.rows, 0);
  EXPECT_THAT(result_.unmatched, ElementsAre("JOINT_STATE.no_such_field"));
}

TEST_F(CsvExport, MessagesOfMoreElementsLaterHaveTheirColumns) {
  auto larger = stamped<sprung_msgs::joint_state_t>(1);
  larger.n_joints = 3;
  larger.joints.resize(3);
  larger.joints[2].gear_output_torque_Nm = 9.0;
  const Lines lines = csv({joint_event(0), kept(channels::kJointState, 1, encoded(larger))}, {kTorque});
  EXPECT_EQ(lines[1], "0.000000,0,0,1,");
  EXPECT_EQ(lines[2], "0.002000,1,0,0,9");
}

TEST_F(CsvExport, WhatCannotBeDecodedIsCounted) {
  Kept broken = joint_event(1);
  broken.data.pop_back();
  csv({joint_event(0), broken}, {kTorque});
  EXPECT_EQ(result_.not_decoded, 1);
  EXPECT_EQ(result_.rows, 1);
}

}  // namespace
}  // namespace sprung::log

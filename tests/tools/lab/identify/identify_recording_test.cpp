#include "tools/lab/identify/identify_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/command_line.h"
#include "signals/messages.h"
#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/identify/identify_sample.h"
#include "tools/lab/identify/drive_series.h"

namespace sprung::identify {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string path_of(const char* name) { return test::temp_dir() + "identify_recording_" + name; }

/// What the drives of single_leg measure while the knee of the sample moves and the hip holds.
std::vector<DriveState> sample_states() {
  const RobotConfig robot = load_robot("single_leg");
  const ActuatorConfig& motor = robot.actuators[1];
  const identification::RawSeries series = sample_series({}, 0.0);
  std::vector<DriveState> out;
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    DriveState state(2);
    state.stamp.seq = static_cast<std::int64_t>(i);
    state.stamp.utime_us = static_cast<std::int64_t>(5000 * i);
    for (ActuatorState& a : state.actuators) {
      a.power_state = PowerState::kOperationEnabled;
      a.shown_mode = DriveMode::kTorque;
      a.referenced = true;
      a.measured_position_rad = 1.0;
      a.measured_current_A = 0.0;
    }
    state.actuators[1].measured_position_rad = series.position_rad[i];
    state.actuators[1].measured_current_A = series.measured_torque[i] /
                                            (motor.gear_ratio * motor.torque_constant_Nm_A);
    out.push_back(state);
  }
  return out;
}

/// @param session_of says of which run each message is.
template <class SessionOf>
std::string written_log(const char* name, const SessionOf& session_of) {
  const std::string path = path_of(name);
  std::remove(path.c_str());
  lcm::LogFile log(path, "w");
  sprung_msgs::drive_state_t message;
  std::int64_t number = 0;
  for (const DriveState& state : sample_states()) {
    to_message(state, session_of(number), message);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    if (number == 3) bytes.resize(17);  // cut off on its way
    lcm::LogEvent event{};
    event.eventnum = number++;
    event.timestamp = state.stamp.utime_us;
    event.channel = channels::kDriveState;
    event.datalen = static_cast<std::int32_t>(bytes.size());
    event.data = bytes.data();
    log.writeEvent(&event);
  }
  return path;
}

std::string plain_log() {
  return written_log("plain.lcm", [](std::int64_t) { return 7; });
}

RecordingRequest request_of(const std::string& log) {
  RecordingRequest out;
  out.logs = {log};
  out.robot = "single_leg";
  out.protocol.models = "coulomb,viscous";
  out.protocol.blocks = 4;
  return out;
}

template <class Error>
std::string refusal(const RecordingRequest& request) {
  return test::refusal_of<Error>([&] { identify_recording(request, {}); });
}

TEST(IdentifyRecording, LogGivesTheJointThatMovesAloneAndSaysWhyNotTheOther) {
  const Recording found = identify_recording(request_of(plain_log()), {});
  ASSERT_EQ(found.joints.size(), 1u);
  const IdentifiedJoint& knee = found.joints.front();
  EXPECT_EQ(knee.name, "knee");
  EXPECT_EQ(found.configs.front().name, "knee");
  EXPECT_EQ(knee.chosen().model->name(), "viscous");
  const FrictionParameters friction = knee.chosen().model->friction(knee.chosen().fit.parameters);
  EXPECT_NEAR(friction.coulomb_Nm, 6.0, 0.2);
  EXPECT_NEAR(friction.viscous_Nm_s_rad, 3.0, 0.2);
  ASSERT_TRUE(knee.armature);
  EXPECT_NEAR(knee.armature->value_kg_m2 + knee.armature->links_kg_m2, 0.75, 0.04);
  EXPECT_THAT(found.notes, Contains(HasSubstr("joint hip moves alone for only 0")));
  EXPECT_THAT(found.notes, Contains(HasSubstr("1 damaged messages left out")));
}

TEST(IdentifyRecording, EveryOtherTwentiethOfALogIsHeldOut) {
  const Recording found = identify_recording(request_of(plain_log()), {});
  EXPECT_EQ(found.joints[0].result.training.size(), 10u);
  const auto& chosen = found.joints[0].chosen();
  EXPECT_NEAR(static_cast<double>(chosen.train.samples), static_cast<double>(chosen.held_out.samples), 60.0);
}

TEST(IdentifyRecording, AccelerationsOfALogAreFittedOver25MillisecondsUnlessAskedOtherwise) {
  RecordingRequest request = request_of(plain_log());
  request.protocol.models = "viscous";
  const auto inertia_with = [&](double smoothing_s) {
    request.protocol.smoothing_s = smoothing_s;
    return identify_recording(request, {}).joints.front().armature.value().value_kg_m2;
  };
  const double by_default = inertia_with(0.0);
  EXPECT_EQ(by_default, inertia_with(0.025));
  EXPECT_NE(by_default, inertia_with(0.045));
}

TEST(IdentifyRecording, AllMeansEveryJoint) {
  RecordingRequest request = request_of(plain_log());
  request.all = true;
  EXPECT_THAT(refusal<std::runtime_error>(request), HasSubstr("joint hip"));
  request.all = false;
  request.joint = "hip";
  EXPECT_THAT(refusal<std::runtime_error>(request), HasSubstr("--record single_leg hip"));
}

TEST(IdentifyRecording, LaterSessionsOfALogAreLeftOutAloud) {
  const std::string path = written_log("sessions.lcm", [](std::int64_t i) { return i < 5000 ? 7 : 8; });
  const DriveLog log = read_drive_log(path, load_robot("single_leg"));
  EXPECT_EQ(log.states.size(), 4999u);
  EXPECT_THAT(log.notes, Contains(HasSubstr("1000 messages of later sessions")));
}

TEST(IdentifyRecording, WrongUseIsToldFromABadRecording) {
  EXPECT_THAT(refusal<WrongUse>({}), HasSubstr("--csv FILE --columns ..., or --log FILE"));
  RecordingRequest request = request_of(plain_log());
  request.joint = "elbow";
  EXPECT_THAT(refusal<WrongUse>(request), HasSubstr("single_leg has hip, knee"));
  request = request_of(plain_log());
  request.robot = "";
  EXPECT_THAT(refusal<WrongUse>(request), HasSubstr("does not say which robot"));
  request = request_of(plain_log());
  request.protocol.train = "0:0.5";
  EXPECT_THAT(refusal<WrongUse>(request), HasSubstr("belong together"));
  request = request_of(plain_log());
  request.robot = "pegasus";
  EXPECT_THAT(refusal<std::runtime_error>(request), HasSubstr("no DRIVE_STATE of pegasus"));
}

/// Time, motor angle over ratio, torque, link angle with two waves a turn of the motor and 20 kNm/rad.
std::string written_table() {
  const std::string path = path_of("table.csv");
  std::ofstream out(path);
  const identification::RawSeries series = sample_series({}, 0.0);
  out << "t;q;tau;link;load\n";
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    const double q = series.position_rad[i], load_Nm = 2.5 * std::sin(q);
    const double link_rad = q - load_Nm / 2e4 - 3e-4 * std::cos(2.0 * 100.0 * q);
    char line[200];
    std::snprintf(line, sizeof line, "%.6f;%.9f;%.6f;%.9f;%.6f\n", series.time_s[i], q,
                  series.measured_torque[i], link_rad, load_Nm);
    out << line;
  }
  return path;
}

RecordingRequest table_request() {
  RecordingRequest out;
  out.csv = written_table();
  out.columns = "time=t,position=q,torque=tau";
  out.drive.gear_ratio = 100.0;
  out.protocol.models = "viscous";
  return out;
}

TEST(IdentifyRecording, TableGivesAJointWithoutAName) {
  const Recording found = identify_recording(table_request(), {});
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_GT(found.joints[0].chosen().held_out.r2, 0.99);
  EXPECT_EQ(found.joints[0].result.training.size(), 1u);
  EXPECT_FALSE(found.joints[0].armature);
}

TEST(IdentifyRecording, FootprintTakesTheKinematicErrorOffAndFindsTheStiffness) {
  RecordingRequest request = table_request();
  request.columns += ",link_position=link,load=load";
  request.footprint = true;
  const Recording found = identify_recording(request, {});
  const FootprintResult& result = found.joints[0].footprint;
  ASSERT_EQ(result.size(), 2u);
  EXPECT_NEAR(result[0].held_out.rms, 3e-4 / std::sqrt(2.0), 3e-5);
  EXPECT_LT(result[1].held_out.rms, 1e-6);
  EXPECT_NEAR(result[1].stiffness_Nm_rad, 2e4, 200.0);
  EXPECT_LT(result[1].held_out_torque_rms_Nm, 0.05);
}

TEST(IdentifyRecording, FootprintWithoutASecondEncoderIsRefused) {
  RecordingRequest request = table_request();
  request.footprint = true;
  EXPECT_THAT(refusal<std::invalid_argument>(request), HasSubstr("second encoder"));
}

TEST(IdentifyRecording, TableWithoutColumnsIsWrongUse) {
  RecordingRequest request = table_request();
  request.columns = "";
  EXPECT_THAT(refusal<WrongUse>(request), HasSubstr("--csv needs --columns"));
  request.columns = "time=1";
  EXPECT_THAT(refusal<WrongUse>(request), HasSubstr("position"));
}

}  // namespace
}  // namespace sprung::identify

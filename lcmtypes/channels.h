#pragma once
/// Names of the LCM channels; content in the .lcm file of the same name, table in README.md.
namespace sprung::channels {
inline constexpr const char* kDriveState = "DRIVE_STATE";
inline constexpr const char* kDriveCommand = "DRIVE_COMMAND";
inline constexpr const char* kJointState = "JOINT_STATE";
inline constexpr const char* kLegCommand = "LEG_COMMAND";
inline constexpr const char* kMotionState = "MOTION_STATE";
inline constexpr const char* kSafetyState = "SAFETY_STATE";
inline constexpr const char* kOperatorCommand = "OPERATOR_COMMAND";
inline constexpr const char* kOperatorReply = "OPERATOR_REPLY";
inline constexpr const char* kProcessStatus = "PROCESS_STATUS";
inline constexpr const char* kBusState = "BUS_STATE";
inline constexpr const char* kBodyState = "BODY_STATE";
inline constexpr const char* kAuxiliaryState = "AUXILIARY_STATE";
inline constexpr const char* kCanTrace = "CAN_TRACE";
inline constexpr const char* kSimControl = "SIM_CONTROL";
inline constexpr const char* kSimTruth = "SIM_TRUTH";
inline constexpr const char* kImu = "IMU";
inline constexpr const char* kTorqueSensor = "TORQUE_SENSOR";
inline constexpr const char* kLogMetadata = "LOG_METADATA";
inline constexpr const char* kLogEnd = "LOG_END";
}  // namespace sprung::channels

#pragma once
/// An LCM type as protocol buffers describe it. Pure.
#include <string>

#include "tools/logs/fields/schema.h"

namespace sprung::log {

/// A google.protobuf.FileDescriptorSet (binary): a file for each struct, "sprung_msgs/joint_state_t.proto",
/// syntax proto3; those that others consist of come first. Members are numbered from 1 in their order. Units
/// and the definition's comments are the fields' comments (SourceCodeInfo). A struct that contains itself by
/// way of another cannot be told: files that import each other are refused by readers.
std::string proto_schema(const fields::StructType& type);

}  // namespace sprung::log

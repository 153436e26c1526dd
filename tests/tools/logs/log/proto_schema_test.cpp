/// FileDescriptorSets, read back by a small reader; tests/conformance has Google's library take them.
#include "tools/logs/log/proto_schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/tools/logs/log/proto_reader.h"
#include "tools/logs/fields/type_table.h"

namespace sprung::log {
namespace {

struct ReadField {
  std::uint64_t number = 0, label = 0, type = 0, packed = 0;
  std::string type_name, comment;
};

struct ReadFile {
  std::string name, package, message, syntax;
  std::vector<std::string> imports;
  std::map<std::string, ReadField> fields;
};

std::uint64_t number_in(const std::string& message, std::size_t field) {
  const auto values = proto_values(message, field);
  return values.empty() ? 0 : values[0].number;
}

ReadFile read_file(const std::string& bytes) {
  ReadFile file{proto_bytes(bytes, 1), proto_bytes(bytes, 2), "", proto_bytes(bytes, 12), {}, {}};
  for (const ProtoValue& import : proto_values(bytes, 3)) file.imports.push_back(import.bytes);
  const std::string message = proto_bytes(bytes, 4);
  file.message = proto_bytes(message, 1);
  std::vector<std::string> names;
  for (const ProtoValue& field : proto_values(message, 2)) {
    names.push_back(proto_bytes(field.bytes, 1));
    EXPECT_EQ(proto_bytes(field.bytes, 10), names.back());
    file.fields[names.back()] = {number_in(field.bytes, 3),   number_in(field.bytes, 4),
                                 number_in(field.bytes, 5),   number_in(proto_bytes(field.bytes, 8), 2),
                                 proto_bytes(field.bytes, 6), ""};
  }
  for (const ProtoValue& location : proto_values(proto_bytes(bytes, 9), 1)) {
    const std::string path = proto_bytes(location.bytes, 1);
    EXPECT_EQ(path.substr(0, 3), std::string("\x04\x00\x02", 3));
    file.fields[names.at(path.at(3))].comment = proto_bytes(location.bytes, 4);
  }
  return file;
}

std::vector<ReadFile> files_of(const fields::StructType& type) {
  std::vector<ReadFile> files;
  for (const ProtoValue& file : proto_values(proto_schema(type))) {
    EXPECT_EQ(file.field, 1u);
    files.push_back(read_file(file.bytes));
  }
  return files;
}

TEST(ProtoSchema, EveryTypeComesWithWhatItIsMadeOfBeforeIt) {
  for (const fields::StructType& type : fields::TypeTable::sprung().all()) {
    std::set<std::string> before;
    const auto files = files_of(type);
    for (const ReadFile& file : files) {
      EXPECT_EQ(file.package, "sprung_msgs");
      EXPECT_EQ(file.syntax, "proto3");
      EXPECT_EQ(file.name, "sprung_msgs/" + file.message + ".proto");
      for (const std::string& import : file.imports) EXPECT_EQ(before.count(import), 1u) << import;
      EXPECT_TRUE(before.insert(file.name).second) << file.name << " twice";
    }
    EXPECT_EQ(files.back().message, type.name);
    EXPECT_EQ(files.back().fields.size(), type.members.size());
  }
}

TEST(ProtoSchema, TellsNumbersTypesUnitsAndComments) {
  auto files = files_of(*fields::TypeTable::sprung().by_name("joint_state_t"));
  auto& state = files.back().fields;
  EXPECT_EQ(state["session"].number, 1u);
  EXPECT_EQ(state["joints"].number, 6u);
  EXPECT_EQ(state["joints"].label, 3u);
  EXPECT_EQ(state["joints"].type, 11u);
  EXPECT_EQ(state["joints"].type_name, ".sprung_msgs.estimated_joint_t");
  EXPECT_EQ(state["seq"].type, 16u);
  EXPECT_EQ(state["n_joints"].type, 15u);
  const auto of_joints = std::find_if(files.begin(), files.end(),
                                      [](const auto& file) { return file.message == "estimated_joint_t"; });
  ASSERT_NE(of_joints, files.end());
  auto& joint = of_joints->fields;
  EXPECT_EQ(joint["gear_output_torque_Nm"].type, 1u);
  EXPECT_EQ(joint["gear_output_torque_Nm"].label, 1u);
  EXPECT_EQ(joint["gear_output_torque_Nm"].comment.substr(0, 16), " Nm; what the li");
  EXPECT_EQ(joint["at_rest"].type, 8u);
  EXPECT_EQ(joint["status"].comment, " joint_status_t\n");
}

TEST(ProtoSchema, ListsOfNumbersArePackedBytesAreOneValue) {
  fields::TypeTable own;
  own.add({R"(struct part_t { int64_t n; }
    struct demo_t {
      double table[2][3]; byte data[8]; byte rows[2][8]; byte one; string names[2]; part_t parts[2];
      byte note[8];  // zero-terminated text
      float reals[2]; int16_t small;
    })"});
  auto files = files_of(*own.by_name("demo_t"));
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1].name, "demo_t.proto");
  EXPECT_EQ(files[1].package, "");
  auto& fields = files[1].fields;
  const auto expect = [&fields](const char* name, std::uint64_t type, bool list, bool packed) {
    EXPECT_EQ(fields[name].type, type) << name;
    EXPECT_EQ(fields[name].label, list ? 3u : 1u) << name;
    EXPECT_EQ(fields[name].packed, packed ? 1u : 0u) << name;
  };
  expect("table", 1, true, true);
  expect("data", 12, false, false);
  expect("rows", 12, true, false);
  expect("one", 7, false, false);
  expect("names", 9, true, false);
  expect("parts", 11, true, false);
  expect("note", 9, false, false);
  expect("reals", 2, true, true);
  expect("small", 15, false, false);
  EXPECT_EQ(fields["parts"].type_name, ".part_t");
}

}  // namespace
}  // namespace sprung::log

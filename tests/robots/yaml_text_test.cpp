#include "robots/yaml_text.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/robots/robot_dump.h"

namespace sprung {
namespace {

TEST(YamlText, IsBlocksAndWhatIsShortInOneLine) {
  EXPECT_EQ(yaml_text(parse_yaml("a: 1 m\nb: {x: 1, y: \"q \\\" r\"}\nc: [[1, 0], [0, 1]]\n"
                                 "d: [{name: p, e: {f: {g: 1}}}, {name: q}]\nempty: \"\"",
                                 "r.yaml")),
            "a: 1 m\nb: {x: 1, y: \"q \\\" r\"}\nc: [[1, 0], [0, 1]]\n"
            "d:\n  - name: p\n    e:\n      f: {g: 1}\n  - {name: q}\nempty: \"\"\n");
}

TEST(YamlText, SaysOfEachValueWhereItWasTypedOrThatItIsADefault) {
  const YamlMap file = YamlMap::parse(
      "mirror: {leg: l, left_right: r}\n"
      "j:\n"
      "  - all: {a: 1 m}\n"
      "  - {name: l_hip, m: {x: 1,\n"
      "     y: 2}}\n",
      "robots/x/robot.yaml");
  for (const YamlMap& entry : file.list("j")) entry.quantity_or("power", "W", 0, 9, 0.5);
  (void)file.has("gaits");
  EXPECT_EQ(explained_yaml_text(file),
            "j:\n"
            "  - name: l_hip                                             # robot.yaml:4\n"
            "    a: 1 m                                                  # robot.yaml:3\n"
            "    m:\n"
            "      x: 1                                                  # robot.yaml:4\n"
            "      y: 2                                                  # robot.yaml:5\n"
            "    # power: 0.5 W   (default)\n"
            "  # r_hip: mirror image of l_hip\n"
            "  - name: r_hip                                             # robot.yaml:4\n"
            "    a: 1 m                                                  # robot.yaml:3\n"
            "    m:\n"
            "      x: 1                                                  # robot.yaml:4\n"
            "      y: 2                                                  # robot.yaml:5\n"
            "    # power: 0.5 W   (default)\n"
            "# gaits: not given (optional)\n");
}

class TypedOut : public testing::TestWithParam<const char*> {};

TEST_P(TypedOut, ARobotIsTheSameRobot) {
  const YamlMap file = YamlMap::load(robot_folder(GetParam()) + "/robot.yaml");
  const std::string shipped = dump_of(load_robot(GetParam()));
  EXPECT_EQ(test::first_difference(shipped, dump_of(read_robot_text(yaml_text(file.tree()), "r.yaml"))), "");
  EXPECT_EQ(test::first_difference(shipped, dump_of(read_robot_text(explained_yaml_text(file), "r.yaml"))),
            "")
      << "comments and all";
}

INSTANTIATE_TEST_SUITE_P(Robots, TypedOut, testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

}  // namespace
}  // namespace sprung

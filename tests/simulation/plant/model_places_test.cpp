#include "simulation/plant/model_places.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung::sim {
namespace {

TEST(ModelPlaces, FindsTheElementOfANameAndNotACommentOrAnotherElement) {
  const std::string path = test::temp_dir() + "model_places.xml";
  std::ofstream(path)
      << "<mujoco>\n<!-- <body name=\"leg\">\n -->\n<joint name=\"leg\"/>\n<body pos=\"0 0 0\"\n"
         "  name=\"leg\"/>\n</mujoco>\n";
  const ModelPlaces places(path);
  EXPECT_EQ(places.of("joint", "leg"), path + ":4");
  EXPECT_EQ(places.of("body", "leg"), path + ":5");
  EXPECT_EQ(places.of("body", "tail"), path) << "it may stand in a file that this one includes";
}

TEST(ModelPlaces, AFileThatCannotBeReadHasNoLines) {
  EXPECT_EQ(ModelPlaces("/nowhere/model.xml").of("body", "base"), "/nowhere/model.xml");
}

}  // namespace
}  // namespace sprung::sim

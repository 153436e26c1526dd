#include "tools/operate/launcher/kept_overlay.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "robots/overlay.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

class KeptOverlayTest : public testing::Test {
 protected:
  KeptOverlayTest() {
    setenv("SPRUNG_RUN_DIR", (folder_ / "run").c_str(), 1);
    fs::copy(test::source_dir() + "/robots/pegasus/robot.yaml", folder_.path());
  }
  ~KeptOverlayTest() override { unsetenv("SPRUNG_RUN_DIR"); }
  double height_m() const { return load_robot(folder_.path()).preset("best").stand_length_m; }
  void save(const char* height) const {
    std::ofstream(folder_ / "overlay.yaml") << "presets: {best: {stand_length: " << height << "}}\n";
  }
  test::OwnFolder folder_{"kept"};
};

TEST_F(KeptOverlayTest, WhatIsSavedMeanwhileIsOfTheNextRun) {
  save("0.5 m");
  const RobotConfig began = load_robot(folder_.path());
  {
    const KeptOverlay kept("default", began);
    save("0.48 m");
    EXPECT_EQ(height_m(), 0.5);
    EXPECT_EQ(load_robot(folder_.path()).overlay_hash, began.overlay_hash);
    EXPECT_EQ(read_robot_text(robot_text(folder_.path()), "log").preset("best").stand_length_m, 0.5);
  }
  EXPECT_EQ(height_m(), 0.48);
}

TEST_F(KeptOverlayTest, RunThatBeganWithNoneHasNone) {
  const KeptOverlay kept("default", load_robot(folder_.path()));
  save("0.48 m");
  EXPECT_EQ(height_m(), 0.525);
  EXPECT_EQ(load_robot(folder_.path()).overlay_hash, 0);
}

}  // namespace
}  // namespace sprung

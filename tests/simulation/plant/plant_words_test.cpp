#include "simulation/plant/plant_words.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung {
namespace {

using Words = std::map<std::string, double>;

TEST(PlantWords, AreKeysAndNumbersButForFamiliesAndWorlds) {
  EXPECT_EQ(parse_plant({"slope=-0.1", "family=erob_50", "world=robots/w=1.yaml"}),
            (Words{{"slope", -0.1}, {"family.erob_50", 1.0}, {"world.robots/w=1.yaml", 1.0}}));
  for (const char* wrong : {"slope", "slope=", "=1", "slope=steep", "slope=nan", "world=", "family="})
    EXPECT_THROW(parse_plant({wrong}), std::invalid_argument) << wrong;
}

TEST(PlantWords, OfACommandAreWhatFollowsPlantAndWorld) {
  EXPECT_EQ(plant_of_command("sprung up pegasus --sim --world yard --plant draw=7 --plant wrong --seed 3"),
            (Words{{"world.yard", 1.0}, {"draw", 7.0}}));
  EXPECT_EQ(plant_of_command("sprung up pegasus --sim --world=yard --plant=draw=7 --preset=best"),
            (Words{{"world.yard", 1.0}, {"draw", 7.0}}));
  EXPECT_EQ(plant_of_command("sprung up pegasus --sim --plant"), Words{});
  EXPECT_EQ(plant_of_command(""), Words{});
}

TEST(PlantWords, AreWrittenAsTheyWereTyped) {
  const Words plant{{"draw", 7.0}, {"family.erob_50", 1.0}, {"slope", 0.1}, {"world.a/b.yaml", 1.0}};
  EXPECT_EQ(
      plant_text(plant),
      " --plant draw=7 --plant family=erob_50 --plant slope=0.10000000000000001 --plant world=a/b.yaml");
  EXPECT_EQ(plant_of_command("sprung up pegasus --sim" + plant_text(plant)), plant);
}

}  // namespace
}  // namespace sprung

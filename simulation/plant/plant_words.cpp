#include "simulation/plant/plant_words.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "simulation/plant/plant_draw.h"
#include "simulation/plant/world.h"

namespace sprung {

std::map<std::string, double> parse_plant(const std::vector<std::string>& texts) {
  std::map<std::string, double> plant;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (const char* named = text.rfind("family=", 0) == 0  ? sim::kFamilyKey
                            : text.rfind("world=", 0) == 0 ? sim::kWorldKey
                                                           : nullptr;
        named != nullptr && !number.empty()) {
      plant[named + number] = 1.0;
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (equals == 0 || number.empty() || *end != '\0' || !std::isfinite(value)) {
      throw std::invalid_argument(
          "--plant " + text + ": expected KEY=NUMBER, for example friction_scale=1.2; the number is finite");
    }
    plant[text.substr(0, equals)] = value;
  }
  return plant;
}

std::map<std::string, double> plant_of_command(const std::string& command_line) {
  std::map<std::string, double> plant;
  std::istringstream words(command_line);
  for (std::string word, before; words >> word; before = word) {
    // "--world NAME" or "--world=NAME"
    const std::size_t equals = word.rfind("--", 0) == 0 ? word.find('=') : std::string::npos;
    const std::string option = equals == std::string::npos ? before : word.substr(0, equals);
    const std::string value = equals == std::string::npos ? word : word.substr(equals + 1);
    const std::string text = option == "--world" ? "world=" + value : option == "--plant" ? value : "";
    if (text.empty()) continue;
    try {
      plant.merge(parse_plant({text}));
    } catch (const std::invalid_argument&) {  // of a newer sprung
    }
  }
  return plant;
}

std::string plant_text(const std::map<std::string, double>& plant) {
  std::string text;
  for (const auto& [key, value] : plant) {
    text += " --plant ";
    bool named = false;
    for (const char* prefix : {sim::kFamilyKey, sim::kWorldKey}) {
      const std::string begins(prefix);
      if (key.rfind(begins, 0) != 0) continue;
      text += begins.substr(0, begins.size() - 1) + "=" + key.substr(begins.size());
      named = true;
    }
    if (named) continue;
    char number[32];
    std::snprintf(number, sizeof number, "=%.17g", value);
    text += key + number;
  }
  return text;
}

}  // namespace sprung

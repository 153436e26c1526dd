#include "tools/station/page/page.h"

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sprung_embedded/station_app_js.h"
#include "sprung_embedded/station_footfalls_js.h"
#include "sprung_embedded/station_ground_js.h"
#include "sprung_embedded/station_html.h"
#include "sprung_embedded/station_layers_js.h"
#include "sprung_embedded/station_orbit_controls_js.h"
#include "sprung_embedded/station_plots_css.h"
#include "sprung_embedded/station_plots_js.h"
#include "sprung_embedded/station_robot_view_js.h"
#include "sprung_embedded/station_shapes_js.h"
#include "sprung_embedded/station_sharpness_js.h"
#include "sprung_embedded/station_source_js.h"
#include "sprung_embedded/station_style_css.h"
#include "sprung_embedded/station_three_js.h"
#include "sprung_embedded/station_timeline_js.h"
#include "sprung_embedded/station_uplot_css.h"
#include "sprung_embedded/station_uplot_js.h"

namespace sprung::station {

namespace {

struct Module {
  const char* name;  ///< by which the others import it
  const char* (*text)() noexcept;
};

constexpr std::array kModules = {Module{"three", station_three_js},
                                 Module{"orbit_controls", station_orbit_controls_js},
                                 Module{"uplot", station_uplot_js},
                                 Module{"source", station_source_js},
                                 Module{"shapes", station_shapes_js},
                                 Module{"sharpness", station_sharpness_js},
                                 Module{"ground", station_ground_js},
                                 Module{"robot_view", station_robot_view_js},
                                 Module{"layers", station_layers_js},
                                 Module{"plots", station_plots_js},
                                 Module{"footfalls", station_footfalls_js},
                                 Module{"timeline", station_timeline_js},
                                 Module{"app", station_app_js}};

/// Text in a script element of HTML: nothing in it may look like a tag.
std::string json_text(const nlohmann::json& json) {
  std::string out;
  for (const char letter : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    letter == '<' ? out += "\\u003c" : out += letter;
  return out;
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '<')
      out += "&lt;";
    else if (letter == '&')
      out += "&amp;";
    else
      out += letter;
  }
  return out;
}

/// Puts `text` where station.html has `mark`.
void put(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error("station.html has no " + mark);
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string make_page(const nlohmann::json& config, const std::string& data_base64) {
  std::string page = station_html();
  put(page, "{{title}}", html_text(config.value("title", "sprung")));
  put(page, "{{style}}", std::string(station_uplot_css()) + station_plots_css() + station_style_css());
  std::string modules;
  for (const Module& module : kModules) {
    modules += "<script type=\"text/plain\" data-module=\"" + std::string(module.name) + "\">" +
               module.text() + "</script>\n";
  }
  put(page, "{{modules}}", modules);
  put(page, "{{config}}", json_text(config));
  put(page, "{{data}}", data_base64);
  return page;
}

}  // namespace sprung::station

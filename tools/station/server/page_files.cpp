#include "tools/station/server/page_files.h"

#include <array>

#include "sprung_embedded/console_commands_js.h"
#include "sprung_embedded/console_css.h"
#include "sprung_embedded/console_driving_js.h"
#include "sprung_embedded/console_html.h"
#include "sprung_embedded/console_link_js.h"
#include "sprung_embedded/console_live_plots_js.h"
#include "sprung_embedded/console_live_source_js.h"
#include "sprung_embedded/console_main_js.h"
#include "sprung_embedded/console_panels_js.h"
#include "sprung_embedded/console_parameters_js.h"
#include "sprung_embedded/console_view_js.h"
#include "sprung_embedded/station_ground_js.h"
#include "sprung_embedded/station_layers_js.h"
#include "sprung_embedded/station_orbit_controls_js.h"
#include "sprung_embedded/station_plots_css.h"
#include "sprung_embedded/station_plots_js.h"
#include "sprung_embedded/station_robot_view_js.h"
#include "sprung_embedded/station_shapes_js.h"
#include "sprung_embedded/station_sharpness_js.h"
#include "sprung_embedded/station_source_js.h"
#include "sprung_embedded/station_three_js.h"
#include "sprung_embedded/station_uplot_css.h"
#include "sprung_embedded/station_uplot_js.h"

namespace sprung::station {
namespace {

constexpr const char* kScript = "text/javascript; charset=utf-8";
constexpr const char* kStyle = "text/css; charset=utf-8";

struct NamedFile {
  std::string_view path;
  WebFile file;
};

}  // namespace

std::string console_page(const std::string& nonce) {
  constexpr std::string_view kPlace = "{{nonce}}";
  std::string page = console_html();
  const std::size_t at = page.find(kPlace);
  return at == std::string::npos ? page : page.replace(at, kPlace.size(), nonce);
}

const WebFile* console_file(std::string_view path) {
  static const std::array files{
      NamedFile{"console.css", {kStyle, console_css()}},
      NamedFile{"main.js", {kScript, console_main_js()}},
      NamedFile{"link.js", {kScript, console_link_js()}},
      NamedFile{"panels.js", {kScript, console_panels_js()}},
      NamedFile{"parameters.js", {kScript, console_parameters_js()}},
      NamedFile{"commands.js", {kScript, console_commands_js()}},
      NamedFile{"driving.js", {kScript, console_driving_js()}},
      NamedFile{"live_plots.js", {kScript, console_live_plots_js()}},
      NamedFile{"live_source.js", {kScript, console_live_source_js()}},
      NamedFile{"view.js", {kScript, console_view_js()}},
      // The log's page has these too; they import each other by the names of index.html's import map.
      NamedFile{"lib/three.js", {kScript, station_three_js()}},
      NamedFile{"lib/orbit_controls.js", {kScript, station_orbit_controls_js()}},
      NamedFile{"lib/ground.js", {kScript, station_ground_js()}},
      NamedFile{"lib/robot_view.js", {kScript, station_robot_view_js()}},
      NamedFile{"lib/shapes.js", {kScript, station_shapes_js()}},
      NamedFile{"lib/sharpness.js", {kScript, station_sharpness_js()}},
      NamedFile{"lib/source.js", {kScript, station_source_js()}},
      NamedFile{"lib/layers.js", {kScript, station_layers_js()}},
      NamedFile{"lib/plots.js", {kScript, station_plots_js()}},
      NamedFile{"lib/plots.css", {kStyle, station_plots_css()}},
      NamedFile{"lib/uplot.js", {kScript, station_uplot_js()}},
      NamedFile{"lib/uplot.css", {kStyle, station_uplot_css()}},
  };
  for (const NamedFile& each : files)
    if (each.path == path) return &each.file;
  return nullptr;
}

}  // namespace sprung::station

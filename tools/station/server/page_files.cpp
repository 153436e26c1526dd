#include "tools/station/server/page_files.h"

#include <array>

#include "sprung_embedded/console_commands_js.h"
#include "sprung_embedded/console_css.h"
#include "sprung_embedded/console_driving_js.h"
#include "sprung_embedded/console_html.h"
#include "sprung_embedded/console_link_js.h"
#include "sprung_embedded/console_main_js.h"
#include "sprung_embedded/console_panels_js.h"

namespace sprung::station {
namespace {

constexpr const char* kHtml = "text/html; charset=utf-8";
constexpr const char* kScript = "text/javascript; charset=utf-8";
constexpr const char* kStyle = "text/css; charset=utf-8";

struct NamedFile {
  std::string_view path;
  WebFile file;
};

}  // namespace

const WebFile* console_file(std::string_view path) {
  static const std::array<NamedFile, 7> files{{
      {"", {kHtml, console_html()}},
      {"console.css", {kStyle, console_css()}},
      {"main.js", {kScript, console_main_js()}},
      {"link.js", {kScript, console_link_js()}},
      {"panels.js", {kScript, console_panels_js()}},
      {"commands.js", {kScript, console_commands_js()}},
      {"driving.js", {kScript, console_driving_js()}},
  }};
  for (const NamedFile& each : files)
    if (each.path == path) return &each.file;
  return nullptr;
}

}  // namespace sprung::station

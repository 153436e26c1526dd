#pragma once
/// The page of the station, one file for a log and for a live robot: all of its script and style is in it, so
/// that a browser asks nothing of anybody. Pure.
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sprung::station {

/// @param config what app.js begins with:
/// ```
/// {"mode": "log" or "live", "title": "...", "version": "0.1.0 (abc)",
///  "scene": scene.h's, or null with "scene_missing": "why",
///  "layout": frame_layout.h's,
///  "notes": ["what the reader of the page must know", ...],
///  "events": [{"time_s", "kind", "text", "trip": bool}], "phases": [{"from_s", "to_s", "name"}],
///  "data": log_columns.h's, of a log alone}
/// ```
/// @param data_base64 of a log, log_columns.h; "" where there is none.
std::string make_page(const nlohmann::json& config, const std::string& data_base64 = "");

}  // namespace sprung::station

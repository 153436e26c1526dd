#pragma once
/// The page of a log, one file: all of its script and style is in it, so that a browser asks nothing of
/// anybody. The live page has its own frame (server/page_files.h), and its modules from here. Pure.
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sprung::station {

/// @param config what app.js begins with:
/// ```
/// {"title": "...", "version": "0.1.0 (abc)",
///  "scene": scene.h's, or null with "scene_missing": "why",
///  "layout": frame_layout.h's,
///  "notes": ["what the reader of the page must know", ...],
///  "events": [{"time_s", "kind", "text", "trip": bool}], "phases": [{"from_s", "to_s", "name"}],
///  "data": log_columns.h's}
/// ```
/// @param data_base64 log_columns.h
std::string make_page(const nlohmann::json& config, const std::string& data_base64);

}  // namespace sprung::station

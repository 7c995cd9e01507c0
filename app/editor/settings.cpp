// SPDX-License-Identifier: MIT
#include "app/editor/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/io/safe_file.h"

namespace elbowroom {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& object, const char* key, double otherwise, double low, double high) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return otherwise;
  const double value = found->get<double>();
  return std::isfinite(value) ? std::clamp(value, low, high) : otherwise;
}

bool flag(const Json& object, const char* key, bool otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_boolean() ? found->get<bool>() : otherwise;
}

}  // namespace

std::filesystem::path settings_file() {
  std::filesystem::path folder;
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
    folder = config;
  else if (const char* home = std::getenv("HOME"); home && *home)
    folder = std::filesystem::path(home) / ".config";
  return folder.empty() ? folder : folder / "elbowroom" / "settings.json";
}

Settings read_settings(const std::filesystem::path& file) {
  Settings settings;
  const auto text = read_whole_file(file, 1 << 20);
  if (!text) return settings;
  const Json root = Json::parse(*text, nullptr, false);
  if (!root.is_object()) return settings;
  ViewState& view = settings.view;
  const auto share = [&](const char* key, float& value) {
    value = static_cast<float>(number(root, key, static_cast<double>(value), 0.08, 0.6));
  };
  share("outliner_share", view.outliner_share);
  share("inspector_share", view.inspector_share);
  share("timeline_share", view.timeline_share);
  view.scale = number(root, "scale", 1, 0.75, 3);
  view.light_theme = flag(root, "light_theme", false);
  view.frames = flag(root, "frames", false);
  view.show_trails = flag(root, "show_trails", true);
  view.show_limb = flag(root, "show_limb", true);
  view.navigation = flag(root, "maya", false) ? Navigation::maya : Navigation::blender;
  settings.window_width = static_cast<int>(number(root, "window_width", 1600, 640, 8192));
  settings.window_height = static_cast<int>(number(root, "window_height", 1000, 480, 8192));
  if (const auto recent = root.find("recent_files"); recent != root.end() && recent->is_array())
    for (const auto& entry : *recent)
      if (entry.is_string() && settings.recent_files.size() < 50)
        settings.recent_files.push_back(entry.get<std::string>());
  return settings;
}

Status write_settings(const std::filesystem::path& file, const Settings& settings) {
  if (file.empty()) return Done{};
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error)
    return Error{"the folder for settings cannot be made: " + error.message(),
                 file.parent_path().string(), "check its permissions"};
  const ViewState& view = settings.view;
  Json root;
  root["outliner_share"] = view.outliner_share;
  root["inspector_share"] = view.inspector_share;
  root["timeline_share"] = view.timeline_share;
  root["scale"] = view.scale;
  root["light_theme"] = view.light_theme;
  root["frames"] = view.frames;
  root["show_trails"] = view.show_trails;
  root["show_limb"] = view.show_limb;
  root["maya"] = view.navigation == Navigation::maya;
  root["window_width"] = settings.window_width;
  root["window_height"] = settings.window_height;
  root["recent_files"] = settings.recent_files;
  return write_file_safely(file, root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace elbowroom

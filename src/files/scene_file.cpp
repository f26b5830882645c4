#include "files/scene_file.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "core/file.h"

namespace mimicx::files {
namespace {

using record::Json;

constexpr std::array<const char*, 6> kMembers = {"centre", "yaw",       "half_extents",
                                                 "height", "stiffness", "damping"};

Json pair_of(const Eigen::Vector2d& v) { return std::vector<double>{v.x(), v.y()}; }

Eigen::Vector2d pair_from(const Json& json) {
  const auto values = json.get<std::array<double, 2>>();
  return {values[0], values[1]};
}

/// @throws record::JsonError
Plate plate_from(const Json& json) {
  for (const auto& [name, value] : json.items())
    if (std::find(kMembers.begin(), kMembers.end(), name) == kMembers.end())
      throw record::JsonError("unknown member \"" + name + '"');
  Plate plate;
  plate.centre = pair_from(json.at("centre"));
  plate.half_extents = pair_from(json.at("half_extents"));
  plate.height = json.at("height").get<double>();
  plate.yaw = json.value("yaw", plate.yaw).get<double>();
  plate.stiffness = json.value("stiffness", plate.stiffness).get<double>();
  plate.damping = json.value("damping", plate.damping).get<double>();
  return plate;
}

}  // namespace

Scene scene_from(const std::string& text, const std::string& name) {
  Scene scene;
  std::string place;
  try {
    const Json json = Json::parse(text);
    for (const auto& [member, value] : json.items())
      if (member != "plates" && member != "made_by")
        throw record::JsonError("unknown member \"" + member + '"');
    for (const Json& plate : json.at("plates").elements()) {
      place = "plate " + std::to_string(scene.plates.count() + 1);
      scene.plates.push_back(plate_from(plate));
    }
  } catch (const record::JsonError& error) {
    throw DataError(name, place, "a scene (docs/scenes.md)", error.what());
  }
  require_scene(scene, name);
  return scene;
}

Scene read_scene(const std::filesystem::path& path) { return scene_from(read_file(path), path.string()); }

Json scene_json(const Scene& scene) {
  Json plates = Json::array();
  for (const Plate& p : scene.plates)
    plates.push_back({{"centre", pair_of(p.centre)},
                      {"yaw", p.yaw},
                      {"half_extents", pair_of(p.half_extents)},
                      {"height", p.height},
                      {"stiffness", p.stiffness},
                      {"damping", p.damping}});
  return {{"plates", plates}};
}

void write_scene(const std::filesystem::path& path, const Scene& scene) {
  write_file_atomically(path, record::document(scene_json(scene)));
}

}  // namespace mimicx::files

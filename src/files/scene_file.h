/// Scenes as JSON, the files of `--scene`.                                       docs/scenes.md, "The file"
///
///     {"plates": [{"centre": [1.2, 0], "yaw": 0, "half_extents": [0.15, 0.5], "height": 0.17}]}
///
/// Metres, radians; `yaw`, `stiffness` (N/m) and `damping` (N·s/m) may be absent and have the values of
/// `Plate`.
#pragma once

#include <filesystem>
#include <string>

#include "character/scene.h"
#include "record/json.h"

namespace mimicx::files {

/// @throws DataError naming file, plate and member
Scene read_scene(const std::filesystem::path& path);
/// The same from a text. @param name  for messages
Scene scene_from(const std::string& text, const std::string& name);
/// {"plates": […]}, with all members of every plate.
record::Json scene_json(const Scene& scene);
void write_scene(const std::filesystem::path& path, const Scene& scene);

}  // namespace mimicx::files

/// Files for other programs, chosen by the suffix: .glb (gltf.h), .mot and .sto (opensim.h), .csv (csv.h).
///
/// These are written only: what reads motions (import) does not know them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::files {

enum class Skin { kMannequin, kShapes };

struct ExchangeConfig {
  Skin skin = Skin::kMannequin;  ///< of a .glb
  bool arrows = false;           ///< the forces of the floor in a .glb
  /// Why forces that the file may hold are not those of the clip; empty: they are.
  std::string forces_lost;
};

bool is_exchanged(const std::filesystem::path& path);
/// ".glb, .mot, .sto or .csv"
std::string exchanged_suffixes();

/// How the files of a suffix begin that are written here, and at which byte.
struct Opening {
  std::string_view text;
  std::size_t at = 0;
};
Opening exchange_opening(const std::filesystem::path& path);

/// @param source  the file that the clip was read from, for messages
/// @throws DataError where forces are asked for and there are none
void write_exchange(const std::filesystem::path& path, const motion::Clip& clip, const std::string& source,
                    const ExchangeConfig& config);

}  // namespace mimicx::files

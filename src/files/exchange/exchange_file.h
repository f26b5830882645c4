/// Files for other programs; the suffix chooses the format: .glb (gltf.h), .mot and .sto (opensim.h), .csv
/// (csv.h).
///
/// These formats are only written; src/import does not read them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::files {

enum class Skin { kMannequin, kShapes };

struct ExchangeConfig {
  Skin skin = Skin::kMannequin;  ///< of a .glb
  bool arrows = false;           ///< the forces of the floor in a .glb
  /// Why the file's forces do not belong to the clip, for example after resampling; empty: they do.
  std::string forces_lost;
};

bool is_exchanged(const std::filesystem::path& path);
/// Of all files that a motion is written to, for messages: ".npz, .npy, …, .sto or .csv".
std::string motion_suffixes();

/// The first bytes of the files of a suffix, and their offset.
struct Opening {
  std::string_view text;
  std::size_t at = 0;
};
Opening exchange_opening(const std::filesystem::path& path);

/// @param source  the file that the clip was read from, for messages
/// @throws DataError if the format needs forces and the clip has none
void write_exchange(const std::filesystem::path& path, const motion::Clip& clip, const std::string& source,
                    const ExchangeConfig& config);

}  // namespace mimicx::files

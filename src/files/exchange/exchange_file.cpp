#include "files/exchange/exchange_file.h"

#include "core/file.h"
#include "files/exchange/csv.h"
#include "files/exchange/glb.h"
#include "files/exchange/gltf.h"
#include "files/exchange/opensim.h"
#include "import/motion_file.h"
#include "skin/mannequin.h"
#include "skin/shapes.h"

namespace mimicx::files {

bool is_exchanged(const std::filesystem::path& path) { return !exchange_opening(path).text.empty(); }

std::string motion_suffixes() { return ".npz, .npy, .bvh, .glb, .mot, .sto or .csv"; }

Opening exchange_opening(const std::filesystem::path& path) {
  const std::string suffix = import::lower_suffix(path);
  if (suffix == ".glb") return {Glb::kJsonOpening, Glb::kJsonAt};
  if (suffix == ".mot") return {kMotOpening};
  if (suffix == ".sto") return {kStoOpening};
  if (suffix == ".csv") return {kCsvOpening};
  return {};
}

void write_exchange(const std::filesystem::path& path, const motion::Clip& clip, const std::string& source,
                    const ExchangeConfig& config) {
  const std::string suffix = import::lower_suffix(path);
  const bool lost = !config.forces_lost.empty();
  const std::optional<RecordedForces> forces = lost ? std::nullopt : recorded_forces(clip, source);
  if (!forces && (suffix == ".mot" || suffix == ".sto" || (suffix == ".glb" && config.arrows)))
    throw DataError(source, "", "a motion with forces",
                    lost ? config.forces_lost : "none: mimicx plan writes motions with forces");
  if (forces && clip.frames() < 2)
    throw DataError(source, "", "at least 2 frames", std::to_string(clip.frames()));
  if (suffix == ".mot") return write_file_atomically(path, format_mot(clip, *forces));
  if (suffix == ".sto") return write_file_atomically(path, format_sto(clip, *forces));
  if (suffix == ".csv") return write_file_atomically(path, format_csv(clip, forces));
  const Character character = motion::character_of(clip);
  const skin::Mesh mesh =
      config.skin == Skin::kShapes ? skin::collision_shapes(character) : skin::mannequin(character);
  write_file_atomically(path, format_glb(clip, mesh, config.arrows ? &*forces : nullptr));
}

}  // namespace mimicx::files

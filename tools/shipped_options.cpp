#include "shipped_options.h"

#include <cstdlib>
#include <optional>
#include <system_error>

#include "commands.h"

namespace mimicx::tools {
namespace {

constexpr const char* kTrained = "trained";  ///< by `mimicx pretrain`; in the folder itself
constexpr const char* kTaught = "taught";    ///< by plans; in the folder of this name

constexpr const char* kOptionsFile = "options.npz";

/// The folder of the sets: in MIMICX_DATA where that is set; else beside the program or in a folder above it,
/// as in a source tree (data/options) or as installed (share/mimicx/options).
/// @throws UsageError where MIMICX_DATA holds none
std::optional<std::filesystem::path> shipped_options() {
  if (const char* data = std::getenv("MIMICX_DATA"); data != nullptr && *data != '\0') {
    const std::filesystem::path options = std::filesystem::path(data) / "options";
    if (std::filesystem::exists(options / kOptionsFile)) return options;
    throw UsageError(std::string("MIMICX_DATA: expected a folder with options/options.npz, found ") + data);
  }
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::filesystem::path at = program.parent_path(); !error && at != at.root_path();
       at = at.parent_path())
    for (const char* place : {"data/options", "share/mimicx/options"})
      if (std::filesystem::exists(at / place / kOptionsFile)) return at / place;
  return std::nullopt;
}

}  // namespace

std::vector<std::filesystem::path> shipped_sets() {
  std::vector<std::filesystem::path> sets;
  const auto shipped = shipped_options();
  if (shipped) sets.push_back(*shipped);
  if (shipped && std::filesystem::exists(*shipped / kTaught)) sets.push_back(*shipped / kTaught);
  return sets;
}

std::filesystem::path options_named(const std::filesystem::path& given) {
  const auto shipped = shipped_options();
  if (!shipped || std::filesystem::exists(given)) return given;
  if (given == kTrained) return *shipped;
  return std::filesystem::exists(*shipped / given) ? *shipped / given : given;
}

std::vector<std::filesystem::path> shipped_clusters() {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& set : shipped_sets()) {
    if (!std::filesystem::exists(set / "clusters.json")) return {};
    files.push_back(set / "clusters.json");
  }
  return files;
}

}  // namespace mimicx::tools

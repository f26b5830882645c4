#include "shipped_options.h"

#include <optional>
#include <system_error>

namespace mimicx::tools {
namespace {

constexpr const char* kTrained = "trained";  ///< by `mimicx pretrain`; in the folder itself
constexpr const char* kTaught = "taught";    ///< by plans; in the folder of this name

/// data/options of the source tree that holds this program, or of the working folder.
std::optional<std::filesystem::path> shipped_options() {
  const std::filesystem::path relative = std::filesystem::path("data") / "options";
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::filesystem::path at = program.parent_path(); !error && at != at.root_path();
       at = at.parent_path())
    if (std::filesystem::exists(at / relative / "options.npz")) return at / relative;
  if (std::filesystem::exists(relative / "options.npz")) return relative;
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

#include "shipped_options.h"

#include <system_error>

namespace mimicx::tools {

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

std::filesystem::path shipped_clusters() {
  const auto options = shipped_options();
  return options && std::filesystem::exists(*options / "clusters.json") ? *options / "clusters.json"
                                                                        : std::filesystem::path();
}

}  // namespace mimicx::tools

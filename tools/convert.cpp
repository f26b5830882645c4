#include <iostream>

#include "commands.h"
#include "motion/clip.h"

namespace mimicx {

int run_convert(const std::filesystem::path& in, const std::filesystem::path& out) {
  for (const auto& path : {in, out})
    if (path.extension() != ".npz")
      throw UsageError(path.string() + ": convert reads and writes .npz in the AMASS layout, not '" +
                       path.extension().string() + "'");
  const Clip clip = read_clip(in);
  for (const auto& warning : clip.warnings) std::cerr << in.string() << ": " << warning << '\n';
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  write_clip(out, clip);
  return kAllGood;
}

}  // namespace mimicx

#include <iostream>

#include "commands.h"
#include "motion/import/motion_file.h"
#include "motion/resample.h"
#include "pipeline/output/qpos.h"
#include "pipeline/preparation.h"

namespace mimicx {

int run_convert(const std::filesystem::path& in, const std::filesystem::path& out, const ReadConfig& read,
                double fps) {
  if (!is_written(out.extension().string()))
    throw UsageError(out.string() + ": motions are written as " + written_suffixes() + ", not '" +
                     out.extension().string() + "'");
  Clip clip = read_motion(in, read);
  if (fps > 0.0) clip = resampled(clip, fps);
  tell_decisions(in.string(), clip, std::cerr);
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  if (out.stem().extension() == ".qpos" && lower_suffix(out) == ".npz")
    write_qpos(out, clip);
  else
    write_motion(out, clip);
  return kAllGood;
}

}  // namespace mimicx

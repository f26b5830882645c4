#include "pipeline/output/clean_copy.h"

#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx {

std::string clean_suffix(const std::filesystem::path& input) {
  const std::string suffix = lower_suffix(input);
  return is_written(suffix) ? suffix : ".npz";
}

Clip at_rate_of(const Clip& motion, const Clip& like) {
  Clip out = resampled(motion, like.fps);
  out.rotations.resize(like.rotations.size(), out.rotations.back());
  out.trans.resize(like.trans.size(), out.trans.back());
  out.keypoints = like.keypoints;
  out.passthrough = like.passthrough;
  return out;
}

void write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                      const ReadConfig& read, bool input_rate, const std::filesystem::path& copy) {
  const Clip original = read_motion(input, read);
  Clip clean = read_clip(motion);
  if (input_rate && original.fps != clean.fps) clean = at_rate_of(clean, original);
  put_on_body_of(original, clean);
  if (copy.has_parent_path()) std::filesystem::create_directories(copy.parent_path());
  write_motion(copy, clean);
}

}  // namespace mimicx

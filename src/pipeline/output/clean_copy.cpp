#include "pipeline/output/clean_copy.h"

#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx::pipeline::output {

std::string clean_suffix(const std::filesystem::path& input) {
  const std::string suffix = motion::import::lower_suffix(input);
  return motion::import::is_written(suffix) ? suffix : ".npz";
}

motion::Clip at_rate_of(const motion::Clip& motion, const motion::Clip& like) {
  motion::Clip out = motion::resampled(motion, like.fps);
  out.rotations.resize(like.rotations.size(), out.rotations.back());
  out.trans.resize(like.trans.size(), out.trans.back());
  out.keypoints = like.keypoints;
  out.passthrough = like.passthrough;
  return out;
}

void write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                      const motion::import::ReadConfig& read, bool input_rate,
                      const std::filesystem::path& copy) {
  const motion::Clip original = motion::import::read_motion(input, read);
  motion::Clip clean = motion::read_clip(motion);
  if (input_rate && original.fps != clean.fps) clean = at_rate_of(clean, original);
  motion::put_on_body_of(original, clean);
  if (copy.has_parent_path()) std::filesystem::create_directories(copy.parent_path());
  motion::import::write_motion(copy, clean);
}

}  // namespace mimicx::pipeline::output

#include "files/clean_copy.h"

#include "core/file.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx::files {
namespace {

/// Chooses the body of a copy. @return a message that says which
std::string settle_body(const motion::Clip& original, motion::Clip& clean) {
  if (original.body_model == clean.body_model && original.rest_joints == clean.rest_joints)
    return "on the simulated body";
  motion::put_on_body_of(original, clean);
  remove_recorded(clean);
  return "on the input's body, " + original.body_model +
         "; joints and forces stand beside the simulated body";
}

}  // namespace

std::string clean_suffix(const std::filesystem::path& input) {
  const std::string suffix = import::lower_suffix(input);
  const bool written = import::is_written(suffix) && !import::holds_positions(input);
  return written ? suffix : ".npz";
}

motion::Clip at_rate_of(const motion::Clip& motion, const motion::Clip& like) {
  motion::Clip out = motion::resampled(motion, like.fps);
  out.rotations.resize(like.rotations.size(), out.rotations.back());
  out.trans.resize(like.trans.size(), out.trans.back());
  out.keypoints = like.keypoints;
  out.passthrough = like.passthrough;
  return out;
}

std::string write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                             const import::ReadConfig& read, bool input_rate,
                             const std::filesystem::path& copy) {
  const motion::Clip original = import::read_motion(input, read);
  motion::Clip clean = motion::read_clip(motion);
  if (input_rate && original.fps != clean.fps) clean = at_rate_of(clean, original);
  const std::string body = settle_body(original, clean);
  make_folder(copy.parent_path());
  import::write_motion(copy, clean);
  return body;
}

}  // namespace mimicx::files

#include "files/clean_copy.h"

#include <algorithm>

#include "core/file.h"
#include "core/so3.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx::files {
namespace {

/// Mean height of the lower foot's joint, m
double height_of_feet(const motion::Clip& clip) {
  double sum = 0.0;
  for (const BodyPoses& pose : motion::poses_of(clip))
    sum += std::min(pose.p_WB[kLeftFoot].z(), pose.p_WB[kRightFoot].z());
  return sum / std::max(clip.frames(), 1);
}

/// Chooses the body of a copy.
CleanCopy settle_body(const motion::Clip& original, motion::Clip& clean) {
  if (original.body_model == clean.body_model && original.rest_joints == clean.rest_joints)
    return {"on the simulated body", 0.0};
  const double simulated = height_of_feet(clean);
  motion::put_on_body_of(original, clean);
  remove_recorded(clean);
  return {
      "on the input's body, " + original.body_model + "; joints and forces stand beside the simulated body",
      height_of_feet(clean) - simulated};
}

/// Leaves out the last frames, or goes on at the velocities of the last two.
void set_frames(motion::Clip& clip, std::size_t frames) {
  const motion::Clip before = clip;
  const int last = before.frames() - 1, other = std::max(last - 1, 0);
  clip.rotations.resize(frames);
  clip.trans.resize(frames);
  for (int t = last + 1; t < clip.frames(); ++t) {
    const double share = t - other;  // frame `other` is 0, `last` is 1
    for (int j = 0; j < kBodies; ++j)
      clip.rotations[t][j] =
          log_map(slerp(exp_map(before.rotations[other][j]), share, exp_map(before.rotations[last][j])));
    clip.trans[t] = before.trans[other] + share * (before.trans[last] - before.trans[other]);
  }
}

}  // namespace

std::string clean_suffix(const std::filesystem::path& input) {
  const std::string suffix = import::lower_suffix(input);
  const bool written = import::is_written(suffix) && !import::holds_positions(input);
  return written ? suffix : ".npz";
}

motion::Clip at_rate_of(const motion::Clip& motion, const motion::Clip& like) {
  motion::Clip out = motion::resampled(motion, like.fps);
  set_frames(out, like.rotations.size());
  out.keypoints = like.keypoints;
  out.passthrough = like.passthrough;
  return out;
}

CleanCopy write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                           const import::ReadConfig& read, bool input_rate,
                           const std::filesystem::path& copy) {
  const motion::Clip original = import::read_motion(input, read);
  motion::Clip clean = motion::read_clip(motion);
  if (input_rate && original.fps != clean.fps) clean = at_rate_of(clean, original);
  const CleanCopy written = settle_body(original, clean);
  make_folder(copy.parent_path());
  import::write_motion(copy, clean);
  return written;
}

}  // namespace mimicx::files

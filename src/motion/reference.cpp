#include "motion/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/units.h"
#include "motion/feet.h"
#include "motion/repair.h"
#include "motion/surface.h"

namespace mimicx {
namespace {

constexpr double kOddFloorShift = 1.0;  ///< m
constexpr double kOddSpeed = 10.0;      ///< m/s, mean of the pelvis
constexpr double kUpright = 0.3;        ///< vertical component of the pelvis' up axis
constexpr double kOddLyingShare = 0.8;

std::string text(const char* format, double value) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Largest and mean distance of the joints of two motions, mm.
struct Distance {
  double mean = 0, max = 0;
};
Distance distance_mm(const std::vector<BodyPoses>& a, const std::vector<BodyPoses>& b) {
  Distance d;
  for (std::size_t t = 0; t < a.size(); ++t)
    for (std::size_t j = 0; j < kBodies; ++j) {
      const double mm = kMm * (a[t].p_WB[j] - b[t].p_WB[j]).norm();
      d.mean += mm / static_cast<double>(a.size() * kBodies);
      d.max = std::max(d.max, mm);
    }
  return d;
}

/// What speaks for a file read with the wrong axes, scale or frame rate.
void note_oddities(const std::vector<BodyPoses>& poses, double fps, double floor_shift,
                   std::vector<std::string>& notes) {
  double path = 0.0, lying = 0.0;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    if (t > 0) path += (poses[t].p_WB[0] - poses[t - 1].p_WB[0]).norm();
    if ((poses[t].q_WB[0] * Vector3d::UnitY()).z() < kUpright)
      lying += 1.0 / static_cast<double>(poses.size());
  }
  const double speed = path * fps / static_cast<double>(poses.size() - 1);
  if (speed > kOddSpeed) notes.push_back(text("mean speed %.1f m/s: are scale and frame rate right?", speed));
  if (lying > kOddLyingShare)
    notes.push_back(text("lying or upside down in %.0f %% of the frames: is z up?", 100.0 * lying));
  if (std::abs(floor_shift) > kOddFloorShift)
    notes.push_back(text("moved %.2f m up to the floor: is the translation in metres, z up?", floor_shift));
}

void forward(Reference& reference) {
  reference.poses.clear();
  for (const ReferenceFrame& f : reference.frames)
    reference.poses.push_back(forward_kinematics(reference.character, f.p_root, f.q));
}

/// Puts the reference on the floor and reports by how much it moved.
/// @param bend  the feet were levelled: their stiff toes may be bent, and do not count where the foot does
/// not stand
/// @param known  z = 0 is the floor: the motion as a whole stays where it is
void align_with_floor(bool bend, bool known, Reference& reference, PreparationReport& report) {
  const std::vector<SurfacePoint> points = surface_points(reference.character);
  std::vector<double> moved(reference.frames.size(), 0.0);
  const auto align = [&](const std::vector<double>& lowest) {
    const FloorCorrection floor = floor_correction(lowest, reference.fps, known);
    report.floor_shift_mm += kMm * floor.shift;
    for (std::size_t t = 0; t < reference.frames.size(); ++t) {
      reference.frames[t].p_root.z() += floor.height[t];
      moved[t] += floor.height[t];
    }
    forward(reference);
  };
  if (bend) {
    align(support_heights(reference));
    bend_toes(reference);
    forward(reference);
  }
  std::vector<double> lowest;
  for (const BodyPoses& pose : reference.poses) lowest.push_back(lowest_height(points, pose));
  align(lowest);
  for (double height : moved)
    report.max_floor_shift_mm = std::max(report.max_floor_shift_mm, kMm * std::abs(height));
}

}  // namespace

Reference prepare_reference(const Clip& clip, const PreparationOptions& options, PreparationReport* report) {
  require_usable(clip, 2);
  PreparationReport r;
  const Clip input = resampled(clip, options.fps);
  require_usable(input, 2);
  Clip bridged = input;
  Reference out;
  out.name = clip.name;
  out.fps = options.fps;
  out.character = character_of(clip);
  out.keypoints = input.keypoints;
  out.flagged = find_glitches(input);
  r.flagged_frames = static_cast<int>(std::count(out.flagged.begin(), out.flagged.end(), true));
  if (options.bridge_flagged) bridge_glitches(bridged, out.flagged);

  const auto q = to_hinges(out.character, joint_rotations(bridged));
  const Vector3d pelvis = rest_pelvis(clip);
  for (std::size_t t = 0; t < q.size(); ++t) {
    ReferenceFrame frame;
    frame.p_root = bridged.trans[t] + pelvis;
    frame.q = q[t];
    out.frames.push_back(frame);
  }
  forward(out);
  const Distance hinge = distance_mm(poses_of(bridged), out.poses);
  r.hinge_residual_mean_mm = hinge.mean;
  r.hinge_residual_max_mm = hinge.max;
  if (options.level_feet) {
    r.foot_level_deg = level_feet(out);
    if (r.foot_level_deg > 0.0) forward(out);
  }
  if (options.ground) align_with_floor(r.foot_level_deg > 0.0, clip.on_floor, out, r);
  differentiate(out.frames, out.fps);
  const Distance change = distance_mm(poses_of(input), out.poses);
  r.change_mean_mm = change.mean;
  r.change_max_mm = change.max;
  r.notes = input.warnings;
  note_oddities(out.poses, out.fps, r.floor_shift_mm / kMm, r.notes);
  if (report) *report = r;
  return out;
}

void differentiate(std::vector<ReferenceFrame>& frames, double fps) {
  const std::size_t last = frames.size() - 1;
  for (std::size_t t = 0; t <= last && last > 0; ++t) {
    // One-sided at the ends.
    const ReferenceFrame &before = frames[t > 0 ? t - 1 : 0], &after = frames[std::min(t + 1, last)];
    const double rate = fps / (t > 0 && t < last ? 2.0 : 1.0);
    frames[t].v_root = rate * (after.p_root - before.p_root);
    for (std::size_t j = 0; j < kBodies; ++j)
      frames[t].omega[j] = rate * log_map(before.q[j].conjugate() * after.q[j]);
  }
}

Clip to_clip(const std::string& name, double fps, const Character& character,
             const std::vector<Vector3d>& p_root, const std::vector<PerBody<Quaterniond>>& q) {
  Clip clip;
  clip.name = name;
  clip.fps = fps;
  clip.betas = character.betas;
  clip.body_model = "mimicx";
  const Vector3d pelvis = rest_pelvis(clip.body_model);
  clip.rotations.resize(q.size());
  for (std::size_t t = 0; t < q.size(); ++t) {
    for (std::size_t j = 0; j < kBodies; ++j) clip.rotations[t][j] = log_map(q[t][j]);
    clip.trans.push_back(p_root[t] - pelvis);
  }
  return clip;
}

}  // namespace mimicx

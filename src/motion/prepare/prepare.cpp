#include "motion/prepare/prepare.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "character/body_words.h"
#include "core/number_text.h"
#include "core/units.h"
#include "motion/prepare/arm_separation.h"
#include "motion/prepare/bridging.h"
#include "motion/prepare/feet.h"
#include "motion/prepare/floor_correction.h"
#include "motion/prepare/foot_planting.h"
#include "motion/prepare/ground_slope.h"
#include "motion/prepare/hinge.h"
#include "motion/prepare/joint_ranges.h"
#include "motion/prepare/root_travel.h"
#include "motion/prepare/self_passage.h"
#include "motion/prepare/stance.h"
#include "motion/resample.h"
#include "motion/surface_points.h"

namespace mimicx::motion {
namespace {

constexpr double kOddFloorShift = 1.0;  ///< m
constexpr double kOddSpeed = 10.0;      ///< m/s, mean of the pelvis
constexpr double kUpright = 0.3;        ///< vertical component of the pelvis' up axis
constexpr double kOddLyingShare = 0.8;
constexpr double kToldRange = 1.0;  ///< degrees beyond a range; less is not worth a line

/// Largest and mean distance of the joints of two motions, mm.
struct Distance {
  double mean = 0, max = 0;
};
Distance distance_mm(const PerFrame<BodyPoses>& a, const PerFrame<BodyPoses>& b) {
  Distance d;
  for (int t = 0; t < a.count(); ++t)
    for (int j = 0; j < kBodies; ++j) {
      const double mm = kMm * (a[t].p_WB[j] - b[t].p_WB[j]).norm();
      d.mean += mm / static_cast<double>(a.size() * kBodies);
      d.max = std::max(d.max, mm);
    }
  return d;
}

/// Adds a note for every sign that a file was read with the wrong axes, scale or frame rate.
void note_oddities(const PerFrame<BodyPoses>& poses, double fps, double floor_shift,
                   std::vector<std::string>& notes) {
  double path = 0.0, lying = 0.0;
  for (int t = 0; t < poses.count(); ++t) {
    if (t > 0) path += (poses[t].p_WB[0] - poses[t - 1].p_WB[0]).norm();
    if ((poses[t].q_WB[0] * Vector3d::UnitY()).z() < kUpright)
      lying += 1.0 / static_cast<double>(poses.size());
  }
  const double speed = path * fps / static_cast<double>(poses.size() - 1);
  if (speed > kOddSpeed)
    notes.push_back(formatted("mean speed %.1f m/s: are scale and frame rate right?", speed));
  if (lying > kOddLyingShare)
    notes.push_back(formatted("lying or upside down in %.0f %% of the frames: is z up?", 100.0 * lying));
  if (std::abs(floor_shift) > kOddFloorShift)
    notes.push_back(formatted(floor_shift < 0.0
                                  ? "moved %.2f m down to the floor: is the translation in metres, z up?"
                                  : "moved %.2f m up to the floor: is the translation in metres, z up?",
                              std::abs(floor_shift)));
}

/// Notes for a world that contradicts the feet, before preparation moves them.
std::vector<std::string> contradictions(const Reference& reference) {
  std::vector<std::string> notes;
  if (const auto slope = ground_slope(reference.character, reference.poses, reference.fps))
    notes.push_back(
        formatted("the feet stand on a slope of %.0f degrees, up would be (%.2f, %.2f, %.2f): is the camera "
                  "tilted? Turn the motion so that gravity points down",
                  slope->degrees, slope->up.x(), slope->up.y(), slope->up.z()));
  if (const auto found = travel_contradiction(reference.character, reference.poses, reference.fps)) {
    const double ratio = std::abs(found->ratio) < 0.005 ? 0.0 : found->ratio;  // not "-0.00"
    notes.push_back(
        formatted("feet on the floor slide %.0f mm a frame, the body travels %.2f times the way that they "
                  "walk: a treadmill, or a translation that is missing, mirrored or wrongly scaled?",
                  found->slide_mm, ratio));
  }
  return notes;
}

void forward(Reference& reference) {
  reference.poses.clear();
  for (const ReferenceFrame& f : reference.frames)
    reference.poses.push_back(forward_kinematics(reference.character, f.p_root, f.q));
}

/// Brings joints into their ranges; says so where they were clearly outside.
void bring_into_ranges(Reference& reference, PreparationReport& report) {
  const RangeReport found = turn_into_ranges(reference);
  if (found.frames == 0) return;
  forward(reference);
  report.range_frames = found.frames;
  report.range_deg = found.farthest / kDegree;
  if (report.range_deg < kToldRange) return;
  report.notes.push_back(
      formatted("joints were beyond their ranges in %s, by up to %.0f degrees (%s): turned inside",
                counted(found.frames, "frame").c_str(), report.range_deg, body_in_words(found.body).c_str()));
}

/// Brings joints into their ranges that later steps turned out of them.
void turn_back_into_ranges(bool ground, Reference& reference) {
  if (turn_into_ranges(reference).frames == 0) return;
  forward(reference);
  if (!ground) return;
  const PerFrame<double> lift = lift_over_floor(
      standing_heights(surface_points(reference.character), reference.poses, reference.fps, reference.scene),
      reference.fps);
  for (int t = 0; t < reference.size(); ++t) reference.frames[t].p_root.z() += lift[t];
  forward(reference);
}

/// Leads limbs around the body; says where.
void lead_around(bool sees, Reference& reference, PreparationReport& report) {
  std::optional<Keypoints> unseen;
  if (!sees) unseen.swap(reference.keypoints);
  const PassageReport found = lead_limbs_around(reference);
  if (!sees) unseen.swap(reference.keypoints);
  report.passages = found.passages - found.remaining;
  report.passages_left = found.remaining;
  if (found.passages == 0) return;
  report.notes.push_back(
      formatted("limbs pass through the body %s, first at %.2f s (%s through %s): led around it by up to "
                "%.0f mm%s",
                counted(found.passages, "time").c_str(), found.first_frame / reference.fps,
                body_in_words(found.limb_body).c_str(), body_in_words(found.obstacle).c_str(),
                kMm * found.moved, found.remaining == 0 ? "" : "; not everywhere was a way found"));
}

/// Puts the reference on the floor and reports by how much it moved.
/// @param bend   the feet were levelled: toes are bent, and toes of feet that do not stand are ignored first
/// @param plant  feet are planted afterwards: only the rest of the body is lifted out of the floor
/// @param known  the floor is known to be z = 0: no constant shift
void align_with_floor(bool bend, bool plant, bool known, Reference& reference, PreparationReport& report) {
  const std::vector<SurfacePoint> points = surface_points(reference.character);
  const std::vector<SurfacePoint> others(points.begin() + kFootPoints, points.end());
  PerFrame<double> moved(reference.frames.size(), 0.0);
  const auto align = [&](const PerFrame<double>& lowest) {
    const FloorCorrection floor = floor_correction(
        lowest, plant ? lowest_resting_heights(others, reference.poses, reference.scene) : lowest,
        reference.fps, known);
    report.floor_shift_mm += kMm * floor.shift;
    for (int t = 0; t < reference.size(); ++t) {
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
  align(standing_heights(points, reference.poses, reference.fps, reference.scene));
  for (double height : moved)
    report.max_floor_shift_mm = std::max(report.max_floor_shift_mm, kMm * std::abs(height));
}

/// A difference of the first two frames is the velocity between them, and in flight gravity changes it by g/2
/// of a frame until then. A motion that begins in the air gets the velocity of the parabola from its first
/// frame on that is nearest to the centre of mass: c_t = c_0 + v s_t − g s_t²/2 at the times s_t.
void begin_in_flight(Reference& reference) {
  constexpr double kClearance = 0.03;        // m
  constexpr int kFewest = 4;                 // frames in the air
  constexpr double kSlack = 0.3 * kGravity;  // a fall has the acceleration of gravity but for this, m/s²
  const PerFrame<double> lowest =
      lowest_resting_heights(surface_points(reference.character), reference.poses, reference.scene);
  int flight = 0;
  while (flight < reference.size() && lowest[flight] > kClearance) ++flight;
  if (flight < kFewest) return;
  const auto centre = [&](int t) { return center_of_mass(reference.character, reference.poses[t]); };
  const double fps = reference.fps;
  const Vector3d first = fps * (centre(1) - centre(0)),
                 last = fps * (centre(flight - 1) - centre(flight - 2));
  const double acceleration = (last - first).z() * fps / (flight - 2);
  if (std::abs(acceleration + kGravity) > kSlack) return;
  Vector3d sum = Vector3d::Zero();
  double squares = 0.0;
  for (int t = 1; t < flight; ++t) {
    const double s = t / fps;
    sum += s * (centre(t) - centre(0) + 0.5 * kGravity * s * s * Vector3d::UnitZ());
    squares += s * s;
  }
  reference.frames[0].v_root += sum / squares - first;
}

/// Flags the frames of a reference whose times are at, or beside, those of flagged frames of another rate.
void add_flags(const PerFrame<bool>& other, double other_fps, double fps, PerFrame<bool>& flagged) {
  if (other.empty()) return;
  for (int t = 0; t < flagged.count(); ++t) {
    constexpr double kRounding = 1e-6;  // frames
    const double at = t / fps * other_fps;
    for (const double beside : {std::floor(at + kRounding), std::ceil(at - kRounding)})
      if (other[std::min(static_cast<int>(beside), other.count() - 1)]) flagged[t] = true;
  }
}

}  // namespace

Reference prepare_reference(const Clip& clip, const PreparationConfig& config, PreparationReport* report) {
  require_usable(clip, 2);
  PreparationReport r;
  const Clip input = resampled(clip, config.fps);
  if (input.frames() < 2)
    throw DataError(clip.name, "", formatted("at least 2 frames at %g fps", config.fps),
                    formatted("%d frames at %g fps", clip.frames(), clip.fps));
  require_usable(input, 2);
  const BridgedClip whole =
      config.bridge_flagged ? bridged(input) : BridgedClip{input, PerFrame<bool>(input.frames(), false), 0};
  Reference out;
  out.name = clip.name;
  out.fps = config.fps;
  out.character = character_of(clip);
  out.scene = clip.scene;
  out.keypoints = input.keypoints;
  out.flagged = whole.flagged;
  add_flags(config.flagged, clip.fps, config.fps, out.flagged);
  r.flagged_frames = static_cast<int>(std::count(out.flagged.begin(), out.flagged.end(), true));
  r.limb_frames = whole.limb_frames;

  const auto q = to_hinges(out.character, joint_rotations(whole.clip));
  const Vector3d pelvis = rest_pelvis(clip);
  for (int t = 0; t < q.count(); ++t) {
    ReferenceFrame frame;
    frame.p_root = whole.clip.trans[t] + pelvis;
    frame.q = q[t];
    out.frames.push_back(frame);
  }
  forward(out);
  const Distance hinge = distance_mm(poses_of(whole.clip), out.poses);
  r.hinge_residual_mean_mm = hinge.mean;
  r.hinge_residual_max_mm = hinge.max;
  const std::vector<std::string> contradicted = contradictions(out);
  if (config.ranges) bring_into_ranges(out, r);
  if (config.separate) lead_around(config.sees, out, r);
  if (config.separate) r.arms_moved_mm = kMm * separate_arms(out);
  if (config.level_feet) {
    r.foot_level_deg = level_feet(out);
    if (r.foot_level_deg > 0.0) forward(out);
  }
  if (config.ground)
    align_with_floor(r.foot_level_deg > 0.0 || config.plant, config.plant, clip.on_floor, out, r);
  if (config.ground && config.plant)
    r.feet_planted_mm = kMm * plant_feet(find_stance(out.character, out.poses, out.fps, out.scene), out);
  if (config.ranges) turn_back_into_ranges(config.ground, out);
  differentiate(out.frames, out.fps);
  if (config.ground) begin_in_flight(out);
  const Distance change = distance_mm(poses_of(input), out.poses);
  r.change_mean_mm = change.mean;
  r.change_max_mm = change.max;
  r.notes.insert(r.notes.begin(), input.warnings.begin(), input.warnings.end());
  note_oddities(out.poses, out.fps, r.floor_shift_mm / kMm, r.notes);
  r.notes.insert(r.notes.end(), contradicted.begin(), contradicted.end());
  if (report) *report = r;
  return out;
}

}  // namespace mimicx::motion

#include "import/retarget/retarget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "character/body_words.h"
#include "core/number_text.h"
#include "core/units.h"
#include "import/body_fit.h"
#include "import/evidence/length_unit.h"
#include "import/evidence/sides.h"
#include "import/evidence/up_axis.h"
#include "import/retarget/retarget_contacts.h"
#include "import/retarget/retarget_floor.h"
#include "import/retarget/retarget_solve.h"
#include "import/world_transform.h"

namespace mimicx::import {
namespace {

/// The input of retargeting: landmarks of every frame and the neutral poses.
struct Source {
  JointMap map;
  PerBody<bool> turns{};
  PerFrame<Landmarks> frames;  ///< first in the file's unit and axes, then z up and in metres
  NeutralPoses neutral;        ///< in the units of `frames`
  std::string neutral_name;
  bool neutral_stands = true;  ///< it is a stance, not the frames that come nearest to one
};

Source read_source(const SkeletonMotion& motion, const std::filesystem::path& joint_map, motion::Clip& clip) {
  Source source;
  source.map = map_joints(motion, joint_map, &clip.warnings);
  for (int b = 0; b < kBodies; ++b)
    source.turns[b] = source.map[b] >= 0 && !motion.joints[source.map[b]].end_site;
  source.frames = landmarks_of(motion, source.map);
  return source;
}

/// Throws where a bone whose direction is used has length 0.
void check_bones(const SkeletonMotion& motion, const Source& source) {
  const double least = 0.01 * leg_length(source.frames);
  for (int t = 0; t < source.frames.count(); ++t) {
    const auto check = [&](int from, int to) {
      if (!((source.frames[t].p[from] - source.frames[t].p[to]).norm() > least))
        throw DataError(motion.path, "frame " + std::to_string(t),
                        body_in_words(from) + " and " + body_in_words(to) + " at different places",
                        "both at the same place");
    };
    check(kLeftHip, kRightHip);
    check(kLeftShoulder, kRightShoulder);
    for (const Bone& bone : kBones) check(bone.body, bone.end);
    check(kLeftHip, kLeftShoulder);
  }
}

void drop_t_pose(Source& source, motion::Clip& clip) {
  if (!starts_with_t_pose(source.frames)) return;
  source.neutral.body = {source.frames[0]};
  source.neutral_name = "the T-pose of the first frame";
  source.frames.erase(source.frames.begin());
  clip.decisions.emplace_back(kTPoseRemoved);
}

/// Up axis of the motion.
char find_up(const SkeletonMotion& motion, const Source& source, const RetargetConfig& config,
             motion::Clip& clip) {
  std::string why = "given by the user";
  char up = config.up.value_or(motion.metric_up);
  if (!config.up && motion.metric_up != 0) {
    why = up == 'y' ? "defined by the format" : "the body's, not the format's";
  } else if (!config.up) {
    const UpDecision found = decide_up(source.frames, landmarks_of(rest_pose(motion), source.map), 'y');
    up = found.axis;
    why = found.why;
    if (found.is_near()) clip.warnings.push_back(near_up_warning(found));
  }
  clip.decisions.emplace_back("up axis " + axis_name(up) + ": " + why);
  return up;
}

/// Metres of the file's unit. @param up  the file's axis
double find_scale(const SkeletonMotion& motion, const Source& source, const RetargetConfig& config, char up,
                  motion::Clip& clip) {
  const double leg = leg_length(source.frames);
  if (config.scale != 0.0) {
    clip.decisions.push_back(
        formatted("unit %.6g m: given by the user; legs are %.2f m long", config.scale, config.scale * leg));
    return config.scale;
  }
  if (motion.metric_up != 0) return 1.0;
  std::vector<std::string> names;
  for (const SkeletonJoint& joint : motion.joints) names.push_back(joint.name);
  const UnitDecision unit = decide_unit(
      unit_evidence(source.frames, rotation_to_z_up(up).conjugate() * Vector3d::UnitZ(), motion.fps, names));
  if (unit.fits) {
    clip.decisions.push_back(
        formatted("unit %s: legs are %.4g units, %.2f m long", unit.name.c_str(), leg, unit.metres * leg));
    if (!unit.usual)
      clip.warnings.push_back(
          formatted("legs of %.2f m (unit %s) are unusual, usual for this body are %.2f m: "
                    "--scale %.3g gives it these",
                    unit.metres * leg, unit.name.c_str(), unit.usual_leg, unit.usual_leg / leg));
    else if (unit.is_near())
      clip.warnings.push_back(formatted("the unit may also be %s (legs of %.2f m, not %.2f m): --scale %.6g",
                                        unit.second.c_str(), unit.second_metres * leg, unit.metres * leg,
                                        unit.second_metres));
    return unit.metres;
  }
  clip.warnings.push_back(formatted(
      "legs are %.4g units long, which fits no usual unit (%s: %.2f m): scaled to %.2f m; --scale %.6g "
      "keeps that unit",
      leg, unit.name.c_str(), unit.metres * leg, unit.usual_leg, unit.metres));
  return unit.usual_leg / leg;
}

/// The tenth of the frames with the smallest values: a single frame may belong to a gesture.
PerFrame<Landmarks> least_tenth(const PerFrame<Landmarks>& frames, const auto& value) {
  std::vector<std::pair<double, int>> order;
  for (int t = 0; t < frames.count(); ++t) order.emplace_back(value(frames[t]), t);
  std::sort(order.begin(), order.end());
  PerFrame<Landmarks> least;
  for (std::size_t i = 0; i < (order.size() + 9) / 10; ++i) least.push_back(frames[order[i].second]);
  return least;
}

/// The poses in which the body is taken to be neutral, z up.
void choose_neutral(const SkeletonMotion& motion, Source& source, const Quaterniond& up, double scale,
                    motion::Clip& clip) {
  for (Landmarks& pose : source.neutral.body) pose = transformed(pose, up, scale);
  const Landmarks rest = landmarks_of(rest_pose(motion), source.map);
  constexpr double kAlongAnAxis = 0.7;
  const Vector3d stands =
      (rest.between(kLeftShoulder, kRightShoulder) - rest.between(kLeftAnkle, kRightAnkle)).normalized();
  if (is_stance(rest) && stands.cwiseAbs().maxCoeff() > kAlongAnAxis) {
    source.neutral.body = {transformed(rest, rotation_to_z_up(axis_letter(stands)), scale)};
    source.neutral_name = "the rest pose";
  } else if (source.neutral.body.empty()) {
    const auto height = [&](int ankle, int toes) {
      return [ankle, toes = source.map[toes] >= 0 ? toes : ankle](const Landmarks& pose) {
        return pose.p[ankle].z() + pose.p[toes].z();
      };
    };
    source.neutral.body = least_tenth(source.frames, bend_of);
    // A runner's legs are straight in the air. Soles are level where the feet are low.
    source.neutral.left_foot = least_tenth(source.frames, height(kLeftAnkle, kLeftFoot));
    source.neutral.right_foot = least_tenth(source.frames, height(kRightAnkle, kRightFoot));
    source.neutral_stands = false;
    source.neutral_name =
        formatted("the %zu frames nearest to a straight stance", source.neutral.body.size());
  }
  clip.decisions.emplace_back("neutral pose: " + source.neutral_name);
  if (decide_sides(source.frames, source.map[kLeftFoot] >= 0 && source.map[kRightFoot] >= 0).are_exchanged())
    clip.warnings.emplace_back("toes point and knees bend backwards: are left and right exchanged?");
}

BodyLengths measured_lengths(const Source& source) {
  const auto mean = [](const PerFrame<Landmarks>& poses, int from, int to) {
    double sum = 0.0;
    for (const Landmarks& pose : poses) sum += (pose.p[from] - pose.p[to]).norm();
    return sum / static_cast<double>(poses.size());
  };
  const auto limb = [&](int left, int left_end, int right, int right_end) {
    return 0.5 * (mean(source.frames, left, left_end) + mean(source.frames, right, right_end));
  };
  BodyLengths lengths{};
  lengths[kThigh] = limb(kLeftHip, kLeftKnee, kRightHip, kRightKnee);
  lengths[kShank] = limb(kLeftKnee, kLeftAnkle, kRightKnee, kRightAnkle);
  lengths[kUpperArm] = limb(kLeftShoulder, kLeftElbow, kRightShoulder, kRightElbow);
  lengths[kForearm] = limb(kLeftElbow, kLeftWrist, kRightElbow, kRightWrist);
  // End sites of feet are the tips of the toes, not the balls.
  if (source.turns[kLeftFoot] && source.turns[kRightFoot])
    lengths[kFootLength] = limb(kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot);
  lengths[kHipWidth] = mean(source.frames, kLeftHip, kRightHip);
  lengths[kShoulderWidth] = mean(source.neutral.body, kLeftShoulder, kRightShoulder);
  for (const Landmarks& pose : source.neutral.body)
    lengths[kTrunk] +=
        (pose.between(kLeftShoulder, kRightShoulder) - pose.between(kLeftHip, kRightHip)).norm() /
        static_cast<double>(source.neutral.body.size());
  return lengths;
}

/// Frames of the character that follow the landmarks.
void solve(const Character& character, const Calibration& calibration, const PerFrame<Landmarks>& frames,
           double leg_ratio, motion::Clip& clip) {
  const Vector3d hips = 0.5 * (character.joint_offset[kLeftHip] + character.joint_offset[kRightHip]);
  clip.rotations.clear();
  clip.trans.clear();
  for (const Landmarks& pose : frames) {
    const auto q = body_rotations(character, calibration, pose);
    auto& rotations = clip.rotations.emplace_back();
    rotations[0] = log_map(q[0]);
    for (int b = 1; b < kBodies; ++b) rotations[b] = log_map(q[kParents[b]].conjugate() * q[b]);
    clip.trans.push_back(leg_ratio * pose.between(kLeftHip, kRightHip) - q[0] * hips -
                         mimicx::rest_pelvis(clip.body_model));
  }
}

/// Joints that have the same position in every skeleton.
constexpr PerBody<bool> kCompared = [] {
  PerBody<bool> compared{};
  compared.fill(true);
  for (const int body : {kPelvis, kSpine1, kSpine2, kSpine3, kLeftCollar, kRightCollar})
    compared[body] = false;
  return compared;
}();

void measure(const motion::Clip& clip, const Source& source, double lift, RetargetReport& report) {
  report.residual_mm.fill(std::numeric_limits<double>::quiet_NaN());
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  double sum = 0.0;
  int count = 0;
  for (int b = 1; b < kBodies; ++b) {
    if (source.map[b] < 0 || !kCompared[b]) continue;
    double distance = 0.0;
    for (int t = 0; t < poses.count(); ++t)
      distance +=
          (poses[t].p_WB[b] - report.leg_ratio * source.frames[t].p[b] - lift * Vector3d::UnitZ()).norm();
    report.residual_mm[b] = kMm * distance / static_cast<double>(poses.size());
    sum += report.residual_mm[b];
    ++count;
  }
  report.mean_residual_mm = sum / count;
}

/// The residuals of all compared bodies, in one line.
std::string residuals_line(const RetargetReport& report) {
  std::string line;
  for (int b = 0; b < kBodies; ++b)
    if (!std::isnan(report.residual_mm[b]))
      line += (line.empty() ? "residuals in mm: " : ", ") + body_in_words(b) +
              formatted(" %.0f", report.residual_mm[b]);
  return line;
}

/// A warning of joints of the limbs that are far from the skeleton's.
void warn_of_residuals(const RetargetReport& report, motion::Clip& clip) {
  constexpr double kFar = 80.0;  // mm
  std::string far;
  for (const int b :
       {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftElbow, kRightElbow, kLeftWrist, kRightWrist})
    if (report.residual_mm[b] > kFar)
      far += (far.empty() ? "" : ", ") + body_in_words(b) + formatted(" %.0f mm", report.residual_mm[b]);
  if (!far.empty())
    clip.warnings.push_back("our body cannot take the skeleton's proportions: joints are off by " + far +
                            " on average");
}

bool knows_body(const KnownBody& known) { return !std::isnan(known.mass) || !std::isnan(known.height); }

/// Gives the fitted shape the mass that is known, or the usual one. Only the girth changes, which moves no
/// joint.
void give_mass(const KnownBody& known, motion::Clip& clip) {
  clip.decisions.push_back(settle_mass(known, clip.betas));
  const std::string warning = mass_warning(known, clip.betas);
  if (!warning.empty()) clip.warnings.push_back(warning);
}

/// Handles a skeleton that `write_bvh` wrote: its joints are the bodies, its offsets those of some β.
/// @return false for another skeleton
bool take_own_skeleton(const SkeletonMotion& motion, motion::Clip& clip) {
  PerBody<int> joint{};
  PerBody<Vector3d> offsets;
  for (int b = 0; b < kBodies; ++b) {
    const auto found = std::find_if(motion.joints.begin(), motion.joints.end(), [&](const SkeletonJoint& j) {
      return j.name == kBodyNames[b] && !j.end_site;
    });
    if (found == motion.joints.end()) return false;
    if (b > 0 && found->parent != joint[kParents[b]]) return false;
    joint[b] = static_cast<int>(found - motion.joints.begin());
    offsets[b] = found->offset;
  }
  double error = 0.0;
  const auto betas = fit_betas(offsets, error);
  constexpr double kSame = 1e-6;  // m
  if (error > kSame || joint[0] != 0) return false;
  clip.betas = betas;
  const Quaterniond up = rotation_to_z_up('y');
  for (int t = 0; t < motion.frames(); ++t) {
    auto& rotations = clip.rotations.emplace_back();
    for (int b = 0; b < kBodies; ++b) rotations[b] = log_map(motion.rotation[t][joint[b]]);
    rotations[0] = log_map(up * motion.rotation[t][0]);
    clip.trans.push_back(up * motion.translation[t][0] - mimicx::rest_pelvis(clip.body_model));
  }
  clip.decisions.emplace_back("the skeleton is this program's own: used unchanged, y up, metres");
  return true;
}

void retarget_foreign(const SkeletonMotion& motion, const RetargetConfig& config, RetargetReport& report,
                      motion::Clip& clip) {
  Source source = read_source(motion, config.joint_map, clip);
  check_bones(motion, source);
  for (int b = 0; b < kBodies; ++b)
    if (source.map[b] < 0 && b != kSpine1 && b != kSpine2) report.unmapped.push_back(body_in_words(b));
  drop_t_pose(source, clip);
  report.up = find_up(motion, source, config, clip);
  report.scale = find_scale(motion, source, config, report.up, clip);
  const Quaterniond up = rotation_to_z_up(report.up);
  for (Landmarks& pose : source.frames) pose = transformed(pose, up, report.scale);
  choose_neutral(motion, source, up, report.scale, clip);

  const BodyLengths lengths = measured_lengths(source);
  if (!config.standard_body) {
    clip.betas = fit_betas(lengths);
    give_mass(config.known, clip);
  } else if (knows_body(config.known)) {
    clip.warnings.emplace_back("--mass and --height do not change the standard body (--body standard)");
  }
  const Character character = make_character(clip.betas);
  const BodyLengths made = lengths_of(character.joint_offset);
  report.leg_ratio = (made[kThigh] + made[kShank]) / (lengths[kThigh] + lengths[kShank]);
  Calibration calibration = calibrate(character, source.neutral, source.turns, source.map);
  const Twists twists = measure_twists(character, calibration, source.frames);
  calibration = calibrate(character, source.neutral, source.turns, source.map, twists);
  if (motion.positions_only) calibration.p_JS = shoulders_in_chest(source.frames);  // their rest pose is ours
  const auto solve_all = [&] {
    solve(character, calibration, source.frames, report.leg_ratio, clip);
    if (motion.positions_only) level_rolls(character, clip);
  };
  solve_all();
  // A skeleton's rest pose says how its feet stand; joint positions have none.
  level_soles(source.neutral_stands, (motion.positions_only ? 1.0 : 5.0) * kDegree, calibration, clip);
  solve_all();
  if (motion.positions_only || has_other_legs(character, lengths[kThigh], lengths[kShank]))
    keep_contacts(character, source.frames, report.leg_ratio, clip);
  report.lift = put_on_floor(motion.positions_only, clip);
  if (motion.positions_only) extend_toes(clip);
  bend_hands(clip);
  report.neutral = source.neutral_name;
  measure(clip, source, report.lift, report);
  clip.decisions.push_back(formatted(
      config.standard_body
          ? "standard body: legs are %.3f times the skeleton's, joints %.0f mm from its joints on average"
          : "body shape fitted: legs are %.3f times the skeleton's, joints %.0f mm from its joints on "
            "average",
      report.leg_ratio, report.mean_residual_mm));
  clip.decisions.push_back(residuals_line(report));
  warn_of_residuals(report, clip);
  std::string missing;
  for (const std::string& name : report.unmapped) missing += (missing.empty() ? "" : ", ") + name;
  if (!missing.empty()) clip.warnings.emplace_back("no joint for " + missing + ": kept in the rest pose");
}

}  // namespace

motion::Clip retarget(const SkeletonMotion& motion, const RetargetConfig& config, RetargetReport* report) {
  if (!(config.scale >= 0.0 && std::isfinite(config.scale)))
    throw std::invalid_argument("retarget: the scale must be positive, or 0 to find it");
  motion::Clip clip;
  clip.name = motion.name;
  clip.fps = motion.fps;
  clip.warnings = motion.warnings;
  clip.decisions = motion.decisions;
  RetargetReport local;
  const bool as_is = !config.standard_body && config.scale == 0.0 && !config.up && config.joint_map.empty();
  local.own = as_is && take_own_skeleton(motion, clip);
  if (!local.own)
    retarget_foreign(motion, config, local, clip);
  else if (knows_body(config.known))
    give_mass(config.known, clip);
  for (int t = 0; t < clip.frames(); ++t) {
    bool finite = clip.trans[t].allFinite();
    for (const Vector3d& r : clip.rotations[t]) finite = finite && r.allFinite();
    if (!finite)
      throw DataError(motion.path, "frame " + std::to_string(t), "a pose that a body can take",
                      "a degenerate one");
  }
  if (report != nullptr) *report = local;
  return clip;
}

}  // namespace mimicx::import

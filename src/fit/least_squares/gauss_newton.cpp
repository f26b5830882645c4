#include "fit/least_squares/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/elementary.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "core/quantile.h"
#include "core/units.h"
#include "fit/least_squares/balance_term.h"
#include "fit/least_squares/error_levels.h"
#include "fit/least_squares/fit_terms.h"
#include "fit/least_squares/left_right.h"
#include "fit/least_squares/projection.h"
#include "fit/least_squares/scene_match.h"

namespace mimicx::fit {
namespace {

constexpr int kDraws = 3;                       ///< samples of the solution's error, for the levels
constexpr std::uint64_t kLevelStream = 0x4C45;  ///< of random numbers
constexpr double kPercent = 100.0;
constexpr double kDoubtful = 1.5;         ///< % of the box; of detectors and estimators 0.3 to 0.5
constexpr double kContradiction = 3.0;    ///< the same: then the keypoints are ignored
constexpr double kFartherAway = 1.5;      ///< times as far from the camera; estimators err by less
constexpr double kFarBefore = 30.0;       ///< % of the box, before the fit; of estimators 5 to 15
constexpr double kFarAhead = 2.0;         ///< frames at 30 fps; of detectors and estimators less than one
constexpr double kOtherPose = 100.0;      ///< mm about the pelvis, mean of the joints; estimators err by half
constexpr double kSidesWrong = 0.5;       ///< of the frames; detectors exchange sides in a few
constexpr double kToldSceneShift = 0.02;  ///< m
constexpr int kUnsettled = 3;             ///< iterations until the motion is on the floor
constexpr int kFewest = 7;                ///< iterations; those after the unsettled ones find the levels
constexpr double kLargestTurn = 0.35;     ///< rad: longest step of one joint in one iteration
constexpr double kFarOff = 3.0;           ///< kernel widths; detections farther off count as dropped
constexpr double kShiftToPose = 5.0;      ///< the pelvis converges more slowly than poses, and matters less

/// A state with its derived quantities.
struct Evaluated {
  PerFrame<FrameKinematics> motion;
  PerFrame<FootPositions> feet;
};

Evaluated evaluate(const FitProblem& problem, const FitState& state) {
  constexpr int kFrames = 32;  // a chunk
  const Character character = character_of(problem, state);
  const int frames = problem.frames();
  Evaluated e{PerFrame<FrameKinematics>(frames), PerFrame<FootPositions>(frames)};
  parallel_for((frames + kFrames - 1) / kFrames, problem.config.threads, [&](int chunk) {
    for (int t = chunk * kFrames; t < std::min((chunk + 1) * kFrames, frames); ++t) {
      e.motion[t] = kinematics(problem, state, character, t);
      e.feet[t] = foot_positions(character, e.motion[t]);
    }
  });
  return e;
}

/// Predicted detections, pixels, [frames][K].
PerFrame<std::vector<Eigen::Vector2d>> predict(const FitProblem& problem, const FitState& state,
                                               const Evaluated& e) {
  PerFrame<std::vector<Eigen::Vector2d>> predicted;
  for (int t = 0; t < problem.frames(); ++t) {
    predicted.emplace_back();
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      const Projection seen = keypoint_error(problem, state, e.motion, t, k);
      const Eigen::Vector2d detected = problem.uvc[t][k].head<2>();
      predicted.back().push_back(seen.valid ? Eigen::Vector2d(detected + problem.box[t] * seen.error)
                                            : detected);
    }
  }
  return predicted;
}

struct Residual {
  double rms = 0.0;     ///< % of the box
  double middle = 0.0;  ///< median distance, % of the box: outliers do not matter
  int dropped = 0;
};

Residual residual_of(const FitProblem& problem, const FitState& state, const Evaluated& e) {
  Residual out;
  double squares = 0.0, weights = 0.0;
  std::vector<double> distances;
  for (int t = 0; t < problem.frames(); ++t)
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      const double confidence = problem.uvc[t][k].z();
      const Projection seen = keypoint_error(problem, state, e.motion, t, k);
      if (confidence <= 0.0 || !seen.valid || seen.error.norm() > kFarOff * problem.config.keypoint_kernel)
        ++out.dropped;
      if (confidence <= 0.0 || !seen.valid) continue;
      distances.push_back(seen.error.norm());
      squares += confidence * seen.error.squaredNorm();
      weights += confidence;
    }
  if (weights <= 0.0) return out;
  out.rms = kPercent * std::sqrt(squares / weights);
  out.middle = kPercent * median(distances);
  return out;
}

/// @param distance  median distance of the detections after the fit, % of the box
/// @throws std::domain_error where the keypoints are of another motion or another camera
void require_agreement(double distance, FitReport& report) {
  if (distance <= kDoubtful) return;
  const std::string text = formatted(
      "half of the keypoints are over %.1f %% of the person's height away from the best fit: are they of "
      "this motion, and of this camera?",
      distance);
  if (distance > kContradiction) throw std::domain_error(text);
  report.notes.push_back(text);
}

/// Moves the state along a Gauss-Newton step, shortened where a joint would turn too far.
void advance(const BandSolution& step, FitState& state) {
  double turn = 0.0;
  for (const VectorXd& x : step.x) {
    if (!x.allFinite()) throw std::domain_error("keypoint fit: a step is not finite");
    turn = std::max(turn, x.tail(kFrameUnknowns - kRootRotation).cwiseAbs().maxCoeff());
  }
  const double scale = std::min(1.0, kLargestTurn / std::max(turn, 1e-12));
  for (int t = 0; t < state.c.count(); ++t) state.c[t] += scale * step.x[t];
  state.g += scale * step.g;
}

PerFrame<PerBody<Vector3d>> positions_of(const Evaluated& e) {
  PerFrame<PerBody<Vector3d>> positions;
  for (const FrameKinematics& k : e.motion) positions.push_back(k.poses.p_WB);
  return positions;
}

/// Whether a step moved the joints by less than `smallest` relative to the pelvis, means over frames, m.
bool hardly_moved(const PerFrame<PerBody<Vector3d>>& before, const Evaluated& after, double smallest) {
  double pose = 0.0, shift = 0.0;
  for (int t = 0; t < before.count(); ++t) {
    const PerBody<Vector3d>& now = after.motion[t].poses.p_WB;
    const Vector3d root = now[kPelvis] - before[t][kPelvis];
    shift += root.norm() / before.count();
    for (int b = 0; b < kBodies; ++b)
      pose += (now[b] - before[t][b] - root).norm() / (kBodies * before.count());
  }
  return pose < smallest && shift < kShiftToPose * smallest;
}

/// Keypoints of the clip with the sides and the camera of the fit.
void correct_keypoints(const FitProblem& problem, const FitState& state, motion::Keypoints& keypoints) {
  for (int t = 0; t < keypoints.uvc.count(); ++t)
    for (std::size_t k = 0; k < problem.points.size(); ++k)
      keypoints.uvc[t][problem.points[k].column] = problem.uvc[t][k];
  keypoints.intrinsics.topLeftCorner<2, 2>() *= exp(state.g[kLogFocal]);
  const Matrix3d turn = rotation_about(Vector3d::UnitX(), state.g[kTilt]).toRotationMatrix();
  for (Eigen::Matrix4d& extrinsics : keypoints.extrinsics)
    extrinsics.topRows<3>() = (turn * extrinsics.topRows<3>()).eval();
}

motion::Clip result_of(const motion::Clip& input, const FitProblem& problem, const FitState& state) {
  PerFrame<Vector3d> p_root;
  PerFrame<PerBody<Quaterniond>> q;
  for (int t = 0; t < problem.frames(); ++t) {
    p_root.push_back(problem.p_root[t] + state.c[t].head<3>());
    q.push_back(rotations_of(problem, state, t));
  }
  motion::Clip out = motion::to_clip(input.name, input.fps, character_of(problem, state), p_root, q);
  out.scene = problem.scene;
  if (input.rest_joints) motion::put_on_body_of(input, out);
  out.gender = input.gender;
  out.passthrough = input.passthrough;
  out.warnings = input.warnings;
  out.decisions = input.decisions;
  out.on_floor = input.on_floor;
  out.keypoints = input.keypoints;
  if (!problem.points.empty()) correct_keypoints(problem, state, *out.keypoints);
  return out;
}

/// Largest and mean distance of the joints of two clips, mm.
/// @param a, b  before and after the fit
void report_change(const PerFrame<BodyPoses>& a, const PerFrame<BodyPoses>& b, FitReport& report) {
  for (int t = 0; t < a.count(); ++t)
    for (int j = 0; j < kBodies; ++j) {
      const double mm = kMm * (a[t].p_WB[j] - b[t].p_WB[j]).norm();
      report.change_mean_mm += mm / static_cast<double>(a.size() * kBodies);
      report.change_max_mm = std::max(report.change_max_mm, mm);
    }
}

void report_scene(const Scene& before, const Scene& after, FitReport& report) {
  if (before.flat()) return;
  const double moved = (after.plates[0].centre - before.plates[0].centre).norm();
  if (moved < kToldSceneShift) return;
  report.notes.push_back(formatted("the scene is moved by %.2f m to where the fitted feet stand", moved));
}

Contacts contacts_of(const FitProblem& problem, const Evaluated& e, bool settled) {
  Contacts contacts = find_contacts(e.feet, problem.fps, problem.scene, settled || problem.poses_alone);
  if (problem.poses_alone) keep_level_soles(problem, e.motion, contacts);
  return contacts;
}

/// The Gauss-Newton step from a state, and draws of its error.
SolutionWithDraws step_from(const FitProblem& problem, const FitState& state, const Evaluated& e,
                            const Contacts& contacts, int draws, Random& random) {
  NormalEquations equations = linearise(problem, state, e.motion, e.feet, contacts);
  if (problem.poses_alone)
    add_balance(problem, character_of(problem, state), e.motion, e.feet, contacts, equations.band);
  return solve(equations.band, equations.border, draws, random, problem.config.threads);
}

/// Gauss-Newton; sides and contacts are updated before each step, levels after it.
FitState iterate(FitProblem& problem, FitReport& report) {
  const PerFrame<std::vector<Vector3d>> detected = problem.uvc;
  const Scene given = problem.scene;
  Random random(kLevelStream);
  FitState state = initial_state(problem);
  Evaluated e = evaluate(problem, state);
  report.residual_before = residual_of(problem, state, e).rms;
  for (report.iterations = 0; report.iterations < problem.config.iterations;) {
    report.swapped_frames = order_left_and_right(detected, predict(problem, state, e), problem);
    const bool settled = report.iterations >= kUnsettled;
    if (!problem.poses_alone)
      problem.scene = shifted(given, scene_shift(e.feet, problem.fps, given, settled));
    const Contacts contacts = contacts_of(problem, e, settled);
    const bool levels = settled && problem.config.find_levels && !problem.points.empty();
    const SolutionWithDraws found = step_from(problem, state, e, contacts, levels ? kDraws : 0, random);
    advance(found, state);
    const PerFrame<PerBody<Vector3d>> before = positions_of(e);
    e = {};  // memory
    e = evaluate(problem, state);
    problem.settled = settled;
    if (levels) problem.levels = levels_of(problem, state, e.motion, found.draws);
    ++report.iterations;
    if (report.iterations >= kFewest && hardly_moved(before, e, problem.config.smallest_change)) break;
  }
  const Residual residual = residual_of(problem, state, e);
  report.residual_after = residual.rms;
  report.dropped_points = residual.dropped;
  if (!problem.poses_alone) require_agreement(residual.middle, report);
  return state;
}

/// Keypoints of another motion may be near some pose of the body, and change it from frame to frame.
/// @param a, b  before and after the fit
void report_other_motion(const PerFrame<BodyPoses>& a, const PerFrame<BodyPoses>& b, FitReport& report) {
  double change = 0.0;
  for (int t = 0; t < a.count(); ++t)
    for (int j = 1; j < kBodies; ++j)
      change += kMm * (a[t].p_WB[j] - a[t].p_WB[0] - b[t].p_WB[j] + b[t].p_WB[0]).norm();
  change /= a.count() * (kBodies - 1);
  if (change > kOtherPose)
    report.notes.push_back(formatted(
        "the keypoint fit moves the joints by %.0f mm about the pelvis: are the keypoints of this motion?",
        change));
  if (report.swapped_frames > kSidesWrong * a.count())
    report.notes.push_back(
        formatted("left and right of the keypoints are exchanged in %d of %d frames, and put right: are they "
                  "named as the file says?",
                  report.swapped_frames, a.count()));
}

/// Keypoints of a picture at half its size put the person twice as far away.
void report_distance(const motion::Clip& before, const motion::Clip& after, FitReport& report) {
  std::vector<double> depth_before, depth_after;
  for (int t = 0; t < before.frames(); ++t) {
    const Eigen::Matrix4d& camera = motion::camera_at(before.keypoints->extrinsics, t);
    const auto depth = [&](const motion::Clip& clip) { return (camera * clip.trans[t].homogeneous()).z(); };
    depth_before.push_back(depth(before));
    depth_after.push_back(depth(after));
  }
  const double from = median(depth_before), to = median(depth_after);
  if (to >= kFartherAway * from || from >= kFartherAway * to)
    report.notes.push_back(formatted(
        "the keypoint fit moves the person from %.1f to %.1f m from the camera: are keypoints and camera "
        "of pictures of one size?",
        from, to));
  else if (report.residual_before > kFarBefore)
    report.notes.push_back(
        formatted("the keypoints were %.0f %% of the person's height from the motion before the fit: are "
                  "keypoints and camera of "
                  "this motion, and of pictures of one size?",
                  report.residual_before));
}

void report_levels(const FitProblem& problem, const FitState& state, FitReport& report) {
  report.lead_frames = state.g[kLead];
  if (std::abs(report.lead_frames) * kReferenceFps > kFarAhead * problem.fps)
    report.notes.push_back(
        formatted("the keypoints are %.1f frames or more %s the motion: are both of the same "
                  "frames of the video?",
                  std::abs(report.lead_frames), report.lead_frames > 0.0 ? "ahead of" : "behind"));
  report.confidence_power = problem.levels.confidence_power;
  if (problem.points.empty()) return;
  const std::vector<double>& sigma = problem.levels.keypoint;
  report.keypoint_sigma = kPercent * median(sigma);
  report.keypoint_sigma_max = kPercent * *std::max_element(sigma.begin(), sigma.end());
}

}  // namespace

motion::Clip solved(const motion::Clip& clip, FitProblem& problem, FitReport& report) {
  try {
    const FitState state = iterate(problem, report);
    const motion::Clip fitted = result_of(clip, problem, state);
    const PerFrame<BodyPoses> before = motion::poses_of(clip), after = motion::poses_of(fitted);
    report.fitted = true;
    if (!problem.poses_alone) {
      report_distance(clip, fitted, report);
      report_other_motion(before, after, report);
    }
    report.focal_scale = exp(state.g[kLogFocal]);
    report.tilt_deg = state.g[kTilt] / kDegree;
    report_levels(problem, state, report);
    report.shape_change = state.g.segment<kBetas>(kFirstBeta).cwiseAbs().maxCoeff();
    report_change(before, after, report);
    report_scene(clip.scene, fitted.scene, report);
    return fitted;
  } catch (const std::domain_error& error) {
    report.notes.push_back(std::string(error.what()) + ": not fitted");
    return clip;
  }
}

}  // namespace mimicx::fit

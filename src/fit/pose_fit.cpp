#include "fit/pose_fit.h"

#include <algorithm>

#include "core/quantile.h"
#include "core/units.h"
#include "fit/least_squares/contacts.h"
#include "fit/least_squares/gauss_newton.h"
#include "motion/prepare/bridging.h"
#include "motion/prepare/feet.h"
#include "motion/prepare/floor_correction.h"
#include "motion/surface_points.h"

namespace mimicx::fit {
namespace {

constexpr int kFewestFrames = 4;  ///< needed to measure a tremor

/// Puts the input on the floor as preparation does: standing feet can only be found there. Feet below the
/// floor do not lift the body for single frames: the fit lifts them by the legs.
void put_on_floor(bool known, FitProblem& problem) {
  const Character character = character_of(problem, initial_state(problem));
  const std::vector<motion::SurfacePoint> points = motion::surface_points(character);
  const std::vector<motion::SurfacePoint> others(points.begin() + kFootPoints, points.end());
  PerFrame<BodyPoses> poses;
  for (int t = 0; t < problem.frames(); ++t)
    poses.push_back(forward_kinematics(character, problem.p_root[t], problem.q[t]));
  const motion::FloorCorrection floor = motion::floor_correction(
      motion::standing_heights(points, poses, problem.fps, problem.scene),
      motion::lowest_resting_heights(others, poses, problem.scene), problem.fps, known);
  for (int t = 0; t < problem.frames(); ++t) problem.p_root[t].z() += floor.height[t];
}

/// A problem without detections, on the floor.
FitProblem problem_of(const motion::Clip& clip, const FitConfig& config) {
  motion::Clip blind = clip;
  blind.keypoints.reset();
  FitProblem problem = make_problem(blind, config);
  problem.poses_alone = true;
  problem.penalises_acceleration = problem.rotation_jitter >= kTremor * kDegree;
  FitConfig& own = problem.config;
  own.prior_frames = problem.penalises_acceleration ? config.tremor_prior_frames : config.pose_prior_frames;
  own.joint_bend = config.pose_joint_bend;
  own.root_rotation_sigma = config.pose_root_rotation_sigma;
  put_on_floor(clip.on_floor, problem);
  return problem;
}

double slip_of(const FitProblem& problem) {
  const FitState state = initial_state(problem);
  const Character character = character_of(problem, state);
  PerFrame<FootPositions> feet;
  for (int t = 0; t < problem.frames(); ++t)
    feet.push_back(foot_positions(character, kinematics(problem, state, character, t)));
  const Contacts contacts = find_contacts(feet, problem.fps, problem.scene, true);
  std::vector<double> steps;
  for (int t = 0; t + 1 < problem.frames(); ++t)
    for (int i = 0; i < kFootPoints; ++i)
      if (contacts[t][i] && contacts[t + 1][i]) steps.push_back((feet[t + 1][i] - feet[t][i]).norm());
  return steps.empty() ? 0.0 : median(steps) * problem.fps / kReferenceFps;
}

/// The prior of a motion whose feet slide little: it is as exact as they are.
void trust(double share, FitConfig& config) {
  constexpr double kLeast = 0.05;
  config.joint_sigma *= std::max(share, kLeast);
  config.root_rotation_sigma *= std::max(share, kLeast);
}

}  // namespace

motion::Clip fit_poses(const motion::Clip& clip, const FitConfig& config, FitReport* report) {
  FitReport r;
  if (report) *report = r;
  if (clip.frames() < kFewestFrames) return clip;
  motion::require_usable(clip, kFewestFrames);
  const motion::BridgedClip whole = motion::bridged(clip);
  FitProblem problem = problem_of(whole.clip, config);
  if (!problem.penalises_acceleration) {
    const double slip = slip_of(problem);
    if (slip < kStandingSlip) return clip;
    trust(std::min(slip / config.pose_slip, 1.0), problem.config);
  }
  motion::Clip fitted = solved(whole.clip, problem, r);
  r.flagged = whole.flagged;
  r.limb_frames = whole.limb_frames;
  if (report) *report = r;
  return fitted;
}

}  // namespace mimicx::fit

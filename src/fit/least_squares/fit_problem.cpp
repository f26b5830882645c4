#include "fit/least_squares/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "fit/jitter.h"
#include "motion/keypoint_names.h"
#include "motion/prepare/hinge.h"

namespace mimicx::fit {
namespace {

/// The keypoints with a position on the body, each with the index of its mirror point.
std::vector<FitPoint> points_among(const std::vector<std::string>& names, const Character& character) {
  std::vector<FitPoint> points;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const auto place = motion::place_of_keypoint(names[k]))
      points.push_back({place->body, k, points.size(), motion::place_on(character, *place)});
  for (FitPoint& point : points) {
    if (kLimbOf[point.body] == 0) continue;  // of the trunk
    const std::string other = motion::mirrored_name(names[point.column]);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (names[points[i].column] == other) point.mirror = i;
  }
  return points;
}

/// Derivatives of the keypoints' positions on their bodies by β.
void add_shape_derivatives(const std::vector<std::string>& names, std::vector<FitPoint>& points) {
  const Character standard = make_character();
  for (std::size_t k = 0; k < kBetas; ++k) {
    std::array<double, kBetas> unit{};
    unit[k] = 1.0;
    const Character character = make_character(unit);
    for (FitPoint& point : points) {
      const motion::KeypointPlace place = *motion::place_of_keypoint(names[point.column]);
      point.by_beta.col(static_cast<Eigen::Index>(k)) =
          motion::place_on(character, place) - motion::place_on(standard, place);
    }
  }
}

void add_points(const motion::Keypoints& keypoints, const Character& character, FitProblem& problem) {
  problem.points = points_among(keypoints.names, character);
  add_shape_derivatives(keypoints.names, problem.points);
  for (const auto& frame : keypoints.uvc) {
    problem.uvc.emplace_back();
    for (const FitPoint& point : problem.points) {
      const Vector3d& seen = frame[point.column];
      problem.uvc.back().push_back(seen.allFinite() ? seen : Vector3d::Zero());
    }
  }
  problem.intrinsics = keypoints.intrinsics;
  problem.extrinsics = keypoints.extrinsics;
}

/// Larger side of the box around the 22 projected joints of the input, px; 0 where the camera does not see
/// it.
double box_of(const FitProblem& problem, int t, const BodyPoses& poses) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30), high = -low;
  for (const Vector3d& p : poses.p_WB) {
    const Vector3d p_C = (motion::camera_at(problem.extrinsics, t) * p.homogeneous()).head<3>();
    if (p_C.z() < kClosest) return 0.0;
    const Eigen::Vector2d uv = (problem.intrinsics * p_C).hnormalized();
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  return (high - low).maxCoeff();
}

void measure_jitter(const PerFrame<PerBody<Quaterniond>>& q, FitProblem& problem) {
  std::vector<double> rotations, positions;
  for (int b = 1; b < kBodies; ++b) {
    std::vector<double> own;
    for (int t = 0; t + 3 < q.count(); ++t) {
      Array<Vector3d, 3> step;
      for (int i = 0; i < 3; ++i) step[i] = log_map(q[t + i][b].conjugate() * q[t + i + 1][b]);
      for (double x : (step[0] - 2.0 * step[1] + step[2]).eval()) own.push_back(std::abs(x));
    }
    problem.joint_jitter[b] = jitter_of(own);
    rotations.insert(rotations.end(), own.begin(), own.end());
  }
  for (int t = 0; t + 3 < q.count(); ++t) {
    const auto& p = problem.p_root;
    for (double x : (p[t + 3] - 3.0 * p[t + 2] + 3.0 * p[t + 1] - p[t]).eval())
      positions.push_back(std::abs(x));
  }
  problem.rotation_jitter = jitter_of(rotations);
  problem.position_jitter = jitter_of(positions);
}

void add_shape_derivatives(FitProblem& problem) {
  const Character standard = make_character();
  for (std::size_t k = 0; k < kBetas; ++k) {
    std::array<double, kBetas> unit{};
    unit[k] = 1.0;
    const Character character = make_character(unit);
    const auto column = static_cast<Eigen::Index>(k);
    for (int b = 0; b < kBodies; ++b)
      problem.offset_by_beta[b].col(column) = character.joint_offset[b] - standard.joint_offset[b];
    for (std::size_t i = 0; i < kFootPoints; ++i) {
      const ContactPoint &point = character.contact_points[i], &rest = standard.contact_points[i];
      problem.foot_points[i].body = rest.body;
      problem.foot_points[i].by_beta.col(column) = sole_point(point) - sole_point(rest);
    }
  }
}

Array<double, kBetas> told_shape(const FitConfig& config) {
  Array<double, kBetas> sigma;
  sigma.fill(config.beta_sigma);
  return sigma;
}

/// The variation between people as σ of our entries of β: the first is stature, the others change
/// proportions. An entry is scaled by the bone that it changes most; one that changes no bone (girth) gets 0.
Array<double, kBetas> shapes_of_people(const FitConfig& config, const FitProblem& problem) {
  const Character standard = make_character();
  Array<double, kBetas> sigma{};
  for (int k = 0; k < kBetas; ++k) {
    double change = 0.0;
    for (int b = 1; b < kBodies; ++b)
      change = std::max(change, problem.offset_by_beta[b].col(k).norm() / standard.joint_offset[b].norm());
    if (change > 0.0) sigma[k] = (k == 0 ? config.stature_spread : config.proportion_spread) / change;
  }
  return sigma;
}

}  // namespace

FitProblem make_problem(const motion::Clip& clip, const FitConfig& config) {
  FitProblem problem;
  problem.config = config;
  problem.levels.confidence_power = config.confidence_power;
  problem.fps = clip.fps;
  problem.scene = clip.scene;
  problem.betas = clip.usable_betas();
  add_shape_derivatives(problem);
  if (clip.keypoints &&
      !clip.rest_joints)  // without keypoints the shape is not observable; with rest joints it is known
    problem.beta_sigma = clip.body_model == "mimicx" ? told_shape(config) : shapes_of_people(config, problem);
  problem.rest_joints = clip.rest_joints;
  const Character character = character_of(clip);
  problem.joint = character.joint;
  const auto input = motion::joint_rotations(clip);
  problem.q = motion::to_hinges(character, input);
  for (const Vector3d& trans : clip.trans) problem.p_root.push_back(trans + motion::rest_pelvis(clip));
  measure_jitter(input, problem);
  if (!clip.keypoints) return problem;
  add_points(*clip.keypoints, character, problem);
  problem.levels.keypoint.assign(problem.points.size(), config.keypoint_sigma);
  for (int t = 0; t < problem.frames(); ++t)
    problem.box.push_back(box_of(problem, t, forward_kinematics(character, problem.p_root[t], problem.q[t])));
  return problem;
}

FitState initial_state(const FitProblem& problem) {
  return {PerFrame<FrameVector>(problem.q.size(), FrameVector::Zero()), VectorXd::Zero(problem.globals())};
}

Character character_of(const FitProblem& problem, const FitState& state) {
  if (problem.rest_joints) return make_character_of_joints(*problem.rest_joints);
  std::array<double, kBetas> betas = problem.betas;
  for (std::size_t i = 0; i < kBetas; ++i)
    betas[i] = std::clamp(betas[i] + state.g[kFirstBeta + static_cast<int>(i)], -kMaxBeta, kMaxBeta);
  return make_character(betas);
}

PerBody<Quaterniond> rotations_of(const FitProblem& problem, const FitState& state, int t) {
  PerBody<Quaterniond> q = problem.q[t];
  const FrameVector& c = state.c[t];
  q[0] = (q[0] * exp_map(c.segment<3>(kRootRotation))).normalized();
  for (int b = 1; b < kBodies; ++b) {
    const int at = kFirstJoint + first_dof(b);
    const Vector3d turn = is_hinge(b) ? Vector3d(c[at] * hinge_axis(b)) : Vector3d(c.segment<3>(at));
    q[b] = (q[b] * exp_map(turn)).normalized();
  }
  return q;
}

}  // namespace mimicx::fit

#include "synth/whole_body_balance.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "synth/footsteps.h"
#include "synth/min_jerk_track.h"

namespace mimicx::synth {
namespace {

// A pelvis that moves by 1 moves the centre of mass by 0.6 (legs planted) to 1 (in flight). With this gain
// each correction leaves less than 0.3 of the error.
constexpr double kPoseGain = 1.28, kPoseTolerance = 1e-14;  // m
constexpr int kPoseIterations = 40;
constexpr int kBalanceIterations = 6;
constexpr double kStraightestKnee = 0.10;  // rad; the pelvis is lowered for straighter legs

constexpr double kLight = 0.3;  // share of the weight under which the floor cannot turn the body
// Inertia of pelvis and trunk over the whole mass, about the model's axes, m². A rough figure is enough,
// because the iteration corrects it.
const Vector3d kTrunkInertia(0.09, 0.03, 0.09);
constexpr double kTiltSmooth = 1e-2, kTiltSmall = 1.2e-4;  // weights of third differences; of the tilt itself

Quaterniond arm_rotation(int side, const ArmPosture& arm) {
  const double mirror = side == 0 ? 1.0 : -1.0;
  constexpr double kQuarterTurn = 1.5707963267948966;
  return exp_map(-arm.forward * Vector3d::UnitX()) *
         exp_map(mirror * (arm.out - kQuarterTurn) * Vector3d::UnitZ()) *
         exp_map(-arm.rotation * Vector3d::UnitX());
}

void set_legs(const Character& character, const PlanFrame& frame, const PerSide<FootPose>& feet,
              SynthPose& pose) {
  pose.shortfall = 0.0;
  for (int side = 0; side < 2; ++side) {
    // Knees bend over the toes: their axis lies across the foot.
    const Vector3d across = rotation_z(frame.foot[side].yaw) * Vector3d::UnitY();
    const LegPose leg = solve_leg(character, side, pose.p_root, pose.q[kPelvis], feet[side], across);
    pose.q[kLeftHip + side] = leg.hip;
    pose.q[kLeftKnee + side] = exp_map(leg.knee * Vector3d::UnitX());
    pose.q[kLeftAnkle + side] = leg.ankle;
    pose.q[kLeftFoot + side] = feet[side].q_toes;
    pose.knee[side] = leg.knee;
    pose.shortfall = std::max(pose.shortfall, leg.shortfall);
  }
}

/// Angular momentum about the centre of mass between two frames, over the total mass.
Vector3d specific_spin(const Character& c, const BodyPoses& a, const BodyPoses& b, double dt) {
  const Vector3d com_velocity = (center_of_mass(c, b) - center_of_mass(c, a)) / dt;
  const Vector3d com = 0.5 * (center_of_mass(c, a) + center_of_mass(c, b));
  Vector3d spin = Vector3d::Zero();
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d p_a = a.p_WB[i] + a.q_WB[i] * c.com_B[i], p_b = b.p_WB[i] + b.q_WB[i] * c.com_B[i];
    const Vector3d turn_B = log_map(a.q_WB[i].conjugate() * b.q_WB[i]) / dt;
    spin += c.mass[i] * (0.5 * (p_a + p_b) - com).cross((p_b - p_a) / dt - com_velocity) +
            a.q_WB[i] * exp_map(0.5 * dt * turn_B) * (c.inertia_B[i] * turn_B);
  }
  return spin / c.total_mass();
}

/// Rate of the specific angular momentum at every frame, m²/s², of the motion as it stands; 0 at both ends.
PerFrame<Vector3d> spin_rates(const Character& character, const PerFrame<SynthPose>& motion, double fps) {
  PerFrame<BodyPoses> poses;
  for (const SynthPose& pose : motion) poses.push_back(forward_kinematics(character, pose.p_root, pose.q));
  PerFrame<Vector3d> spins, rates(motion.size(), Vector3d::Zero());
  for (int i = 0; i + 1 < motion.count(); ++i)
    spins.push_back(specific_spin(character, poses[i], poses[i + 1], 1.0 / fps));
  for (int i = 1; i + 1 < motion.count(); ++i) rates[i] = fps * (spins[i] - spins[i - 1]);
  return rates;
}

/// What the floor carries at a frame (not the first or last), per mass, m/s².
double weight_at(const PerFrame<PlanFrame>& plan, int i, double fps) {
  if (plan[i].flight) return 0.0;
  const double rise = plan[i + 1].com_height - 2.0 * plan[i].com_height + plan[i - 1].com_height;
  return std::max(0.0, kGravity + fps * fps * rise);
}

/// The smooth track whose second differences come closest to `wanted` in the frames that are `bound`.
Eigen::MatrixX3d track_of_accelerations(const Eigen::MatrixX3d& wanted, const PerFrame<bool>& bound) {
  const int n = bound.count();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
  const auto add_square = [&](int first, double weight, const auto& coefficients) {
    for (int a = 0; a < coefficients.size(); ++a)
      for (int b = 0; b < coefficients.size(); ++b)
        entries.emplace_back(first + a, first + b, weight * coefficients[a] * coefficients[b]);
  };
  const Vector3d second(1.0, -2.0, 1.0);
  const Eigen::Vector4d third(-1.0, 3.0, -3.0, 1.0);
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, kTiltSmall);
    if (i + 3 < n) add_square(i, kTiltSmooth, third);
    if (!bound[i]) continue;
    add_square(i - 1, 1.0, second);
    right.middleRows<3>(i - 1) += second * wanted.row(i);
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(right);
}

/// Tilts the pelvis, and the trunk with it, so that the body's angular momentum stays what it is in frames in
/// which the floor can hardly change it.
/// @param drawn    the plan before any tilt
/// @param rates    `spin_rates` of the motion with the last tilt
/// @param wanted   [frames] target second differences of the tilt, rad; corrected by the remaining `rates`
/// @param plan     gets the pelvis of `drawn` with the new tilt
void keep_spin_in_flight(const PerFrame<PlanFrame>& drawn, const PerFrame<Vector3d>& rates, double fps,
                         Eigen::MatrixX3d& wanted, PerFrame<PlanFrame>& plan) {
  if (std::none_of(plan.begin(), plan.end(), [](const PlanFrame& frame) { return frame.flight; })) return;
  PerFrame<bool> bound(plan.size(), false);
  for (int i = 1; i + 1 < plan.count(); ++i) {
    bound[i] = weight_at(plan, i, fps) < kLight * kGravity;
    if (!bound[i]) continue;
    const Vector3d rate = kModelToPlan.conjugate() * (rotation_z(-plan[i].heading) * rates[i]);
    wanted.row(i) -= rate.cwiseQuotient(kTrunkInertia).transpose() / (fps * fps);
  }
  const Eigen::MatrixX3d tilt = track_of_accelerations(wanted, bound);
  for (int i = 0; i < plan.count(); ++i) plan[i].pelvis = drawn[i].pelvis + tilt.row(i).transpose();
}

/// Whether the height of a frame belongs to the parabola of a flight: frames in the air, and those around
/// them.
PerFrame<bool> on_parabola(const PerFrame<PlanFrame>& plan) {
  PerFrame<bool> on(plan.size());
  for (int i = 0; i < plan.count(); ++i)
    on[i] = plan[i].flight || (i > 0 && plan[i - 1].flight) || (i + 1 < plan.count() && plan[i + 1].flight);
  return on;
}

/// Lowers the centre of mass, smoothly in time, where a knee of `motion` is straighter than it should be. On
/// the parabola of a flight the height is not free: there the plan must be right from the start, and a need
/// within kSpread frames of it leaves a step in the height.
void lower_where_stretched(const Character& character, const PerFrame<SynthPose>& motion,
                           PerFrame<PlanFrame>& plan) {
  constexpr int kSpread = 7;
  constexpr double kSmoothing = 2.5;  // frames; kSpread covers it, so that no need is averaged away
  const int n = plan.count();
  const PerFrame<bool> fixed = on_parabola(plan);
  PerFrame<double> needed(plan.size(), 0.0), lowered(plan.size(), 0.0);
  for (int i = 0; i < plan.count(); ++i) {
    if (fixed[i] || std::min(motion[i].knee[0], motion[i].knee[1]) >= kStraightestKnee) continue;
    const Eigen::Vector2d com = motion[i].p_com.head<2>();
    needed[i] = plan[i].com_height - com_height_for_knee(character, plan[i], com, 1.05 * kStraightestKnee);
  }
  for (int i = 0; i < n; ++i)
    for (int k = std::max(0, i - kSpread); k <= std::min(n - 1, i + kSpread); ++k)
      lowered[i] = std::max(lowered[i], needed[k]);
  lowered = smoothed(lowered, kSmoothing);
  for (int i = 0; i < plan.count(); ++i)
    if (!fixed[i]) plan[i].com_height -= lowered[i];
}

/// Path of the centre of mass over the floor: the tridiagonal system of the header, eliminated forwards.
PerFrame<Eigen::Vector2d> com_path(const PerFrame<PlanFrame>& plan, const PerFrame<Eigen::Vector2d>& moment,
                                   double fps) {
  const int n = plan.count();
  PerFrame<Eigen::Vector2d> path(plan.size());
  PerFrame<double> above(plan.size(), 0.0);  // the eliminated row reads c_i = path_i + above_i · c_{i+1}
  path.front() = plan.front().pressure;
  for (int i = 1; i + 1 < n; ++i) {
    const double h = plan[i].com_height - plan[i].pressure_height;
    const double bend = h * fps * fps, weight = weight_at(plan, i, fps);
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    if (!plan[i].flight) right = weight * plan[i].pressure + moment[i];
    const double pivot = 2.0 * bend + weight - bend * above[i - 1];
    above[i] = bend / pivot;
    path[i] = (right + bend * path[i - 1]) / pivot;
  }
  path.back() = plan.back().pressure;
  for (int i = n - 2; i >= 0; --i) path[i] += above[i] * path[i + 1];
  return path;
}

}  // namespace

PerBody<Quaterniond> posture_rotations(const PlanFrame& frame) {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = rotation_z(frame.heading) * kModelToPlan * exp_map(frame.pelvis);
  q[kSpine1] = exp_map(0.40 * frame.trunk);
  q[kSpine2] = exp_map(0.35 * frame.trunk);
  q[kSpine3] = exp_map(0.25 * frame.trunk);
  q[kNeck] = exp_map(0.40 * frame.head);
  q[kHead] = exp_map(0.60 * frame.head);
  for (int side = 0; side < 2; ++side) {
    q[kLeftShoulder + side] = arm_rotation(side, frame.arm[side]);
    q[kLeftElbow + side] = exp_map(frame.arm[side].elbow * hinge_axis(kLeftElbow + side));
  }
  return q;
}

SynthPose pose_at(const Character& character, const PlanFrame& frame, const Vector3d& p_com) {
  SynthPose pose;
  pose.p_com = p_com;
  pose.q = posture_rotations(frame);
  PerSide<FootPose> feet;
  for (int side = 0; side < 2; ++side) feet[side] = foot_pose(character, side, frame.foot[side]);
  pose.p_root = p_com;
  for (int iteration = 0; iteration < kPoseIterations; ++iteration) {
    set_legs(character, frame, feet, pose);
    const BodyPoses poses = forward_kinematics(character, pose.p_root, pose.q);
    const Vector3d error = p_com - center_of_mass(character, poses);
    if (error.norm() < kPoseTolerance) break;
    pose.p_root += kPoseGain * error;
  }
  return pose;
}

double com_height_for_knee(const Character& character, const PlanFrame& frame, const Eigen::Vector2d& com,
                           double knee) {
  double low = 0.2 * leg_length(character), high = 2.0 * leg_length(character);
  for (int bisection = 0; bisection < 40; ++bisection) {
    const double middle = 0.5 * (low + high);
    const SynthPose pose = pose_at(character, frame, {com.x(), com.y(), middle});
    (std::min(pose.knee[0], pose.knee[1]) > knee ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PerFrame<SynthPose> solve_plan(const Character& character, PerFrame<PlanFrame> plan, double fps) {
  const PerFrame<PlanFrame> drawn = plan;
  PerFrame<SynthPose> motion(plan.size());
  PerFrame<Eigen::Vector2d> moment(plan.size(), Eigen::Vector2d::Zero());  // ℓ of the header
  Eigen::MatrixX3d wanted_tilt = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(plan.size()), 3);
  for (int iteration = 0; iteration < kBalanceIterations; ++iteration) {
    if (iteration > 0) {
      lower_where_stretched(character, motion, plan);
      const PerFrame<Vector3d> rates = spin_rates(character, motion, fps);
      for (int i = 0; i < plan.count(); ++i) moment[i] = {rates[i].y(), -rates[i].x()};
      keep_spin_in_flight(drawn, rates, fps, wanted_tilt, plan);
    }
    const PerFrame<Eigen::Vector2d> path = com_path(plan, moment, fps);
    for (int i = 0; i < plan.count(); ++i)
      motion[i] = pose_at(character, plan[i], {path[i].x(), path[i].y(), plan[i].com_height});
  }
  for (int i = 0; i < motion.count(); ++i)
    if (motion[i].shortfall > 1e-6)
      throw std::invalid_argument("solve_plan: in frame " + std::to_string(i) + " a leg is too short by " +
                                  std::to_string(1e3 * motion[i].shortfall) + " mm");
  return motion;
}

}  // namespace mimicx::synth

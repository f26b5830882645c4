#include "rl/tracking/tracking_pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "physics/control_interval.h"
#include "physics/lanes.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl::tracking {
namespace {

TEST(TrackingPack, ActionHas55EntriesAndZeroResidualAimsAtTheReference) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(30), config);
  const std::array<float, 55> zero{};
  TrackingPack pack(clip, config);
  physics::Data<TrackingPack::P> scratch;
  for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, zero.data());
  pack.advance(scratch);
  EXPECT_EQ(pack.frame(0), 1);
  EXPECT_LT(pack.worst_distance(0), 0.01) << "one step of PD control towards the reference stays beside it";
}

TEST(TrackingPack, AbsoluteActionIsTheTargetPoseItself) {
  // Absolute actions equal to the next reference pose must give the motion of zero residuals.
  TrackingConfig absolute, residual;
  absolute.actions.mode = ActionMode::kAbsolute;
  const auto clip = make_tracking_clip(swaying_reference(30), residual);
  TrackingPack a(clip, absolute), r(clip, residual);
  physics::Data<TrackingPack::P> scratch;
  const std::array<float, kDofs> zero{};
  for (int t = 0; t < 5; ++t) {
    Array<float, kDofs> target{};
    const motion::ReferenceFrame& next = clip->poses[t + 1].frame;
    for (int body = 1; body < kBodies; ++body) {
      const Vector3d v = log_map(next.q[body]);
      const int dof = first_dof(body);
      if (is_hinge(body))
        target[dof] = static_cast<float>(v.dot(hinge_axis(body)));
      else
        for (int k = 0; k < 3; ++k) target[dof + k] = static_cast<float>(v[k]);
    }
    for (int lane = 0; lane < physics::kLanes; ++lane) {
      a.act(lane, target.data());
      r.act(lane, zero.data());
    }
    a.advance(scratch);
    r.advance(scratch);
  }
  for (int i = 0; i < kBodies; ++i)
    EXPECT_LT((a.pose(0).p_WB[i] - r.pose(0).p_WB[i]).norm(), 1e-4) << kBodyNames[i];
}

TEST(TrackingPack, WithoutRampAndFeedForwardTheTargetIsTheActionInEveryStep) {
  TrackingConfig config;
  config.actions = {ActionMode::kAbsolute, false, false};
  const auto clip = make_tracking_clip(swaying_reference(30), config);
  Array<float, kDofs> action{};
  for (int dof = 0; dof < kDofs; ++dof) action[dof] = 0.01F * static_cast<float>(dof % 7 - 3);
  const auto difference_at_first = [&](bool ramp) {
    config.actions.ramp = ramp;
    TrackingPack pack(clip, config);
    physics::Data<TrackingPack::P> scratch;
    for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, action.data());
    double first = -1.0, last = -1.0;
    pack.advance(scratch, nullptr, [&](const auto&, const auto& target, const auto&, const auto&) {
      last = 0.0;
      for (int body = 1; body < kBodies; ++body) {
        const Vector3d rotation =
            physics::action_rotation(body, config.actions.max_action, [&](int dof) { return action[dof]; });
        last = std::max(last, exp_map(rotation).angularDistance(physics::lane_of(target.q[body], 0)));
        EXPECT_EQ(physics::lane_of(target.omega[body], 0), Vector3d::Zero()) << kBodyNames[body];
      }
      if (first < 0.0) first = last;
    });
    EXPECT_LT(last, 1e-3) << "float32";
    return first;
  };
  EXPECT_LT(difference_at_first(false), 1e-3);
  EXPECT_GT(difference_at_first(true), 0.1) << "the ramp starts from the reference";
}

/// The largest rotations of a joint's range: hinges at their ends, ball joints on a grid of the ellipsoid.
std::vector<Vector3d> ends_of_range(const JointParameters& joint, int body) {
  if (is_hinge(body))
    return {(joint.centre.x() - joint.half_range.x()) * hinge_axis(body),
            (joint.centre.x() + joint.half_range.x()) * hinge_axis(body)};
  std::vector<Vector3d> ends;
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vector3d on_surface = joint.half_range.cwiseProduct(Vector3d(x, y, z).normalized());
        ends.push_back(log_map(exp_map(joint.centre) * exp_map(on_surface)));
      }
  return ends;
}

TEST(TrackingPack, AbsoluteActionsReachEveryPoseOfTheJointRanges) {
  const Character character = make_character();
  double largest = 0.0;
  for (int body = 1; body < kBodies; ++body)
    for (const Vector3d& end : ends_of_range(character.joint[body], body)) {
      const int dof = first_dof(body);
      const Vector3d reached = physics::action_rotation(body, ActionSettings{}.max_action, [&](int k) {
        return is_hinge(body) ? end.dot(hinge_axis(body)) : end[k - dof];
      });
      EXPECT_LT((reached - end).norm(), 1e-12) << kBodyNames[body] << ": " << end.transpose();
      largest = std::max(largest, end.cwiseAbs().maxCoeff());
    }
  EXPECT_GT(largest, 2.7) << "elbows bend to 162 degrees";
}

TEST(TrackingPack, TreatsNonFiniteActionEntriesAsZero) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(10), config);
  const std::array<float, kDofs> zero{};
  std::array<float, kDofs> none;
  none.fill(std::numeric_limits<float>::quiet_NaN());
  none[3] = std::numeric_limits<float>::infinity();
  TrackingPack with(clip, config), without(clip, config);
  physics::Data<TrackingPack::P> scratch;
  for (int lane = 0; lane < physics::kLanes; ++lane) {
    with.act(lane, none.data());
    without.act(lane, zero.data());
  }
  with.advance(scratch);
  without.advance(scratch);
  for (int i = 0; i < kBodies; ++i) EXPECT_EQ(with.pose(0).p_WB[i], without.pose(0).p_WB[i]);
}

TEST(TrackingPack, LanesOnDifferentFramesAreIndependent) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(40), config);
  const std::array<float, kDofs> zero{};
  std::array<float, kDofs> violent;
  violent.fill(2.0F);
  TrackingPack alone(clip, config), mixed(clip, config);
  physics::Data<TrackingPack::P> scratch;
  for (int lane = 1; lane < physics::kLanes; ++lane) mixed.reset(lane, lane);
  for (int t = 0; t < 10; ++t) {
    for (int lane = 0; lane < physics::kLanes; ++lane) {
      alone.act(lane, zero.data());
      mixed.act(lane, lane == 0 ? zero.data() : violent.data());
    }
    alone.advance(scratch);
    mixed.advance(scratch);
    if (t == 5) mixed.reset(3, 20);
  }
  for (int i = 0; i < kBodies; ++i) EXPECT_EQ(alone.pose(0).p_WB[i], mixed.pose(0).p_WB[i]);
  EXPECT_EQ(mixed.frame(3), 24);
}

}  // namespace
}  // namespace mimicx::rl::tracking

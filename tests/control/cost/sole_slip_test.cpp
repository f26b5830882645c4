// Slip of the soles' points and its derivatives.
#include "control/cost/sole_slip.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "control/cost/cost.h"
#include "control/fixtures.h"

namespace mimicx::control {
namespace {

const Landings kInTheAir{};  ///< a goal whose soles stay in the air

Array<Vec3<double>, kFootPoints> slip_of(const System& system, const State<double>& x,
                                         const Landings& goal = kInTheAir) {
  return sole_slip(system, goal, *exact_kinematics(system, x));
}

struct TurningWalk {
  System system = system_of(synthetic_reference("walk_turn", 501, 12));
  State<double> x = moved_at_random(system.at(5), 45, 0.3);
  Array<Vector3d, kFootPoints> soles(const State<double>& at) const {
    const BodyPoses poses = poses_of(system, at);
    Array<Vector3d, kFootPoints> p;
    for (int k = 0; k < kFootPoints; ++k)
      p[k] = poses.p_WB[system.sole[k].body] + poses.q_WB[system.sole[k].body] * system.sole[k].p_B;
    return p;
  }
  /// Moves the body up or down.
  void put(int point, double height) { x.p_root.z += height - soles(x)[point].z(); }
};

TEST(SoleSlip, JacobianMatchesDifferences) {
  TurningWalk s;
  constexpr double kStep = 1e-6;
  Landings goal{};
  for (int k = 0; k < kFootPoints; k += 4) goal[k] = {0.11 * k, {0.05 * k, -0.02 * k}};
  for (int point = 0; point < kFootPoints; ++point) {
    s.put(point, 0.001 + 0.003 * (point % 3));
    const SoleSlipJacobian J = sole_slip_jacobian(s.system, goal, *exact_kinematics(s.system, s.x));
    for (int k = 0; k < kTangent; ++k) {
      const auto a = slip_of(s.system, moved(s.x, k, kStep), goal),
                 b = slip_of(s.system, moved(s.x, k, -kStep), goal);
      for (int i = 0; i < kFootPoints; ++i) {
        const Vector3d expected = (to_eigen(a[i]) - to_eigen(b[i])) / (2.0 * kStep);
        EXPECT_LT((J.block<2, 1>(2 * i, k) - expected.head<2>()).norm(), 1e-4) << i << ", " << k;
      }
    }
  }
}

TEST(SoleSlip, HeightsAreOverThePlateUnderThePoint) {
  TurningWalk s;
  int lowest = 0;
  for (int k = 1; k < kFootPoints; ++k)
    if (s.soles(s.x)[k].z() < s.soles(s.x)[lowest].z()) lowest = k;
  s.put(lowest, -0.003);
  const motion::Reference reference = synthetic_reference("walk_turn", 501, 12);
  const System raised = make_system(reference.character, {}, s.system.reference, 30.0,
                                    {{{{0.0, 0.0}, 0.4, {50.0, 50.0}, 0.25}}});
  State<double> high = s.x;
  high.p_root.z += 0.25;
  const auto low_slip = slip_of(s.system, s.x), high_slip = slip_of(raised, high);
  for (int i = 0; i < kFootPoints; ++i)
    EXPECT_LT((to_eigen(low_slip[i]) - to_eigen(high_slip[i])).norm(), 1e-12) << i;
  const auto jacobian = [](const System& system, const State<double>& x) {
    return sole_slip_jacobian(system, kInTheAir, *exact_kinematics(system, x));
  };
  const SoleSlipJacobian J = jacobian(s.system, s.x);
  EXPECT_LT((jacobian(raised, high) - J).norm(), 1e-9 * J.norm());
}

// The rate of change of the positions of points below the floor, by a small step of the pose along its
// velocities.
TEST(SoleSlip, OnTheFloorItIsTheRateOfThePositions) {
  TurningWalk s;
  s.x.p_root.z -= 1.0;
  constexpr double kStep = 1e-6;
  const auto positions = [&](double time) {
    State<double> x = s.x;
    Tangent<double> delta{};
    for (int k = 0; k < 3; ++k) {
      delta[k] = time * to_eigen(s.x.v_root)[k];
      delta[kRootRotation + k] = time * to_eigen(s.x.omega[0])[k];
    }
    for (int k = 0; k < kDofs; ++k)
      delta[kJointRotation + k] = time * dofs()[k].axis.dot(to_eigen(s.x.omega[dofs()[k].body]));
    retract(x, delta);
    return s.soles(x);
  };
  const auto ahead = positions(kStep), behind = positions(-kStep);
  const auto slip = slip_of(s.system, s.x);
  for (int k = 0; k < kFootPoints; ++k) {
    const Vector3d rate = (ahead[k] - behind[k]) / (2.0 * kStep);
    EXPECT_LT((to_eigen(slip[k]) - Vector3d(rate.x(), rate.y(), 0.0)).norm(), 1e-5) << k;
  }
}

// A body that moves as a whole at 1 m/s: half of the slip is left at h, and all of it where the goal's point
// is about to stand. How fast the body comes down changes nothing.
TEST(SoleSlip, FadesWithHeightButNotWhereTheGoalIsAboutToStand) {
  TurningWalk s;
  for (int body = 0; body < kBodies; ++body) s.x.omega[body] = {0.0, 0.0, 0.0};
  Landings goal{};
  const auto slip_at = [&](double height, double rise) {
    s.put(0, height);
    s.x.v_root = {1.0, 0.0, rise};
    return slip_of(s.system, s.x, goal)[0].x;
  };
  EXPECT_NEAR(slip_at(kNearFloor, 0.0), 0.5, 1e-5);
  EXPECT_NEAR(slip_at(0.02, 0.0), 1.0 / 17.0, 1e-5);
  EXPECT_NEAR(slip_at(0.02, -0.6), 1.0 / 17.0, 1e-5);
  EXPECT_EQ(slip_at(-0.001, 0.0), 1.0);
  goal[0].near = 0.8;
  EXPECT_NEAR(slip_at(0.02, -0.6), 0.8, 1e-5);
  EXPECT_EQ(slip_at(-0.001, 0.0), 1.0);
}

// 2 cm over the floor a foot may move as fast as the goal's; on the floor it has to rest.
TEST(SoleSlip, FootThatIsToLandMayMoveAsTheGoals) {
  TurningWalk s;
  for (int body = 0; body < kBodies; ++body) s.x.omega[body] = {0.0, 0.0, 0.0};
  s.x.v_root = {0.3, -0.2, 0.0};
  Landings goal{};
  goal[0] = {0.8, 0.8 * Eigen::Vector2d(0.3, -0.2)};
  s.put(0, 0.02);
  const auto high = slip_of(s.system, s.x, goal);
  EXPECT_NEAR(high[0].x, 0.8 * 0.3 / 17.0, 1e-5);
  EXPECT_NEAR(high[0].y, -0.8 * 0.2 / 17.0, 1e-5);
  s.put(0, -0.001);
  const auto low = slip_of(s.system, s.x, goal);
  EXPECT_EQ(low[0].x, 0.3);
  EXPECT_EQ(low[0].y, -0.2);
}

/// What the lowest sole point is about to do, of a body whose soles are on the floor from frame 5 on. Before
/// frame 7 it moves by `step` a frame, m.
List<Landing> landing(double step) {
  TurningWalk s;
  const Array<Vector3d, kFootPoints> soles = s.soles(s.system.at(5));
  int lowest = 0;
  for (int k = 1; k < kFootPoints; ++k)
    if (soles[k].z() < soles[lowest].z()) lowest = k;
  List<State<double>> goal(10, s.system.at(5));
  for (int t = 0; t < goal.count(); ++t) {
    goal[t].p_root.z += (t < 5 ? 1.0 : 0.0) - soles[lowest].z();
    goal[t].p_root.x += step * std::min(t, 7);
  }
  List<SolePlaces> places;
  for (const State<double>& x : goal) places.push_back(sole_places(s.system, *exact_kinematics(s.system, x)));
  List<Landing> of_lowest;
  for (const Landings& goal_points : landings(s.system, places)) of_lowest.push_back(goal_points[lowest]);
  return of_lowest;
}

TEST(SoleSlip, GoalIsAboutToStandForTwoFrames) {
  const List<Landing> found = landing(kNearFloor);
  const double slows = 1.0 / (1.0 + square(kNearFloor / kSwinging));
  for (int t = 0; t < found.count(); ++t) {
    const double expected = t < 3 || t == 9 ? 0.0 : t < 5 ? 0.5 * slows : t < 7 ? slows : 1.0;
    EXPECT_NEAR(found[t].near, expected, 1e-4) << t;
  }
}

TEST(SoleSlip, GoalsVelocityIsItsWayUntilTheNextFrame) {
  const List<Landing> found = landing(0.002);
  for (int t = 0; t < found.count(); ++t) {
    EXPECT_NEAR(found[t].v.x(), t < 7 ? found[t].near * 0.002 * 30.0 : 0.0, 1e-9) << t;
    EXPECT_NEAR(found[t].v.y(), 0.0, 1e-9) << t;
  }
}

TEST(SoleSlip, GoalThatSwingsItsFootIsNotAboutToStand) {
  EXPECT_NEAR(landing(kSwinging)[6].near, 0.5, 1e-4);
  EXPECT_NEAR(landing(0.1)[6].near, 1.0 / (1.0 + square(0.1 / kSwinging)), 1e-4);
  EXPECT_LT(landing(0.1)[4].near, 0.001);
}

}  // namespace
}  // namespace mimicx::control

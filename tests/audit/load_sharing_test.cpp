#include "audit/load_sharing/load_sharing.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "audit/load_sharing/linear_program.h"
#include "audit/thrown.h"
#include "core/random.h"
#include "core/units.h"
#include "motion/standing_clip.h"

namespace mimicx::audit {
namespace {

constexpr double kLoad = 700.0;

/// Every vertex of {x ≥ 0, A x = b}: all sets of as many columns as rows, solved.
template <int rows>
List<Eigen::VectorXd> all_vertices(const Eigen::Matrix<double, rows, Eigen::Dynamic>& A,
                                   const Eigen::Vector<double, rows>& b) {
  List<Eigen::VectorXd> vertices;
  std::vector<bool> chosen(static_cast<std::size_t>(A.cols()), false);
  std::fill(chosen.begin(), chosen.begin() + rows, true);
  do {
    Eigen::Matrix<double, rows, rows> square;
    std::vector<Eigen::Index> columns;
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      if (chosen[static_cast<std::size_t>(k)]) columns.push_back(k);
    for (Eigen::Index i = 0; i < rows; ++i) square.col(i) = A.col(columns[static_cast<std::size_t>(i)]);
    const Eigen::FullPivLU<Eigen::Matrix<double, rows, rows>> lu(square);
    if (!lu.isInvertible()) continue;
    const Eigen::Vector<double, rows> part = lu.solve(b);
    if (part.minCoeff() < -1e-9) continue;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
    for (Eigen::Index i = 0; i < rows; ++i) x[columns[static_cast<std::size_t>(i)]] = part[i];
    vertices.push_back(x);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return vertices;
}

/// Two feet with a heel and a toe each, and the pyramids' four edges: the columns of the wrenches about the
/// origin's height of one metre.
struct FourPoints {
  Vector3d center{0.02, 0.01, 1.0};
  List<Push> points = {{kLeftAnkle, {-0.05, 0.12, 0.0}, Vector3d::Zero()},
                       {kLeftFoot, {0.17, 0.15, 0.0}, Vector3d::Zero()},
                       {kRightAnkle, {-0.02, -0.09, 0.0}, Vector3d::Zero()},
                       {kRightFoot, {0.21, -0.13, 0.0}, Vector3d::Zero()}};
  SharingConfig config{.friction = 0.6, .edges = 4, .pressure = 0.0};

  Vector3d edge(int k) const {
    const double angle = std::numbers::pi / 2 * k;
    return {config.friction * std::cos(angle), config.friction * std::sin(angle), 1.0};
  }
  Eigen::Matrix<double, 6, Eigen::Dynamic> columns() const {
    Eigen::Matrix<double, 6, Eigen::Dynamic> A(6, 16);
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k) A.col(4 * i + k) << (points[i].p - center).cross(edge(k)), edge(k);
    return A;
  }
  /// The component of a foot's force.
  double force(const Eigen::VectorXd& x, int foot, int axis) const {
    double sum = 0.0;
    for (int i = 2 * foot; i < 2 * foot + 2; ++i)
      for (int k = 0; k < 4; ++k) sum += x[4 * i + k] * edge(k)[axis];
    return sum;
  }
};

/// Joints of a standing body, moved over the four points; all bounds are 200 N·m.
LegEffort standing_legs() {
  LegEffort legs{motion::poses_of(motion::standing_clip(1))[0], {}, {}};
  legs.moment.fill(Vector3d::Zero());
  legs.bound.fill(200.0);
  const int knees[] = {kLeftKnee, kRightKnee};
  for (const int knee : knees) legs.moment[knee] = Vector3d(10.0, -20.0, 3.0);
  return legs;
}

/// Σ (torque / bound)² of the legs under the forces x, independently of the program's own sums.
double effort_of_forces(const FourPoints& four, const LegEffort& legs, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (const int joint :
       {kLeftHip, kRightHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot}) {
    Vector3d torque = legs.moment[joint];
    for (int i = 0; i < 4; ++i) {
      const bool same_side = (i < 2) == (joint % 3 == 1);  // bodies of the left leg are 1, 4, 7, 10
      const bool below = joint < kLeftFoot || i % 2 == 1;  // the ball's joint carries the toe alone
      if (!same_side || !below) continue;
      for (int k = 0; k < 4; ++k)
        torque -= x[4 * i + k] * (four.points[i].p - legs.poses.p_WB[joint]).cross(four.edge(k));
    }
    const bool knee = joint == kLeftKnee || joint == kRightKnee;
    const double part = knee ? torque.dot(legs.poses.q_WB[joint] * hinge_axis(joint)) : torque.norm();
    sum += part * part / (200.0 * 200.0);
  }
  return sum;
}

class LoadSharingOfFourPoints : public testing::Test {
 protected:
  /// The ranges are those of the forces in `vertices`.
  void expect_ranges(const LoadSharing& sharing, const List<Eigen::VectorXd>& vertices) const {
    ASSERT_GT(vertices.size(), 5U);
    for (int foot = 0; foot < 2; ++foot)
      for (int axis = 0; axis < 3; ++axis) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const Eigen::VectorXd& x : vertices) {
          least = std::min(least, four_.force(x, foot, axis));
          most = std::max(most, four_.force(x, foot, axis));
        }
        EXPECT_NEAR(sharing.least[foot][axis], least, 1e-3 * kLoad) << foot << axis;
        EXPECT_NEAR(sharing.most[foot][axis], most, 1e-3 * kLoad) << foot << axis;
      }
  }
  /// A wrench that the points can supply.
  Vector6d random_wrench(std::uint64_t seed) const {
    Random random(seed, {1});
    Eigen::VectorXd x(16);
    for (Eigen::Index k = 0; k < 16; ++k) x[k] = random.uniform(0.0, kLoad / 8.0);
    return four_.columns() * x;
  }
  const FourPoints four_;
  const LegEffort legs_ = standing_legs();
};

TEST_F(LoadSharingOfFourPoints, RangesAreThoseOfAllVertices) {
  for (const std::uint64_t seed : {501u, 502u, 503u}) {
    SCOPED_TRACE(seed);
    const Vector6d wanted = random_wrench(seed);
    expect_ranges(share_load(wanted, four_.center, four_.points, Matrix3d::Identity(), legs_, four_.config),
                  all_vertices<6>(four_.columns(), wanted));
  }
}

// Four more unknowns are how far the load moves to the front, the left, the back and the right, m.
TEST_F(LoadSharingOfFourPoints, RangesCoverEveryPressureWithinTheirDistance) {
  SharingConfig config = four_.config;
  config.pressure = 0.02;
  const Vector6d wanted = random_wrench(501);
  Eigen::Matrix<double, 7, Eigen::Dynamic> A = Eigen::Matrix<double, 7, Eigen::Dynamic>::Zero(7, 21);
  A.topLeftCorner<6, 16>() = four_.columns();
  for (int k = 0; k < 4; ++k) {
    const Vector3d away(std::cos(0.5 * std::numbers::pi * k), std::sin(0.5 * std::numbers::pi * k), 0.0);
    A.col(16 + k) << away.cross(Vector3d(0, 0, wanted[5])), Vector3d::Zero(), 1.0;
  }
  A(6, 20) = 1.0;  // what is left of the distance
  Eigen::Vector<double, 7> b;
  b << wanted, config.pressure;
  const LoadSharing sharing =
      share_load(wanted, four_.center, four_.points, Matrix3d::Identity(), legs_, config);
  expect_ranges(sharing, all_vertices<7>(A, b));
  const LoadSharing exact =
      share_load(wanted, four_.center, four_.points, Matrix3d::Identity(), legs_, four_.config);
  EXPECT_GT(sharing.most[0].z() - sharing.least[0].z(),
            exact.most[0].z() - exact.least[0].z() + 0.02 * kLoad);
  EXPECT_EQ(sharing.least_effort[0], exact.least_effort[0]);
}

TEST_F(LoadSharingOfFourPoints, NoMixtureOfVerticesTakesLessEffort) {
  const Vector6d wanted = random_wrench(504);
  const auto vertices = all_vertices<6>(four_.columns(), wanted);
  const LoadSharing sharing =
      share_load(wanted, four_.center, four_.points, Matrix3d::Identity(), legs_, four_.config);
  // The mixture of least effort by brute force: pairwise Frank–Wolfe steps over the vertices.
  Eigen::VectorXd best = vertices.front();
  for (int round = 0; round < 4000; ++round) {
    const Eigen::VectorXd* target = nullptr;
    double lowest = effort_of_forces(four_, legs_, best), part = 0.0;
    for (const Eigen::VectorXd& v : vertices) {
      // The effort is a parabola on the way from `best` to v.
      const double e0 = effort_of_forces(four_, legs_, best), e1 = effort_of_forces(four_, legs_, v),
                   middle = effort_of_forces(four_, legs_, 0.5 * (best + v));
      const double curve = 2.0 * (e0 + e1 - 2.0 * middle), slope = e1 - e0 - curve;
      if (!(slope < 0.0) || !(curve > 0.0)) continue;
      const double s = std::min(1.0, -slope / (2.0 * curve)), e = e0 + slope * s + curve * s * s;
      if (e < lowest) lowest = e, part = s, target = &v;
    }
    if (!target) break;
    best += part * (*target - best);
  }
  for (int foot = 0; foot < 2; ++foot)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(sharing.least_effort[foot][axis], four_.force(best, foot, axis), 0.02 * kLoad)
          << foot << axis;
}

TEST_F(LoadSharingOfFourPoints, FootThatAloneTouchesCarriesAll) {
  List<Push> left = {four_.points[0], four_.points[1]};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(16);
  x.head(8).setConstant(kLoad / 8.0);
  const LoadSharing sharing =
      share_load(four_.columns() * x, four_.center, left, Matrix3d::Identity(), legs_, four_.config);
  EXPECT_NEAR(sharing.least[0].z(), kLoad, 1e-3 * kLoad);
  EXPECT_NEAR(sharing.most[0].z(), kLoad, 1e-3 * kLoad);
  EXPECT_NEAR(sharing.least_effort[0].z(), kLoad, 1e-2 * kLoad);
  EXPECT_EQ(sharing.most[1], Vector3d::Zero());
}

TEST(LoadSharing, PointCarriesATenthOfASecondBeforeItTouches) {
  // A body hangs in the air, one foot 1 cm above the floor at the last frame.
  const Thrown thrown(240.0, 0.0);
  SimulatedFrames motion = thrown.frames();
  motion::ReferenceFrame lifted = motion.frames[20];
  const BodyPoses poses = forward_kinematics(motion.character, lifted.p_root, lifted.q);
  lifted.p_root.z() += 0.5 - lowest_contact(motion.character, poses);
  motion.frames.assign(motion.frames.size(), lifted);
  motion.frames[30].p_root.z() -= 0.49;
  for (auto& acting : motion.forces) {
    for (Vector6d& wrench : acting.ground) wrench.setZero();
    acting.ground[kLeftAnkle][5] = 100.0;
  }
  const PerFrame<LoadSharing> sharing = load_sharing(motion);
  const auto carried = [&](int t) { return sharing[t].most[0].z() + sharing[t].most[1].z(); };
  EXPECT_EQ(carried(26), 0.0);
  EXPECT_GT(carried(27), 1.0);
  EXPECT_GT(carried(34), 1.0);
  EXPECT_EQ(carried(35), 0.0);
}

/// One knee on the floor, the other foot in front: all forces as statics has them, for ten equal frames.
struct HalfKneeling {
  SimulatedFrames motion{make_character(), 30.0, {}, {}};
  BodyPoses poses;
  List<Push> points;                   ///< of the feet, all of which touch
  SharingConfig config{.reach = 0.3};  ///< m, more than any of their heights
  Vector3d knee_force{60.0, -150.0, 300.0}, knee_point;

  HalfKneeling() {
    motion::ReferenceFrame frame;
    for (int b = 0; b < kBodies; ++b) frame.q[b] = Quaterniond::Identity(), frame.omega[b].setZero();
    frame.v_root.setZero();
    frame.p_root.setZero();
    frame.q[kPelvis] = exp_map(Vector3d(0.5 * std::numbers::pi, 0.0, 0.0));
    frame.q[kRightHip] = exp_map(Vector3d(-0.5 * std::numbers::pi, 0.0, 0.0));
    for (const int knee : {int{kLeftKnee}, int{kRightKnee}})
      frame.q[knee] = exp_map(Vector3d(0.5 * std::numbers::pi * hinge_axis(knee)));
    const Character& c = motion.character;
    frame.p_root.z() = -lowest_contact(c, forward_kinematics(c, frame.p_root, frame.q));
    poses = forward_kinematics(c, frame.p_root, frame.q);
    knee_point = poses.p_WB[kLeftKnee] + poses.q_WB[kLeftKnee] * Vector3d(0.0, -0.08, 0.0);
    rl::tracking::ActingForces acting;
    for (int b = 0; b < kBodies; ++b) {
      acting.joint_torque[b] = acting.range_torque[b] = Vector3d::Zero();
      acting.ground[b] = acting.self_contact[b] = Vector6d::Zero();
    }
    const auto push = [&](int body, const Vector3d& p, const Vector3d& force) {
      acting.ground[body].head<3>() += (p - poses.p_WB[body]).cross(force);
      acting.ground[body].tail<3>() += force;
    };
    push(kLeftKnee, knee_point, knee_force);
    for (int i = 0; i < kFootPoints; ++i) {
      const ContactPoint& point = c.contact_points[i];
      Vector3d p = lowest_position(point, poses);
      p.z() = 0.0;
      points.push_back({point.body, p, Vector3d::Zero()});
      push(point.body, p, i < kPointsPerFoot ? Vector3d(0.0, 1.0, 12.0) : Vector3d(-2.0, 9.0, 55.0));
    }
    for (int joint = 1; joint < kBodies; ++joint) {
      Vector3d torque = moment_without_floor(joint);
      for (int b = joint; b < kBodies; ++b)
        if (beyond(joint, b))
          torque -= acting.ground[b].head<3>() +
                    (poses.p_WB[b] - poses.p_WB[joint]).cross(Vector3d(acting.ground[b].tail<3>()));
      acting.joint_torque[joint] = poses.q_WB[joint].conjugate() * torque;
      if (is_hinge(joint))
        acting.joint_torque[joint] = hinge_axis(joint).dot(acting.joint_torque[joint]) * hinge_axis(joint);
    }
    motion.frames.assign(10, frame);
    motion.forces.assign(10, acting);
  }
  static bool beyond(int joint, int body) {
    while (body > joint) body = kParents[body];
    return body == joint;
  }
  /// What carries the weight of the bodies beyond a joint, N·m.
  Vector3d moment_without_floor(int joint) const {
    const Character& c = motion.character;
    Vector3d moment = Vector3d::Zero();
    for (int b = joint; b < kBodies; ++b)
      if (beyond(joint, b))
        moment += (poses.p_WB[b] + poses.q_WB[b] * c.com_B[b] - poses.p_WB[joint])
                      .cross(Vector3d(0.0, 0.0, kGravity * c.mass[b]));
    return moment;
  }
  /// The sharing of least effort by weights and, if it `kneels`, the force on the shin alone, without
  /// torques.
  FootForces by_statics(bool kneels) const {
    const Character& c = motion.character;
    LegEffort legs{poses, {}, {}};
    for (int joint = 1; joint < kBodies; ++joint) {
      legs.moment[joint] = moment_without_floor(joint);
      if (kneels && (joint == kLeftHip || joint == kLeftKnee))
        legs.moment[joint] -= (knee_point - poses.p_WB[joint]).cross(knee_force);
      legs.bound[joint] = c.joint[joint].torque_limit;
    }
    const Vector3d center = center_of_mass(c, poses);
    Vector6d wanted = Vector6d::Zero();
    for (int i = 0; i < kFootPoints; ++i) {
      const Vector3d force = i < kPointsPerFoot ? Vector3d(0.0, 1.0, 12.0) : Vector3d(-2.0, 9.0, 55.0);
      wanted.head<3>() += (points[i].p - center).cross(force);
      wanted.tail<3>() += force;
    }
    return share_load(wanted, center, points, heading_axes(poses.p_WB), legs, config).least_effort;
  }
};

TEST(LoadSharing, ForceOnAKneeStaysInTheTorquesOfLeastEffort) {
  const HalfKneeling kneeling;
  const FootForces ours = load_sharing(kneeling.motion, kneeling.config)[5].least_effort,
                   expected = kneeling.by_statics(true), without_knee = kneeling.by_statics(false);
  for (int foot = 0; foot < 2; ++foot)
    EXPECT_LT((ours[foot] - expected[foot]).norm(), 2.0) << "N, foot " << foot;
  EXPECT_GT((expected[0] - without_knee[0]).norm(), 10.0)
      << "the knee must count for the test to say anything";
}

TEST(LinearProgram, DependentEquationsAndNothingFeasible) {
  Eigen::MatrixXd A(3, 3);
  A << 1, 1, 1, 2, 2, 2, 1, 0, -1;
  LinearProgram program(A, Eigen::Vector3d(1.0, 2.0, 0.25));
  ASSERT_TRUE(program.feasible());
  // x₁ − x₃ = ¼ and the sum 1: x₂ is largest where x₃ = 0.
  EXPECT_NEAR(program.minimum(Eigen::Vector3d(0, -1, 0))[1], 0.75, 1e-12);
  EXPECT_NEAR(program.minimum(Eigen::Vector3d(0, 1, 0))[1], 0.0, 1e-12);
  LinearProgram impossible(A, Eigen::Vector3d(1.0, 2.5, 0.25));
  EXPECT_FALSE(impossible.feasible());
  EXPECT_THROW(impossible.minimum(Eigen::Vector3d::Ones()), std::logic_error);
  LinearProgram open(Eigen::MatrixXd::Ones(1, 2) - 2.0 * Eigen::MatrixXd::Identity(1, 2),
                     Eigen::VectorXd::Zero(1));
  EXPECT_THROW(open.minimum(Eigen::Vector2d(-1.0, 0.0)), std::logic_error);
}

TEST(LoadSharing, RecordedForcesAreWithinTheRangeOfASimulatedMotion) {
  const Thrown thrown(240.0, 0.0);
  SimulatedFrames motion = thrown.frames();
  const PerFrame<LoadSharing> sharing = load_sharing(motion);
  const double weight = kGravity * thrown.reference.character.total_mass();
  int loaded = 0;
  for (int t = 40; t < sharing.count(); ++t) {
    const rl::tracking::ActingForces& acting = motion.forces[static_cast<std::size_t>(t)];
    const Matrix3d axes = heading_axes(thrown.rollout.poses[static_cast<std::size_t>(t)].p_WB);
    const Vector3d left =
        axes.transpose() * Vector3d(acting.ground[kLeftAnkle].tail<3>() + acting.ground[kLeftFoot].tail<3>());
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(left[axis], sharing[t].least[0][axis] - 0.02 * weight) << t << ' ' << axis;
      EXPECT_LE(left[axis], sharing[t].most[0][axis] + 0.02 * weight) << t << ' ' << axis;
      EXPECT_GE(sharing[t].least_effort[0][axis], sharing[t].least[0][axis] - 0.02 * weight);
      EXPECT_LE(sharing[t].least_effort[0][axis], sharing[t].most[0][axis] + 0.02 * weight);
      // Both feet together are the recorded load.
      EXPECT_NEAR(sharing[t].least[0].z() + sharing[t].most[1].z(),
                  sharing[t].most[0].z() + sharing[t].least[1].z(), 1e-6 * weight);
    }
    loaded += sharing[t].most[0].z() > 0.5 * weight;
  }
  EXPECT_GT(loaded, 5) << "the feet must stand for the test to say anything";
  Npz npz;
  for (const auto& [name, array] : sharing_members(sharing)) npz.set(name, array);
  const PerFrame<LoadSharing> read = read_sharing(npz, sharing.size());
  EXPECT_EQ(read[50].least, sharing[50].least);
  EXPECT_EQ(read[50].most, sharing[50].most);
  EXPECT_EQ(read[50].least_effort, sharing[50].least_effort);
  EXPECT_THROW(read_sharing(npz, sharing.size() + 1), DataError);
  motion.forces.pop_back();
  EXPECT_THROW(load_sharing(motion), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::audit

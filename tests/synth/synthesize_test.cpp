#include "synth/synthesize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "motion/metrics.h"
#include "motion/segment_distance.h"
#include "synth/kinds.h"
#include "synth/synth_motions.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

using namespace test;

/// Force on the body and its moment about the world's origin at frame t, from accelerations of every body.
struct Wrench {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
};
Wrench required_wrench(const test::Motion& m, std::size_t t) {
  Wrench wrench;
  for (std::size_t b = 0; b < kBodies; ++b) {
    const Vector3d p = m.mass_center(t, b);
    const Vector3d a =
        (m.mass_center(t + 1, b) - 2.0 * p + m.mass_center(t - 1, b)) / (test::kDt * test::kDt);
    const Vector3d f = m.character.mass[b] * (a + test::kG * Vector3d::UnitZ());
    const auto spin = [&](std::size_t i, std::size_t j) {  // angular momentum about the body's own centre
      const Quaterniond &q_i = m.poses[i].q_WB[b], &q_j = m.poses[j].q_WB[b];
      const Vector3d omega_B = log_map(q_i.conjugate() * q_j) / test::kDt;
      return Vector3d(q_i.slerp(0.5, q_j) * (m.character.inertia_B[b] * omega_B));
    };
    wrench.force += f;
    wrench.moment += p.cross(f) + (spin(t, t + 1) - spin(t - 1, t)) / test::kDt;
  }
  return wrench;
}

/// Distance of p outside the convex hull of the points, 0 inside: the largest gap over all directions.
double outside(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& points) {
  double gap = 0.0;
  for (int k = 0; k < 720; ++k) {
    const Eigen::Vector2d direction(std::cos(k * M_PI / 360.0), std::sin(k * M_PI / 360.0));
    double farthest = -1e9;
    for (const Eigen::Vector2d& point : points) farthest = std::max(farthest, direction.dot(point));
    gap = std::max(gap, direction.dot(p) - farthest);
  }
  return gap;
}

/// How far the centre of pressure a frame needs lies outside the points that touch the floor, m.
double pressure_outside(const test::Motion& m, std::size_t t, const Wrench& wrench) {
  const Eigen::Vector2d pressure(-wrench.moment.y() / wrench.force.z(), wrench.moment.x() / wrench.force.z());
  std::vector<Eigen::Vector2d> support;
  for (const Vector3d& point : m.sole[t])
    if (point.z() < 0.004) support.emplace_back(point.x(), point.y());
  return outside(pressure, support);
}

TEST(Synthesize, TurnsKneesAndElbowsAboutTheirHingesOnly) {
  test::for_all([](const test::Motion& m) {
    for (const auto& rotations : m.clip.rotations)
      for (int body : {kLeftKnee, kRightKnee, kLeftElbow, kRightElbow}) {
        const Vector3d& r = rotations[body];
        const double flexion = r.dot(hinge_axis(body));
        ASSERT_LT((r - flexion * hinge_axis(body)).norm(), 1e-15);
        ASSERT_GT(flexion, 0.08);  // never straight, where the leg would be singular
      }
  });
}

TEST(Synthesize, LetsPlantedFeetNeitherSlideNorSink) {
  test::for_all([](const test::Motion& m) {
    for (std::size_t t = 0; t < m.frames(); ++t)
      for (std::size_t i = 0; i < 12; ++i) {
        ASSERT_GT(m.sole[t][i].z(), -0.0001);
        if (t == 0 || m.sole[t][i].z() > 0.0005 || m.sole[t - 1][i].z() > 0.0005) continue;
        ASSERT_LT((m.sole[t][i] - m.sole[t - 1][i]).norm(), 0.0005);
      }
  });
}

TEST(Synthesize, KeepsTheBodyClearOfItself) {
  test::for_all([](const test::Motion& m) {
    for (std::size_t t = 0; t < m.frames(); ++t)
      for (const auto& [i, j] : m.character.self_pairs) {
        const auto ends = [&](int body) {
          const Capsule& capsule = m.character.capsule[body];
          const Vector3d& p = m.poses[t].p_WB[body];
          const Quaterniond& q = m.poses[t].q_WB[body];
          return std::array<Vector3d, 2>{p + q * capsule.a_B, p + q * capsule.b_B};
        };
        const auto a = ends(i), b = ends(j);
        const double radii = m.character.capsule[i].radius + m.character.capsule[j].radius;
        ASSERT_GT(motion::segment_distance(a[0], a[1], b[0], b[1]), radii + 0.005)
            << kBodyNames[i] << " and " << kBodyNames[j];
      }
  });
}

TEST(Synthesize, StaysWithinTheRangesOfTheJoints) {
  test::for_all([](const test::Motion& m) {
    for (const auto& rotations : m.clip.rotations)
      for (int body = 1; body < kBodies; ++body) {
        const JointParameters& joint = m.character.joint[body];
        if (is_hinge(body)) {
          const double flexion = rotations[body].dot(hinge_axis(body));
          ASSERT_LT(std::abs(flexion - joint.centre.x()), joint.half_range.x());
        } else {
          const Vector3d off = log_map(exp_map(joint.centre).conjugate() * exp_map(rotations[body]));
          ASSERT_LT(off.cwiseQuotient(joint.half_range).norm(), 1.0) << kBodyNames[body];
        }
      }
  });
}

bool stands_in_place(const std::string& kind) {
  return kind == "stand" || kind == "squat" || kind == "wave" || kind == "bow" || kind == "punch";
}

TEST(Synthesize, NeedsNoPullFromTheFloorAndACentreOfPressureUnderTheFeet) {
  test::for_all([](const test::Motion& m) {
    const double weight = m.character.total_mass() * test::kG;
    const double tolerance = stands_in_place(m.kind) ? 0.0 : 0.03;  // ℓ is a fixed point not quite reached
    for (std::size_t t = 1; t + 1 < m.frames(); ++t) {
      const Wrench wrench = required_wrench(m, t);
      ASSERT_GT(wrench.force.z(), -1e-3 * weight);
      ASSERT_LT(wrench.force.z(), 3.0 * weight);
      if (wrench.force.z() < 0.3 * weight) continue;  // nearly in flight: the quotient is ill-conditioned
      ASSERT_LE(pressure_outside(m, t, wrench), tolerance) << "frame " << t;
      const double friction = wrench.force.head<2>().norm() / wrench.force.z();
      ASSERT_LT(friction, 0.6) << "frame " << t;
    }
  });
}

TEST(Flights, NoMomentActsOnABodyInFlight) {
  for (const char* kind : {"jump", "jog"})
    for (const test::Motion& m : test::motions(kind)) {
      const double weight = m.character.total_mass() * test::kG;
      for (std::size_t t = 1; t + 1 < m.frames(); ++t) {
        if (m.lowest(t) < 0.001) continue;
        const Wrench wrench = required_wrench(m, t);
        const Vector3d moment = wrench.moment - m.com(t).cross(wrench.force);
        EXPECT_LT(moment.norm(), 0.03 * weight) << m.clip.name << ", frame " << t;
      }
    }
}

/// The tests' own inverse dynamics against the plan the motion was solved from.
TEST(SolvePlan, PutsTheCentreOfPressureWhereThePlanHasIt) {
  const std::map<std::string, double> tolerances = {
      {"stand", 1e-4},
      {"wave", 1e-3},
      {"squat", 2e-3},
      {"walk", 0.015}};  // m; ℓ is a fixed point not quite reached
  for (const SynthKind& kind : synth_kinds()) {
    if (!tolerances.contains(kind.name)) continue;  // a jump has no centre of pressure in flight
    Random random(9);
    test::Motion m;
    m.character = make_character();
    const PerFrame<PlanFrame> plan = kind.plan({m.character, random, 150});
    for (const SynthPose& pose : solve_plan(m.character, plan, kSynthFps)) m.add(pose.p_root, pose.q);
    for (std::size_t t = 1; t + 1 < m.frames(); ++t) {
      const Wrench wrench = required_wrench(m, t);
      const Eigen::Vector2d pressure =
          Eigen::Vector2d(-wrench.moment.y(), wrench.moment.x()) / wrench.force.z();
      ASSERT_LT((pressure - plan[t].pressure).norm(), tolerances.at(kind.name))
          << kind.name << ", frame " << t;
    }
  }
}

TEST(Synthesize, AcceleratesSmoothly) {
  test::for_all([](const test::Motion& m) {
    const double bound = m.kind == "jump" || m.kind == "jumps" ? 150.0 : 90.0;  // m/s²: feet leave and land
    for (std::size_t t = 1; t + 1 < m.frames(); ++t)
      for (int body = 0; body < kBodies; ++body) {
        const Vector3d a =
            (m.joint(t + 1, body) - 2.0 * m.joint(t, body) + m.joint(t - 1, body)) / (test::kDt * test::kDt);
        ASSERT_LT(a.norm(), bound) << kBodyNames[body] << ", frame " << t;
      }
  });
}

TEST(Synthesize, TurnsNoJointFasterThanAPersonCan) {
  test::for_all([](const test::Motion& m) {
    for (std::size_t t = 1; t < m.frames(); ++t)
      for (std::size_t b = 1; b < kBodies; ++b) {
        const auto at = [&](std::size_t i) { return exp_map(m.clip.rotations[i][b]); };
        ASSERT_LT(log_map(at(t - 1).conjugate() * at(t)).norm() / test::kDt, 15.0)
            << kBodyNames[b] << ", frame " << t;
      }
  });
}

/// Grazing feet are what a simulated character stumbles over; long stands on one leg are what it falls from.
TEST(Synthesize, LiftsEveryFootClearAndStandsOnOneLegForAMomentOnly) {
  test::for_all([](const test::Motion& m) {
    std::array<double, 2> highest{};
    int alone = 0;
    for (std::size_t t = 0; t < m.frames(); ++t) {
      int standing = 0;
      for (std::size_t side = 0; side < 2; ++side) {
        double low = 1e9;
        for (std::size_t i = 0; i < 6; ++i) low = std::min(low, m.sole[t][6 * side + i].z());
        if (low > 1e-4) {
          highest[side] = std::max(highest[side], low);
          continue;
        }
        ++standing;
        ASSERT_TRUE(highest[side] == 0.0 || highest[side] > 0.04) << "frame " << t;
        highest[side] = 0.0;
      }
      alone = standing == 1 ? alone + 1 : 0;
      ASSERT_LE(alone, m.kind == "balance" || m.kind == "free" ? 110 : 45) << "frame " << t;
    }
  });
}

TEST(Synthesize, BeginsAndEndsStandingStill) {
  test::for_all([](const test::Motion& m) {
    const std::size_t last = m.frames() - 1;
    for (std::size_t t : {std::size_t{0}, last - 1})
      for (int body = 0; body < kBodies; ++body)
        ASSERT_LT((m.joint(t + 1, body) - m.joint(t, body)).norm() / test::kDt, 0.10);
    for (std::size_t t : {std::size_t{0}, last}) {
      for (const Vector3d& point : m.sole[t]) ASSERT_LT(std::abs(point.z()), 1e-6);
      ASSERT_GT(m.joint(t, kHead).z(), 1.55 * m.joint(t, kPelvis).z());
    }
  });
}

TEST(Synthesize, IsByteIdenticalForEqualOptionsOnly) {
  for (const std::string& kind : synthetic_kinds()) {
    SynthConfig config;
    config.kind = kind;
    config.seed = 1;
    const motion::Clip again = synthesize(config);
    const motion::Clip &same = test::motions(kind)[1].clip, &other = test::motions(kind)[2].clip;
    EXPECT_TRUE(same.rotations == again.rotations && same.trans == again.trans);
    EXPECT_GT((same.rotations[30][kPelvis] - other.rotations[30][kPelvis]).norm(), 1e-3);
  }
}

TEST(Synthesize, UsesTheGivenShapeAndDrawsOneOnlyWhenAsked) {
  SynthConfig config;
  config.betas[2] = 1.5;
  EXPECT_EQ(synthesize(config).betas, config.betas);
  config.betas_from_seed = true;
  EXPECT_NE(synthesize(config).betas, config.betas);
  EXPECT_EQ(synthesize(config).betas, synthesize(config).betas);
}

TEST(Synthesize, MakesMotionsOfTheRequestedLength) {
  for (const std::string& kind : synthetic_kinds())
    for (double seconds : {4.0, 5.5}) {
      SynthConfig config;
      config.kind = kind;
      config.seconds = seconds;
      EXPECT_EQ(synthesize(config).frames(), static_cast<int>(30 * seconds) + 1) << kind;
    }
}

TEST(Synthesize, HandlesExtremeShapes) {
  Random random(3);
  for (const std::string& kind : synthetic_kinds())
    for (int trial = 0; trial < 2; ++trial) {
      SynthConfig config;
      config.kind = kind;
      config.seconds = 4.0;
      for (double& beta : config.betas) beta = random.uniform(-3.0, 3.0);
      const test::Motion m = test::make_motion(config);
      for (std::size_t t = 0; t < m.frames(); ++t) ASSERT_GT(m.lowest(t), -0.0005) << kind;
    }
}

TEST(Synthesize, RejectsUnknownKindsAndLengths) {
  SynthConfig config;
  config.kind = "fly";
  EXPECT_THROW(synthesize(config), std::invalid_argument);
  config.kind = "walk";
  for (double seconds : {-1.0, 2.0, 61.0, std::nan("")}) {
    config.seconds = seconds;
    EXPECT_THROW(synthesize(config), std::invalid_argument);
  }
}

}  // namespace
}  // namespace mimicx::synth

#include "judge/worsening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/units.h"
#include "judge/reference_needs.h"
#include "judge/scores.h"
#include "motion/surface_points.h"

namespace mimicx::judge {
namespace {

constexpr int kLength = 40;
using Way = std::function<Vector3d(int)>;

/// A stiff body that stands on the floor and is moved along a way.
motion::Reference moved(const Way& way) {
  motion::Reference reference;
  reference.character = make_character();
  motion::ReferenceFrame frame;
  frame.q.fill(Quaterniond::Identity());
  frame.q[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.0));
  frame.omega.fill(Vector3d::Zero());
  const BodyPoses hung = forward_kinematics(reference.character, Vector3d::Zero(), frame.q);
  const double floor = motion::lowest_height(motion::surface_points(reference.character), hung);
  for (int t = 0; t < kLength; ++t) {
    frame.p_root = Vector3d(0.0, 0.0, -floor) + way(t);
    reference.frames.push_back(frame);
    reference.poses.push_back(forward_kinematics(reference.character, frame.p_root, frame.q));
  }
  return reference;
}

motion::Clip clip_of(const motion::Reference& reference) {
  PerFrame<Vector3d> p_root;
  PerFrame<PerBody<Quaterniond>> q;
  for (const motion::ReferenceFrame& frame : reference.frames) {
    p_root.push_back(frame.p_root);
    q.push_back(frame.q);
  }
  return motion::to_clip("moved", reference.fps, reference.character, p_root, q);
}

/// The motion as if it had been simulated, both ankles loaded by half of the weight.
rl::tracking::TrackingRollout simulated(const motion::Reference& motion) {
  rl::tracking::TrackingRollout rollout;
  for (int t = 0; t < motion.size(); ++t) {
    rl::tracking::Pose pose;
    pose.frame = motion.frames[t];
    pose.p_WB = motion.poses[t].p_WB;
    rollout.poses.push_back(pose);
    rl::tracking::ActingForces forces{};
    for (auto& wrench : forces.ground) wrench.setZero();
    for (const int foot : {kLeftAnkle, kRightAnkle})
      forces.ground[foot][5] = 0.5 * kGravity * motion.character.total_mass();
    rollout.forces.push_back(forces);
  }
  return rollout;
}

std::vector<record::Worsening> worse(const Way& input, const Way& reference, const Way& result) {
  const motion::Reference asked = moved(reference);
  const motion::Clip clip = clip_of(moved(input));
  const rl::tracking::TrackingRollout made = simulated(moved(result));
  const audit::PoseNeeds needs = needs_of(asked);
  const InputScores before = score_input(clip, asked, kGravity);
  return worsenings({clip, asked, needs, before}, made, score_simulated(asked, made).values);
}

const record::Worsening* find(const std::vector<record::Worsening>& all, const std::string& measure) {
  for (const record::Worsening& one : all)
    if (one.measure == measure) return &one;
  return nullptr;
}

Vector3d still(int) { return Vector3d::Zero(); }
/// Glides by 6 mm in a frame from frame 20 to frame 24.
Vector3d glides(int t) { return {0.006 * std::clamp(t - 20, 0, 4), 0.0, 0.0}; }

TEST(Worsening, EqualMotionsHaveNone) { EXPECT_TRUE(worse(still, still, still).empty()); }

TEST(Worsening, BetterMotionsHaveNone) { EXPECT_TRUE(worse(glides, still, still).empty()); }

TEST(Worsening, SlidingIsFoundInItsFrames) {
  const auto all = worse(still, still, glides);
  const record::Worsening* sliding = find(all, "sliding");
  ASSERT_TRUE(sliding);
  ASSERT_EQ(sliding->frames.size(), 1u);
  EXPECT_EQ(sliding->frames[0], (std::array{21, 24}));
  EXPECT_EQ(sliding->why, "its reference does not");
  EXPECT_EQ(sliding->numbers, "0.0 -> 0.6 mm a frame");
  ASSERT_TRUE(find(all, "moving of standing feet"));
}

TEST(Worsening, ReferenceThatSlidesIsTheCause) {
  const auto all = worse(still, glides, glides);
  ASSERT_TRUE(find(all, "sliding"));
  EXPECT_EQ(find(all, "sliding")->why, "its reference slides, too");
}

TEST(Worsening, ReferenceThatFliesWhileTheResultIsLoadedIsNamed) {
  // It hops as a body falls, and moves on while it is in the air: feasible, and nothing of it slides.
  const auto hop = [](int t) {
    const double s = std::clamp((t - 20) / 30.0, 0.0, 4.0 / 30.0);
    return Vector3d(0.5 * s, 0.0, 0.5 * kGravity * s * (4.0 / 30.0 - s));
  };
  const auto all = worse(still, hop, [&](int t) { return Vector3d(hop(t).x(), 0.0, 0.0); });
  ASSERT_TRUE(find(all, "sliding"));
  EXPECT_NE(find(all, "sliding")->why, "its reference does not");
}

TEST(Worsening, InputThatHangsCannotSink) {
  const auto all = worse([](int) { return Vector3d(0.0, 0.0, 0.1); }, still,
                         [](int t) { return Vector3d(0.0, 0.0, t < 10 ? 0.0 : -0.001); });
  const record::Worsening* sinking = find(all, "sinking");
  ASSERT_TRUE(sinking);
  EXPECT_EQ(sinking->why, "the input hangs over the floor");
  EXPECT_EQ(find(worse(still, still, [](int) { return Vector3d(0.0, 0.0, -0.001); }), "sinking")->why,
            "the simulated floor gives way under load");
  const auto deep = worse([](int) { return Vector3d(0.0, 0.0, 0.1); }, still,
                          [](int t) { return Vector3d(0.0, 0.0, t < 10 ? 0.0 : -0.02); });
  EXPECT_EQ(find(deep, "sinking")->why, "limbs reach below it between the points that it carries")
      << "who hangs does not explain two centimetres";
}

TEST(Worsening, InfeasibleReferenceIsNamed) {
  const auto hangs = [](int) { return Vector3d(0.0, 0.0, 0.1); };
  const auto all = worse(still, hangs, [](int t) { return Vector3d(0.0, 0.0, t == 20 ? 0.02 : 0.0); });
  const record::Worsening* jitter = find(all, "jitter");
  ASSERT_TRUE(jitter);
  EXPECT_TRUE(jitter->why.starts_with("its reference is not feasible: frames 0-39: the body hovers"))
      << jitter->why;
}

TEST(Worsening, OtherLengthsAreNotCompared) {
  const motion::Reference asked = moved(still);
  motion::Clip clip = clip_of(asked);
  clip.rotations.resize(kLength - 5);
  clip.trans.resize(kLength - 5);
  const rl::tracking::TrackingRollout made = simulated(moved(glides));
  const InputScores before = score_input(clip, asked, kGravity);
  EXPECT_TRUE(
      worsenings({clip, asked, needs_of(asked), before}, made, score_simulated(asked, made).values).empty());
}

}  // namespace
}  // namespace mimicx::judge

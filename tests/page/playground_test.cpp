#include "page/playground.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "motion/standing_clip.h"
#include "page/played_frame_json.h"
#include "page/session.h"
#include "physics/lanes.h"
#include "program/small_run.h"
#include "record/json.h"

namespace mimicx::page {
namespace {

/// A second and a half of swaying, planned once for all tests.
struct Planned {
  Planned() {
    const std::filesystem::path file = folder.path / "stand.npz";
    motion::write_clip(file, motion::standing_clip(45));
    program::run_in_context([&](const record::RunContext& context) {
      session.plan(file, context);
      return record::RunOutcome::kAllGood;
    });
    plan = files::read_plan(folder.path / "session/0/plans/stand.npz");
  }
  TemporaryFolder folder;
  Session session{folder.path / "session"};
  files::StoredPlan plan;
};

struct PagePlayground : testing::Test {
  static void SetUpTestSuite() { planned = std::make_unique<Planned>(); }
  static void TearDownTestSuite() { planned.reset(); }

  /// Goes on to the last frame. @return the largest distance
  static double play_on(Playground& play) {
    double worst = 0.0;
    while (play.now().frame + 1 < play.frames()) worst = std::max(worst, play.step().distance);
    return worst;
  }
  /// The states are those of the plan, bit for bit.
  static void expect_the_plan(Playground& play) {
    play.restart();
    for (int t = 1; t < play.frames(); ++t) {
      const PlayedFrame& now = play.step();
      ASSERT_EQ(now.frame, t);
      const physics::State<double>& x = planned->plan.plan.states[t];
      ASSERT_TRUE(now.state.p_root == physics::to_eigen(x.p_root)) << t;
      ASSERT_TRUE(now.state.v_root == physics::to_eigen(x.v_root)) << t;
      for (int i = 0; i < kBodies; ++i) ASSERT_TRUE(now.state.omega[i] == physics::to_eigen(x.omega[i])) << t;
    }
  }

  static std::unique_ptr<Planned> planned;
  Playground play = planned->session.play(0);
};
std::unique_ptr<Planned> PagePlayground::planned;

TEST_F(PagePlayground, UndisturbedStatesAreThePlan) { expect_the_plan(play); }

TEST_F(PagePlayground, WithoutFeedbackStatesAreThePlan) {
  play.set_controller(Controller::kPlan);
  expect_the_plan(play);
}

TEST_F(PagePlayground, RestartsAfterTheLastFrame) {
  play_on(play);
  EXPECT_EQ(play.step().frame, 0);
  EXPECT_EQ(play.now().distance, 0.0);
}

TEST_F(PagePlayground, RecoversFromAPushThatTheAuditReports) {
  for (int t = 0; t < 10; ++t) EXPECT_LT(play.step().unexplained.tail<3>().norm(), 1.0);
  play.push({0.1, 0.0, 0.0});
  const PlayedFrame pushed = play.step();
  const double impulse = play.character().mass[kPelvis] * 0.1 * play.fps();  // of the pelvis alone, at least
  EXPECT_GT(pushed.unexplained.tail<3>().norm(), 0.5 * impulse);
  EXPECT_LT(play.step().unexplained.tail<3>().norm(), 1.0);
  EXPECT_LT(play_on(play), 0.2);
}

TEST_F(PagePlayground, FallsWithoutMotors) {
  play.set_controller(Controller::kNone);
  EXPECT_GT(play_on(play), 0.5);
  EXPECT_LT(play.now().state.p_root.z(), 0.6);
}

TEST_F(PagePlayground, FrictionTakesEffectAtTheNextStep) {
  for (int t = 0; t < 5; ++t) play.step();
  const PlayedFrame before = play.now();
  play.set_friction(0.0);
  EXPECT_TRUE(play.now().state.p_root == before.state.p_root);
  EXPECT_EQ(play.now().frame, 5);
  play.push({0.5, 0.0, 0.0});
  for (int t = 0; t < 5; ++t) {
    const PlayedFrame& now = play.step();
    for (const Vector6d& wrench : now.forces.ground) EXPECT_EQ(wrench.segment<2>(3).norm(), 0.0);
  }
  EXPECT_THROW(play.set_friction(-1.0), std::invalid_argument);
}

TEST_F(PagePlayground, AnotherBodyKeepsItsHeightOverTheFloor) {
  const double height = lowest_contact(play.character(), play.now().poses),
               mass = play.character().total_mass();
  std::array<double, kBetas> betas{};
  betas[0] = 2.0;
  play.set_shape(betas);
  EXPECT_NE(play.character().total_mass(), mass);
  EXPECT_NEAR(lowest_contact(play.character(), play.now().poses), height, 1e-6);
  play.step();
  betas[0] = 99.0;
  EXPECT_THROW(play.set_shape(betas), std::invalid_argument);
  play.set_own_shape();
  expect_the_plan(play);
}

TEST_F(PagePlayground, JsonIsAClipOfOneFrame) {
  play.step();
  auto said = record::Json::parse(played_json(play, "7f"));
  EXPECT_EQ(said["frame"], 1);
  EXPECT_EQ(said["frames"], 45);
  const auto& motions = said["clip"]["motions"].elements();
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].at("frames"), 1);
  EXPECT_EQ(motions[0].at("body").get<std::string>(), "7f");
  EXPECT_NEAR(said["floor_N"].get<double>(), kGravity * play.character().total_mass(),
              0.3 * kGravity * play.character().total_mass());
}

}  // namespace
}  // namespace mimicx::page

// The line that says why a plan failed names self contact where that holds the body.
#include "plan/plan_failure.h"

#include <gtest/gtest.h>

namespace mimicx::plan {
namespace {

constexpr int kLost = 50;

/// Needs of a feasible reference of 90 frames.
audit::PoseNeeds nothing_needed() {
  audit::PoseNeeds needs;
  needs.fps = 30.0;
  needs.mass = 70.0;
  needs.frames.resize(90);
  return needs;
}

/// Right hand and head push each other in the last frames before the loss.
std::vector<rl::tracking::ActingForces> forces_of_self_contact(double force, int frames) {
  std::vector<rl::tracking::ActingForces> forces(kLost);
  for (int t = 0; t < kLost; ++t) {
    auto& now = forces[static_cast<std::size_t>(t)];
    now.self_contact.fill(Vector6d::Zero());
    if (t < kLost - frames) continue;
    now.self_contact[kRightWrist][3] = force;
    now.self_contact[kHead][3] = -0.9 * force;  // another body takes the rest
    now.self_contact[kSpine3][3] = -0.1 * force;
  }
  return forces;
}

std::string words(double force, int frames) {
  return failure_in_words({kLost, kHead, 0.6}, nothing_needed(), {}, forces_of_self_contact(force, frames));
}

TEST(PlanFailure, NamesTheSelfContactThatHoldsTheBody) {
  const std::string text = words(320.0, 12);
  EXPECT_NE(text.find("the plan fails at frame 50 (1.67 s): the head is 0.60 m"), std::string::npos) << text;
  EXPECT_NE(text.find("right wrist and head push each other with up to 320 N"), std::string::npos) << text;
  EXPECT_EQ(text.find("a body could follow it"), std::string::npos) << text;
}

TEST(PlanFailure, SaysThatABodyCouldFollowItWhereNothingHoldsIt) {
  for (const std::string& text : {words(320.0, 2), words(50.0, 40), words(0.0, 0)}) {
    EXPECT_EQ(text.find("self contact"), std::string::npos) << text;
    EXPECT_NE(text.find("a body could follow it"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace mimicx::plan

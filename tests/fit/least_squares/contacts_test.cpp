#include "fit/least_squares/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mimicx::fit {
namespace {

TEST(FitContacts, PlantedFootStandsAndSwingingFootDoesNot) {
  PerFrame<FootPositions> feet(30);
  for (std::size_t t = 0; t < feet.size(); ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i)
      feet[t][i] =
          i < kPointsPerFoot ? Vector3d(0, 0, 0.005) : Vector3d(0.05 * static_cast<double>(t), 0, 0.005);
  for (bool settled : {true, false}) {
    const Contacts contacts = find_contacts(feet, 30.0, {}, settled);
    for (const auto& frame : contacts)
      for (std::size_t i = 0; i < kFootPoints; ++i) EXPECT_EQ(frame[i], i < kPointsPerFoot);
  }
  for (FootPositions& frame : feet)
    for (Vector3d& p : frame) p.z() += 0.2;  // an estimate that floats
  EXPECT_FALSE(find_contacts(feet, 30.0, {}, true)[10][0]);
  EXPECT_TRUE(find_contacts(feet, 30.0, {}, false)[10][0]);
}

// Within a step it is 6 cm farther, too fast for a foot that stands by the frames around it.
TEST(FitContacts, FootThatAloneCarriesTheBodyStandsThroughAJump) {
  PerFrame<FootPositions> feet(30);
  for (int t = 0; t < 30; ++t)
    for (int i = 0; i < kFootPoints; ++i)
      feet[t][i] = i < kPointsPerFoot ? Vector3d(t < 15 ? 0.0 : 0.06, 0, 0.005) : Vector3d(0.05 * t, 0, 0.3);
  for (const auto& frame : find_contacts(feet, 30.0, {}, true))
    for (int i = 0; i < kFootPoints; ++i) EXPECT_EQ(frame[i], i < kPointsPerFoot);
}

/// Estimates have toes some centimetres inside the next step. Once they are in its reach, they would be
/// pulled onto it, and the foot would be bent.
TEST(FitContacts, ToesInTheSideOfTheNextStepStandWithTheirFoot) {
  Scene steps;
  steps.plates.push_back({{0.0, 0.0}, 0.0, {0.15, 0.5}, 0.10});
  steps.plates.push_back({{0.3, 0.0}, 0.0, {0.15, 0.5}, 0.17});
  PerFrame<FootPositions> feet(10);
  for (FootPositions& frame : feet)
    for (int i = 0; i < kFootPoints; ++i)  // heel, ball, toe of both feet, the toes 5 cm in the second step
      frame[i] = Vector3d(-0.06 + 0.13 * (i % 6 / 2), i < 6 ? 0.1 : -0.1, 0.10);
  ASSERT_LT(steps.clearance(feet[5][4]), -0.06) << "alone, it is in the second step";
  for (int i = 0; i < kFootPoints; ++i)
    EXPECT_NEAR(steps.clearance(feet[5][i], sole_middle(feet[5], i)), 0.0, 1e-12);
  for (FootPositions& frame : feet)  // 5 cm over their step, 2 cm under the next one
    for (Vector3d& p : frame) p.z() += 0.05;
  const Contacts hanging = find_contacts(feet, 30.0, steps, true);
  EXPECT_EQ(std::count(hanging[5].begin(), hanging[5].end(), true), 0);
}

}  // namespace
}  // namespace mimicx::fit

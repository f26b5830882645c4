#include "import/evidence/length_unit.h"

#include <gtest/gtest.h>

namespace mimicx::import {
namespace {

UnitDecision decide(double leg, double trunk_to_leg = 0.64, std::optional<double> fall_leg = {},
                    std::vector<std::string> names = {}) {
  return decide_unit({leg, trunk_to_leg * leg, fall_leg, {}, std::move(names)});
}

TEST(LengthUnit, AdultsTellTheirUnitByTheirLegs) {
  for (const auto& [leg, unit] : {std::pair{0.8, "metres"},
                                  {82.0, "centimetres"},
                                  {790.0, "millimetres"},
                                  {31.0, "inches"},
                                  {14.8, "inches / 0.45"},
                                  {8.19, "decimetres"},
                                  {2.6, "feet"}}) {
    const UnitDecision found = decide(leg);
    EXPECT_EQ(found.name, unit) << leg;
    EXPECT_TRUE(found.fits && found.usual && !found.is_near()) << leg << ' ' << found.lead;
  }
}

TEST(LengthUnit, ChildrenHaveLongTrunksForTheirLegs) {
  const UnitDecision child = decide(33.0, 0.9);
  EXPECT_EQ(child.name, "centimetres");
  EXPECT_TRUE(child.usual);
  EXPECT_EQ(decide(33.0, 0.62).name, "inches") << "legs of 84 cm";
}

TEST(LengthUnit, LegsOf40UnitsAreCentimetres) {
  const UnitDecision small = decide(40.6);
  EXPECT_EQ(small.name, "centimetres");
  EXPECT_TRUE(small.fits);
  EXPECT_FALSE(small.usual);
}

TEST(LengthUnit, ASmallPersonInAnotherUnitIsNamed) {
  const UnitDecision found = decide(9.754);
  EXPECT_EQ(found.name, "decimetres");
  EXPECT_EQ(found.second, "inches / 0.45");
  EXPECT_TRUE(found.is_near()) << found.lead;
}

TEST(LengthUnit, QuickStepsTellShortLegs) {
  // A child with legs of 0.41 m takes 2.5 steps a second; an adult would not with legs of 0.90 m.
  const UnitEvidence child{16.0, 0.68 * 16.0, {}, 0.41, {}};
  EXPECT_EQ(decide_unit(child).name, "inches");
  UnitEvidence still = child;
  still.walk_leg.reset();
  EXPECT_EQ(decide_unit(still).name, "inches / 0.45");
  // Slow steps tell nothing: anybody may walk slowly.
  UnitEvidence slow = child;
  slow.walk_leg = 3.0;
  EXPECT_EQ(decide_unit(slow).lead, decide_unit(still).lead);
}

TEST(LengthUnit, NoUnitFitsLegsOfThreeAndAHalfUnits) {
  EXPECT_FALSE(decide(1e9).fits);
  EXPECT_FALSE(decide(164.5).fits) << "a giant";
}

TEST(LengthUnit, FallsAndNamesDecideWhereTheLengthDoesNot) {
  EXPECT_EQ(decide(20.0).name, "inches");
  EXPECT_EQ(decide(20.0, 0.64, 1.13).name, "inches / 0.45");
  EXPECT_EQ(decide(10.0).name, "decimetres");
  EXPECT_GT(decide(10.0).lead, decide(10.0, 0.64, {}, {"LHipJoint"}).lead);
}

}  // namespace
}  // namespace mimicx::import

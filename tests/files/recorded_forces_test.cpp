#include "files/recorded_forces.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

TEST(RecordedForces, MissingMemberIsAnErrorAndNoMembersIsEmpty) {
  EXPECT_FALSE(recorded_forces(turning_clip(4)).has_value());
  for (const std::size_t gone : {0u, 1u}) {
    motion::Clip clip = pushed_clip(4);
    clip.passthrough.erase(clip.passthrough.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_THROW(recorded_forces(clip), DataError);
  }
  motion::Clip clip = pushed_clip(4);
  clip.rotations.resize(3);
  clip.trans.resize(3);
  EXPECT_THROW(recorded_forces(clip), DataError) << "forces of another number of frames";
}

TEST(RecordedForces, GravityIsThatOfTheSimulation) {
  motion::Clip clip = pushed_clip(4);
  EXPECT_EQ(recorded_gravity(clip), kGravity);
  const double mass = motion::character_of(clip).total_mass();
  clip.passthrough.emplace_back("body_weight", NpyArray::scalar(kGravity * mass));
  EXPECT_EQ(recorded_gravity(clip), kGravity);
  clip.passthrough.back().second = NpyArray::scalar(5.0 * mass);
  EXPECT_NEAR(recorded_gravity(clip), 5.0, 1e-12);
}

}  // namespace
}  // namespace mimicx::files

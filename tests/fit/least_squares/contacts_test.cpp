#include "fit/least_squares/contacts.h"

#include <gtest/gtest.h>

namespace mimicx::fit {
namespace {

TEST(FitContacts, PlantedFootStandsAndSwingingFootDoesNot) {
  PerFrame<FootPositions> feet(30);
  for (std::size_t t = 0; t < feet.size(); ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i)
      feet[t][i] =
          i < kFootPoints / 2 ? Vector3d(0, 0, 0.005) : Vector3d(0.05 * static_cast<double>(t), 0, 0.005);
  for (bool settled : {true, false}) {
    const Contacts contacts = find_contacts(feet, 30.0, {}, settled);
    for (const auto& frame : contacts)
      for (std::size_t i = 0; i < kFootPoints; ++i) EXPECT_EQ(frame[i], i < kFootPoints / 2);
  }
  for (FootPositions& frame : feet)
    for (Vector3d& p : frame) p.z() += 0.2;  // an estimate that floats
  EXPECT_FALSE(find_contacts(feet, 30.0, {}, true)[10][0]);
  EXPECT_TRUE(find_contacts(feet, 30.0, {}, false)[10][0]);
}

}  // namespace
}  // namespace mimicx::fit

#include "pipeline/preparation.h"

#include <gtest/gtest.h>

namespace mimicx::pipeline {
namespace {

const std::filesystem::path kNoisy =
    std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test/noisy/stand_1.npz";

TEST(Preparation, ReferencesHaveKeypointsOnlyWhereTheyWereFittedOntoThem) {
  EXPECT_TRUE(prepare_motion(kNoisy, {}, true).reference.keypoints.has_value());
  const PreparedMotion unfitted = prepare_motion(kNoisy, {}, false);
  EXPECT_TRUE(unfitted.input.keypoints.has_value());
  EXPECT_FALSE(unfitted.reference.keypoints.has_value()) << "Eq. 3 would ask for a second pose";
}

}  // namespace
}  // namespace mimicx::pipeline

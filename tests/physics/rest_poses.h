/// Resting poses, and how the floor carries them. The tests bound the measurements, tools/bench_contact
/// prints them.
///
/// All figures but the lying ones have stiffened joints: the tests are about contact geometry and the contact
/// law, not about balance, which a policy provides. Lying needs none.
#pragma once

#include "physics/test_states.h"

namespace mimicx::physics {

enum class RestPose { kBothSoles, kOneSole, kToeBalls, kKneeling, kAllFours, kSupine, kProne };
inline constexpr std::array kRestPoses = {RestPose::kBothSoles, RestPose::kOneSole,  RestPose::kToeBalls,
                                          RestPose::kKneeling,  RestPose::kAllFours, RestPose::kSupine,
                                          RestPose::kProne};
inline constexpr const char* kRestPoseNames[] = {"both soles", "one sole", "toe balls", "kneeling",
                                                 "all fours",  "supine",   "prone"};

/// The pose at rest with its lowest point on the floor; the PD target is the pose.
Snapshot rest_pose(RestPose pose, const Character& character);

/// Measurements over one second, after three (lying: eight) seconds to settle.
struct RestReport {
  PerBody<double> share{};  ///< of the weight, carried by each body, mean
  double heel_share = 0;    ///< of the weight, carried by the heel points, mean
  double force_error = 0;   ///< |ground force − weight| over the weight, largest of all steps
  double centre_error = 0;  ///< centre of pressure to the centre of mass, horizontally, m
  double mean_depth = 0;    ///< of the points that carry anything, under z = 0, m
  double deepest = 0;       ///< of any point, under z = 0, m
  double creep = 0;         ///< fastest horizontal speed of a point that carries anything, m/s
  double jitter = 0;  ///< largest minus smallest force of a point within the second, share of the weight
};
RestReport rest(RestPose pose, double rate, int passes);

}  // namespace mimicx::physics

/// Settings of the keypoint fit: prior uncertainties and effort.
///
/// Every σ belongs to one term of the cost in docs/method.md, "Keypoint fit". The level of every keypoint and
/// the power of the confidence are initial values: the fit estimates its own (error_levels.h).
#pragma once

#include "core/setting.h"

namespace mimicx::fit {

struct FitConfig {
  int iterations = 12;  ///< of Gauss-Newton, at most; contacts, labels and levels are found anew in each
  /// m: the fit ends with a step that moves the joints by less, on average and relative to the pelvis. 0:
  /// never.
  double smallest_change = 0.001;
  int threads = 1;          ///< no influence on the result
  bool find_levels = true;  ///< false: `keypoint_sigma` and `confidence_power` are believed

  // Keypoints, in heights of the person's box.
  double keypoint_sigma = 0.005;      ///< of a detection with its offsets taken out
  double keypoint_correlation = 0.5;  ///< of its error from frame to frame at 30 fps
  double confidence_power = 1.0;      ///< σ grows with confidence to the minus this power
  double flat_offset_sigma = 0.005;   ///< static offset of a keypoint in the picture
  double limb_offset_sigma = 0.004;   ///< m, static offset of a keypoint on its limb
  double keypoint_kernel = 0.03;      ///< residual at which a detection has lost half its weight, at first

  // What is known of camera and body; 0 keeps what the file says.
  double focal_sigma = 0.01;  ///< relative
  double tilt_sigma = 0.3;    ///< degrees
  double lead_sigma = 1.0;    ///< frames at 30 fps by which the keypoints are ahead of the motion
  double beta_sigma = 0.4;    ///< per entry, where the shape is of our own body model
  /// Where the file's shape means nothing here (standard body): how people differ in stature, and in the
  /// lengths of their limbs beside it. Relative.
  double stature_spread = 0.04, proportion_spread = 0.025;
  /// Factor on the weight of focal length, tilt and shape. Keypoint errors of neighbouring frames are alike,
  /// more than `keypoint_correlation` says; without the factor the keypoints would overrule what the file
  /// says.
  double told_weight = 10.0;

  // Corrections: size, and change from frame to frame at 30 fps.
  double joint_sigma = 6.0;          ///< degrees
  double root_rotation_sigma = 4.0;  ///< degrees
  double root_position_sigma = 1.0;  ///< m
  /// Number of frames at 30 fps over which the input's error stays about the same. The sizes of the
  /// corrections of so many frames weigh as much as one.
  double prior_frames = 30.0;
  double joint_rate = 0.5;    ///< degrees per frame
  double joint_bend = 0.3;    ///< degrees per frame²
  double root_rate = 0.003;   ///< m per frame
  double root_bend = 0.0006;  ///< m per frame²

  // The result.
  double range_sigma = 3.0;           ///< degrees, of a joint beyond its range
  double acceleration_sigma = 0.012;  ///< m per frame², of every joint
  double floor_sigma = 0.02;          ///< m, height of a foot point that stands
  double slip_sigma = 0.003;          ///< m per frame, of a foot point that stands
  double penetration_sigma = 0.003;   ///< m, of a foot point below the floor

  // Poses alone (pose_fit.h): where they differ from the above.
  /// m per frame; if standing feet slide by a share of this, the joints and the pelvis' rotation have this
  /// share of their σ.
  double pose_slip = 0.0028;
  double pose_prior_frames = 15.0;        ///< `prior_frames` of a smooth motion
  double tremor_prior_frames = 5.0;       ///< of one that trembles: its errors last less
  double pose_joint_bend = 0.2;           ///< `joint_bend`
  double pose_root_rotation_sigma = 2.5;  ///< degrees
  /// Number of frames at 30 fps whose zero-moment points weigh as much as one. 0: balance is not asked for.
  double balance_frames = 8.0;
};

/// core/setting.h; `mimicx fit --set` takes them.
void visit_settings(FitConfig& f, const auto& visit) {
  visit("fit_iterations", f.iterations, 1, 1000, "iterations of Gauss-Newton, at most");
  visit("fit_smallest_change", f.smallest_change, 0, 1,
        "mean move of the joints by a step that ends the fit, m; 0: all iterations");
  visit("fit_find_levels", f.find_levels, 0, 1, "1: the levels of the keypoints' errors are estimated");
  visit("fit_keypoint_sigma", f.keypoint_sigma, 1e-9, 1e6, "sigma of a detection, box heights");
  visit("fit_keypoint_correlation", f.keypoint_correlation, 0, 0.99,
        "correlation of a detection's error from frame to frame");
  visit("fit_confidence_power", f.confidence_power, 0, 10,
        "sigma grows with confidence to the minus this power");
  visit("fit_flat_offset_sigma", f.flat_offset_sigma, 0, 1e6,
        "sigma of a keypoint's static offset in the picture, box heights");
  visit("fit_limb_offset_sigma", f.limb_offset_sigma, 0, 1e6,
        "sigma of a keypoint's static offset on its limb, m");
  visit("fit_focal_sigma", f.focal_sigma, 0, 1e6, "sigma of the focal length, relative; 0: as the file says");
  visit("fit_tilt_sigma", f.tilt_sigma, 0, 1e6, "sigma of the camera's tilt, degrees; 0: as the file says");
  visit("fit_lead_sigma", f.lead_sigma, 0, 1e6, "sigma of the frames by which keypoints are ahead; 0: none");
  visit("fit_beta_sigma", f.beta_sigma, 0, 1e6, "sigma of each entry of the shape; 0: as the file says");
  visit("fit_stature_spread", f.stature_spread, 0, 1,
        "relative sigma of a stature that the file does not tell");
  visit("fit_proportion_spread", f.proportion_spread, 0, 1,
        "relative sigma of limb lengths that the file does not tell");
  visit("fit_joint_sigma", f.joint_sigma, 1e-9, 1e6, "sigma of the input's joint rotations, degrees");
  visit("fit_root_rotation_sigma", f.root_rotation_sigma, 1e-9, 1e6,
        "sigma of the input's pelvis rotation, degrees");
  visit("fit_root_position_sigma", f.root_position_sigma, 1e-9, 1e6,
        "sigma of the input's pelvis position, m");
  visit("fit_prior_frames", f.prior_frames, 1e-9, 1e6,
        "frames at 30 fps over which the input's error stays the same");
  visit("fit_range_sigma", f.range_sigma, 1e-9, 1e6, "sigma of a joint beyond its range, degrees");
  visit("fit_slip_sigma", f.slip_sigma, 1e-9, 1e6,
        "sigma of the speed of a standing foot point, m per frame");
  visit("fit_balance_frames", f.balance_frames, 0, 1e6,
        "frames whose balance weighs as much as one frame; 0: no balance");
}

/// @throws std::invalid_argument naming a setting that no fit can have
inline void check(const FitConfig& config) { require_ranges(config); }

}  // namespace mimicx::fit

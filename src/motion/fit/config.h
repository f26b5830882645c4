/// Settings of the keypoint fit: the standard deviations of what it believes, and its effort.
///
/// Every σ is that of one term of the cost in docs/method.md, "Keypoint fit".
#pragma once

namespace mimicx::motion::fit {

struct FitConfig {
  int iterations = 12;  ///< of Gauss-Newton, at most; contacts and labels are found anew in each

  // Keypoints, in heights of the person's box.
  double keypoint_sigma = 0.003;       ///< what changes from frame to frame; wrists three times as much
  double keypoint_bias_sigma = 0.005;  ///< static offset of a keypoint over the clip
  double keypoint_kernel = 0.03;       ///< residual at which a detection has lost half its weight

  // What is known of camera and body; 0 keeps what the file says.
  double focal_sigma = 0.01;        ///< relative
  double tilt_sigma = 0.3;          ///< degrees
  double beta_sigma = 0.15;         ///< per entry, where the shape is of our own body model
  double foreign_beta_sigma = 1.0;  ///< where the file's shape means nothing here (standard body)
  /// Factor on the weight of the three above. Keypoint errors of neighbouring frames are alike, but the cost
  /// sums them as if every frame were an independent measurement; without the factor the keypoints would
  /// overrule what the file says of camera and shape.
  double told_weight = 10.0;

  // Corrections: size, and change from frame to frame at 30 fps.
  double joint_sigma = 6.0;          ///< degrees, times `relative_joint_error` of the joint
  double root_rotation_sigma = 4.0;  ///< degrees
  double root_position_sigma = 1.0;  ///< m
  /// Number of frames at 30 fps over which the input's error stays about the same. The sizes of the
  /// corrections of so many frames weigh as much as one.
  double prior_frames = 30.0;
  double joint_rate = 2.0;    ///< degrees per frame, times `relative_joint_error`
  double joint_bend = 0.6;    ///< degrees per frame², times `relative_joint_error`
  double root_rate = 0.003;   ///< m per frame
  double root_bend = 0.0006;  ///< m per frame²

  // The result.
  double acceleration_sigma = 0.012;  ///< m per frame², of every joint
  double floor_sigma = 0.02;          ///< m, height of a foot point that stands
  double slip_sigma = 0.002;          ///< m per frame, of a foot point that stands
  double penetration_sigma = 0.003;   ///< m, of a foot point below the floor
};

}  // namespace mimicx::motion::fit

/// Retargeting: the motion of a foreign skeleton on the 22 bodies.        docs/method.md, "Retargeting"
///
/// What is kept: the directions of thighs, shanks, upper arms and forearms, and of the trunk from the middle
/// of the hips to the middle of the shoulders, in every frame; how every joint turns relative to a neutral
/// pose; the path of the middle of the hips, times the ratio of leg lengths, so that planted feet stay
/// planted. Bone lengths are matched by fitting β. The neutral pose is the skeleton's rest pose where that is
/// a person who stands, else the frames that come nearest to one; it is found by geometry, so A-poses,
/// T-poses and rest poses with every bone along x need no tables. Unit and up axis are found from the
/// motion, too. Every decision is a line in `Clip::decisions`.
///
/// What it does not do: no inverse kinematics (hands do not meet where the proportions differ), no fingers,
/// no change of frame rate.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "import/retarget/skeleton.h"
#include "motion/clip.h"

namespace mimicx::import {

struct RetargetConfig {
  bool standard_body = false;  ///< β = 0 instead of the fitted one
  double scale = 0.0;          ///< metres per file unit; 0: found from the length of the legs
  std::optional<char> up;      ///< of the file: 'x', 'y', 'z', capitals for the negative axes; none: found
  std::filesystem::path joint_map;  ///< additional joint names (joint_names.h); empty: none
};

struct RetargetReport {
  /// Mean distance between the body's joint and the skeleton's, times the leg ratio, mm. NaN where nothing
  /// corresponds; pelvis, spine and collars are left out, because skeletons place these joints at will.
  PerBody<double> residual_mm{};
  double mean_residual_mm = 0.0;      ///< over the bodies that have one
  std::vector<std::string> unmapped;  ///< bodies without a joint of their own, which follow their parent
  double scale = 1.0;                 ///< metres per file unit
  char up = 'y';                      ///< the file's up axis, as in the settings
  double leg_ratio = 1.0;             ///< the character's legs over the skeleton's
  double lift = 0.0;                  ///< by which the motion was moved up onto the floor, m
  std::string neutral;                ///< "the rest pose"
  bool own = false;                   ///< a skeleton of `write_bvh`, taken over as it is: nothing was found
};

/// @return a clip of body model "mimicx", z up, metres, at the file's frame rate, standing on z = 0
/// @throws DataError when bodies cannot be found; std::invalid_argument for a setting that makes no sense
motion::Clip retarget(const SkeletonMotion& motion, const RetargetConfig& config = {},
                      RetargetReport* report = nullptr);

}  // namespace mimicx::import

/// Retargeting: transfers the motion of a foreign skeleton to the 22 bodies.  docs/method.md, "Retargeting"
///
/// It keeps, in every frame, the directions of thighs, shanks, upper arms and forearms, and of the trunk from
/// the middle of the hips to the middle of the shoulders; every joint's rotation relative to a neutral pose;
/// and the path of the middle of the hips, scaled by the ratio of leg lengths so that planted feet stay
/// planted. Where thigh and shank have other proportions than ours can have, and in motions from joint
/// positions, ankles keep their places instead of shanks and thighs their directions (retarget_contacts.h).
/// β is fitted to the bone lengths. The neutral pose is the skeleton's rest pose if that is a standing
/// person, else the frames nearest to one. It is found by geometry, so A-poses, T-poses and rest poses with
/// every bone along x need no tables. Unit and up axis are detected from the motion. `Clip::decisions` lists
/// every decision.
///
/// What it does not do: no inverse kinematics (hands do not meet where the proportions differ), no fingers,
/// no change of frame rate.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "import/body_mass.h"
#include "import/retarget/skeleton.h"
#include "motion/clip.h"

namespace mimicx::import {

struct RetargetConfig {
  bool standard_body = false;  ///< β = 0 instead of the fitted one
  double scale = 0.0;          ///< metres per file unit; 0: detected from the length of the legs
  std::optional<char> up;      ///< of the file: 'x', 'y', 'z', capitals for the negative axes; none: detected
  KnownBody known;             ///< of the person
  std::filesystem::path joint_map;  ///< additional joint names (joint_names.h); empty: none
};

struct RetargetReport {
  /// Mean distance between the body's joint and the skeleton's joint scaled by the leg ratio, mm. NaN for
  /// bodies without a joint, and for pelvis, spine and collars, whose joints differ between skeletons.
  PerBody<double> residual_mm{};
  double mean_residual_mm = 0.0;      ///< over the bodies that have one
  std::vector<std::string> unmapped;  ///< bodies without a joint of their own, which follow their parent
  double scale = 1.0;                 ///< metres per file unit
  char up = 'y';                      ///< the file's up axis, as in the settings
  double leg_ratio = 1.0;             ///< the character's legs over the skeleton's
  double lift = 0.0;                  ///< height by which the motion was moved up onto the floor, m
  std::string neutral;                ///< the neutral pose in words, e.g. "the rest pose"
  bool own = false;                   ///< a skeleton of `write_bvh`, which is copied without any detection
};

/// The decision about a first frame that is left out.
inline constexpr const char* kTPoseRemoved = "the first frame is a T-pose: removed";

/// @return a clip of body model "mimicx", z up, metres, at the file's frame rate, standing on z = 0
/// @throws DataError when bodies cannot be found; std::invalid_argument for an invalid setting
motion::Clip retarget(const SkeletonMotion& motion, const RetargetConfig& config = {},
                      RetargetReport* report = nullptr);

}  // namespace mimicx::import

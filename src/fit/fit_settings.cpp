#include "fit/fit_settings.h"

#include <stdexcept>

#include "core/setting.h"

namespace mimicx::fit {
namespace {

constexpr double kMost = 1e6;
constexpr double kLeast = 1e-9;  // of what the fit divides by

/// Calls add(name, field, least, most) for every number, in the order of config.h.
template <class Config, class Add>
void for_each_fit_setting(Config& config, const Add& add) {
  add("fit_iterations", config.iterations, 1, 1000);
  add("fit_find_levels", config.find_levels, 0, 1);
  add("fit_keypoint_sigma", config.keypoint_sigma, kLeast, kMost);
  add("fit_keypoint_correlation", config.keypoint_correlation, 0, 0.99);
  add("fit_confidence_power", config.confidence_power, 0, 10);
  add("fit_flat_offset_sigma", config.flat_offset_sigma, 0, kMost);
  add("fit_limb_offset_sigma", config.limb_offset_sigma, 0, kMost);
  add("fit_keypoint_kernel", config.keypoint_kernel, kLeast, kMost);
  add("fit_focal_sigma", config.focal_sigma, 0, kMost);
  add("fit_tilt_sigma", config.tilt_sigma, 0, kMost);
  add("fit_lead_sigma", config.lead_sigma, 0, kMost);
  add("fit_beta_sigma", config.beta_sigma, 0, kMost);
  add("fit_stature_spread", config.stature_spread, 0, 1);
  add("fit_proportion_spread", config.proportion_spread, 0, 1);
  add("fit_told_weight", config.told_weight, 0, kMost);
  add("fit_joint_sigma", config.joint_sigma, kLeast, kMost);
  add("fit_root_rotation_sigma", config.root_rotation_sigma, kLeast, kMost);
  add("fit_root_position_sigma", config.root_position_sigma, kLeast, kMost);
  add("fit_prior_frames", config.prior_frames, kLeast, kMost);
  add("fit_joint_rate", config.joint_rate, kLeast, kMost);
  add("fit_joint_bend", config.joint_bend, kLeast, kMost);
  add("fit_root_rate", config.root_rate, kLeast, kMost);
  add("fit_root_bend", config.root_bend, kLeast, kMost);
  add("fit_acceleration_sigma", config.acceleration_sigma, kLeast, kMost);
  add("fit_floor_sigma", config.floor_sigma, kLeast, kMost);
  add("fit_slip_sigma", config.slip_sigma, kLeast, kMost);
  add("fit_penetration_sigma", config.penetration_sigma, kLeast, kMost);
  add("fit_pose_slip", config.pose_slip, 0, kMost);
  add("fit_pose_prior_frames", config.pose_prior_frames, kLeast, kMost);
  add("fit_tremor_prior_frames", config.tremor_prior_frames, kLeast, kMost);
  add("fit_pose_joint_rate", config.pose_joint_rate, kLeast, kMost);
  add("fit_pose_joint_bend", config.pose_joint_bend, kLeast, kMost);
  add("fit_pose_root_rotation_sigma", config.pose_root_rotation_sigma, kLeast, kMost);
  add("fit_pose_slip_sigma", config.pose_slip_sigma, kLeast, kMost);
  add("fit_balance_frames", config.balance_frames, 0, kMost);
}

}  // namespace

NamedValues fit_settings(const FitConfig& config) {
  return numbers_in([&](const auto& add) { for_each_fit_setting(config, add); });
}

void apply_setting(FitConfig& config, const std::string& name, double value) {
  if (!change_one([&](const auto& add) { for_each_fit_setting(config, add); }, name, value))
    throw std::invalid_argument("unknown setting '" + name + "': `mimicx config` lists them all");
}

void check(const FitConfig& config) {
  require_ranges([&](const auto& add) { for_each_fit_setting(config, add); });
}

}  // namespace mimicx::fit

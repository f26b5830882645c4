#include "record/former_settings.h"

#include <string_view>

#include "core/containers.h"

namespace mimicx::record {
namespace {

struct FormerSetting {
  std::string_view name;
  double value;  ///< the default then, the constant today
};

constexpr Array<FormerSetting, 47> kFormerSettings = {{{
    {"plan_help", 96},
    {"plan_help_spin", 8.6},
    {"plan_derivatives", 0},
    {"plan_step_position", 1.5e-3},
    {"plan_step_rotation", 3e-3},
    {"plan_step_velocity", 1.5e-2},
    {"plan_step_spin", 3e-2},
    {"plan_step_residual", 1.5e-2},
    {"plan_step_help", 0.45},
    {"plan_step_help_spin", 1.5},
    {"plan_trusted", 0.2},
    {"plan_backtracks", 12},
    {"return_rate", 0.1},
    {"step_factor", 1.5},
    {"penalty_fraction", 0.125},
    {"bound_weight", 0},
    {"mean_bound", 3},
    {"gradient_slots", 4},
    {"softest_reward", 0.1},
    {"bin_frames", 10},
    {"teach_gain_residual", 1600},
    {"teach_gain_change", 1600},
    {"teach_less_smoothing", 2},
    {"teach_enough", 0.75},
    {"teach_max_correction", 1},
    {"teach_packs", 2},
    {"teach_steps_per_frame", 1},
    {"teach_step_size", 2e-3},
    {"teach_last_step_size", 5e-5},
    {"teach_rows", 64000},
    {"teach_push_every", 15},
    {"teach_teacher_lanes", 2},
    {"teach_minibatch", 256},
    {"teach_slots", 2},
    {"teach_gradient_norm", 5},
    {"encoder_code", 64},
    {"encoder_hidden", 256},
    {"encoder_corruption", 0.1},
    {"school_packs", 64},
    {"school_step_size", 1e-3},
    {"school_last_step_size", 2e-5},
    {"school_decay", 0},
    {"school_push_every", 15},
    {"school_teacher_lanes", 2},
    {"school_minibatch", 512},
    {"school_slots", 2},
    {"school_gradient_norm", 5},
}}};

}  // namespace

bool is_former_default(const std::string& name, double value) {
  for (const FormerSetting& former : kFormerSettings)
    if (former.name == name) return former.value == value;
  return false;
}

Json former_member(const Json& settings, const std::string& name) {
  if (settings.contains("fit") && !settings.contains(name)) {
    if (name == "as_is") return false;
    if (name == "keypoints") return settings.at("fit");
  }
  return settings.value(name, nullptr);
}

std::string current_method(const std::string& name) { return name == "paper" ? "options" : name; }

}  // namespace mimicx::record

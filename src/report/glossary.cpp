#include "report/glossary.h"

#include <algorithm>
#include <map>

#include "motion/metrics.h"

namespace mimicx::report {
namespace {

using Table = std::map<std::string, Words>;

const std::map<std::string, std::string>& metric_words() {
  static const std::map<std::string, std::string> kWords = {
      {"MRPE", "place of the pelvis"},
      {"gMPJPE", "place of the joints"},
      {"MPJPE", "pose"},
      {"PA-MPJPE", "pose, sizes and turns apart"},
      {"Vel", "speeds of the joints"},
      {"Accel", "accelerations of the joints"},
      {"FS", "feet slide"},
      {"GP", "sinks into the floor"},
      {"Float", "hangs over the floor"},
      {"FS_0", "feet slide, strictly"},
      {"FS_gt", "feet slide where they should stand"},
      {"GP_max", "deepest point in the floor"},
      {"Float_gt", "hangs where it should stand"},
      {"Jitter", "shakes"},
      {"SelfPen", "limbs in the body"},
  };
  return kWords;
}

/// "group.name", and "name" for all groups.
const Table& value_words() {
  static const Table kWords = {
      {"fit.residual_before_percent",
       {"distance from the keypoints before", "%",
        "mean distance of the projected joints from their "
        "detections, in parts of the person's height"}},
      {"fit.residual_after_percent", {"distance from the keypoints after", "%", "the same after the fit"}},
      {"fit.iterations", {"steps of the fit", "", ""}},
      {"fit.focal_scale", {"focal length, times the file's", "", "found by the fit"}},
      {"fit.tilt_deg", {"camera tilted by", "°", "found by the fit"}},
      {"fit.shape_change", {"change of the body's shape", "", "norm of the change of β"}},
      {"fit.keypoint_sigma_percent", {"noise of the keypoints", "%", "in parts of the person's height"}},
      {"fit.keypoint_sigma_max_percent", {"noise of the noisiest keypoint", "%", ""}},
      {"fit.confidence_power", {"how far confidences tell the noise", "", "0: not at all; 1: in full"}},
      {"fit.lead_frames", {"keypoints ahead of the poses by", "frames", ""}},
      {"fit.swapped_frames", {"frames with left and right exchanged", "", "put right"}},
      {"fit.dropped_points", {"keypoints that were not believed", "", ""}},
      {"change_mean_mm", {"joints moved by, on average", "mm", ""}},
      {"change_max_mm", {"joints moved by, at most", "mm", ""}},
      {"preparation.floor_shift_mm",
       {"moved up or down by, on average", "mm", "so that it stands on the floor"}},
      {"preparation.max_floor_shift_mm", {"moved up or down by, at most", "mm", ""}},
      {"preparation.hinge_residual_mean_mm", {"moved by knees and elbows as hinges, on average", "mm", ""}},
      {"preparation.hinge_residual_max_mm", {"moved by knees and elbows as hinges, at most", "mm", ""}},
      {"preparation.arms_moved_mm", {"arms moved out of the body by", "mm", ""}},
      {"preparation.foot_level_deg", {"feet turned level by", "°", ""}},
      {"preparation.flagged_frames", {"implausible frames that were bridged", "", ""}},
      {"preparation.limb_frames", {"frames with a limb that was bridged", "", ""}},
      {"preparation.pose_fit_mean_mm",
       {"moved by the fit of poses, on average", "mm",
        "onto its own standing feet and balance, where there are no keypoints"}},
      {"preparation.pose_fit_max_mm", {"moved by the fit of poses, at most", "mm", ""}},
      {"plan.frames", {"frames that were planned", "", ""}},
      {"plan.cost", {"cost of the plan", "", "what the planner made as small as it could"}},
      {"plan.worst_distance_mm", {"farthest body from the reference", "mm", ""}},
      {"plan.iterations", {"steps of the planner", "", ""}},
      {"plan.linearised_frames", {"frames whose derivatives were taken", "", ""}},
      {"plan.backtracks", {"stretches that were planned again", "", ""}},
      {"plan.by_way_of_help",
       {"found by way of help from outside", "", "1: a plan with help had to show how"}},
      {"policy.teacher_survives", {"pushes that the plan's feedback survives", "share", ""}},
      {"policy.lessons", {"lessons", "", "states in which the plan said what to do"}},
      {"policy.rounds", {"rounds of lessons", "", ""}},
      {"policy.polish_samples", {"samples of the polish by PPO", "", ""}},
      {"policy.success", {"follows the motion alone", "", "1: it does"}},
      {"policy.gMPJPE", {"places of the joints against the plan", "mm", ""}},
      {"policy.MPJPE", {"pose against the plan", "mm", ""}},
      {"policy.Jitter", {"shakes", "10 m/s³", ""}},
      {"policy.pushes_survived", {"pushes that the policy survives", "share", ""}},
      {"policy.pushes_tried", {"pushes that were tried", "", ""}},
      {"audit.root_force_mean_N",
       {"force from nowhere, on average", "N",
        "what gravity, floor and the body's "
        "own forces leave unexplained"}},
      {"audit.root_force_max_N", {"force from nowhere, at most", "N", ""}},
      {"audit.root_force_worst", {"force from nowhere is largest at frame", "", ""}},
      {"audit.root_moment_mean_Nm", {"moment from nowhere, on average", "N·m", "about the centre of mass"}},
      {"audit.root_moment_max_Nm", {"moment from nowhere, at most", "N·m", ""}},
      {"audit.root_moment_worst", {"moment from nowhere is largest at frame", "", ""}},
      {"audit.torque_gap_mean_Nm",
       {"recorded joint torques beside the required ones, on average", "N·m", ""}},
      {"audit.torque_gap_max_Nm", {"recorded joint torques beside the required ones, at most", "N·m", ""}},
      {"audit.torque_worst_share", {"largest joint torque, in parts of its bound", "", "1: at its bound"}},
      {"audit.torque_violations", {"frames with a torque over its bound", "", ""}},
      {"audit.beyond_cone_percent", {"friction beyond what the floor gives", "%", "of the normal impulse"}},
      {"audit.pull_percent", {"floor that pulls", "%", "of the normal impulse"}},
      {"audit.in_air_percent", {"floor forces on bodies in the air", "%", "of the normal impulse"}},
      {"audit.cone_violations", {"frames with such friction or pull", "", ""}},
      {"audit.travel_worst_share",
       {"way of the centre of mass beyond its speed", "",
        "in parts of what forces "
        "can do by their timing"}},
      {"audit.power_max_W", {"largest power of all joints", "W", ""}},
      {"audit.work_positive_J", {"work of the joints that drive", "J", ""}},
      {"audit.work_negative_J", {"work of the joints that brake", "J", ""}},
      {"feasibility.frames", {"frames that were judged", "", ""}},
      {"feasibility.fps", {"frame rate", "1/s", ""}},
      {"feasibility.weight_N", {"weight of the body", "N", ""}},
      {"feasibility.force_mean_N",
       {"force from outside, on average", "N",
        "by the poses alone, after the best "
        "that a floor could do"}},
      {"feasibility.force_max_N", {"force from outside, at most", "N", ""}},
      {"feasibility.accel_mean_m_s2", {"the same by the body's mass, on average", "m/s²", ""}},
      {"feasibility.accel_max_m_s2", {"the same by the body's mass, at most", "m/s²", ""}},
      {"feasibility.moment_mean_Nm", {"moment from outside, on average", "N·m", ""}},
      {"feasibility.moment_max_Nm", {"moment from outside, at most", "N·m", ""}},
      {"feasibility.worst_frame", {"the force is largest at frame", "", ""}},
      {"feasibility.infeasible_share", {"share of frames that no body can do", "", ""}},
      {"feasibility.hovers_share",
       {"share of frames that hover", "", "nothing is near the floor, and it does not fall"}},
      {"feasibility.pulled_share", {"share of frames that are pulled down", "", ""}},
      {"feasibility.drifts_share", {"share of frames that drift in the air", "", ""}},
      {"feasibility.turns_share", {"share of frames that turn in the air", "", ""}},
      {"feasibility.slips_share", {"share of frames that would slip", "", ""}},
      {"feasibility.tips_share", {"share of frames that would tip over", "", ""}},
      {"feasibility.sunk_share", {"share of frames that are in the floor", "", ""}},
      {"feasibility.longest_s", {"longest stretch that no body can do", "s", ""}},
      {"feasibility.longest_first", {"it begins at frame", "", ""}},
      {"feasibility.longest_last", {"it ends at frame", "", ""}},
      {"feasibility.over_torque_share", {"share of frames with a joint over its bound", "", ""}},
      {"feasibility.torque_max_share", {"largest torque, in parts of the joint's bound", "", ""}},
      {"feasibility.lowest_mm", {"lowest point over the floor", "mm", ""}},
      {"feasibility.help_frames", {"frames that were planned with help", "", "a plan's soft stage"}},
      {"feasibility.help_force_mean_N", {"help, on average", "N", "a force on the pelvis, at a price"}},
      {"feasibility.help_force_max_N", {"help, at most", "N", ""}},
      {"feasibility.help_accel_mean_m_s2", {"help by the body's mass, on average", "m/s²", ""}},
      {"feasibility.help_accel_max_m_s2", {"help by the body's mass, at most", "m/s²", ""}},
      {"feasibility.help_moment_mean_Nm", {"moment of the help, on average", "N·m", ""}},
      {"feasibility.help_moment_max_Nm", {"moment of the help, at most", "N·m", ""}},
      {"feasibility.help_worst_frame", {"the help is largest at frame", "", ""}},
  };
  return kWords;
}

const Table& log_words() {
  static const Table kWords = {
      {"iteration", {"iterations", "", ""}},
      {"samples", {"samples", "", "control steps that were simulated"}},
      {"reward", {"mean reward of a step", "", "with noise on the actions; 1 is the reference itself"}},
      {"episode_length", {"length of an episode", "frames", "until the body is lost or the clip ends"}},
      {"reward_term", {"factors of the reward", "", "their product is the reward"}},
      {"kl",
       {"step of the policy (KL divergence)", "", "how far an update moved the policy from the one before"}},
      {"step_size", {"step size of the actor", "", "follows the step of the policy"}},
      {"sigma", {"noise on the actions", "rad", "standard deviation"}},
      {"policy_loss", {"loss of the policy", "", ""}},
      {"value_loss", {"loss of the critic", "", ""}},
      {"explained_variance", {"what the critic explains of the returns", "", "1: all of their variance"}},
      {"clip_fraction", {"share of clipped ratios", "", "samples whose update PPO holds back"}},
      {"gradient_norm", {"norm of the gradients", "", ""}},
      {"penalty", {"penalty of the critic's gradient", "", ""}},
      {"saturation", {"share at the bound", "", "actions that were clipped, torques at their bounds"}},
      {"sharpness", {"sharpness of the reward", "", "exponent of the softened reward; 1: the reward itself"}},
      {"rollout_reward", {"reward of the mean actions", "", "over the whole clip"}},
      {"rollout_position_error_mm", {"distance of the joints, mean actions", "mm", "over the whole clip"}},
  };
  return kWords;
}

const std::map<std::string, std::string>& group_words() {
  static const std::map<std::string, std::string> kWords = {
      {"fit", "Keypoint fit"}, {"preparation", "Preparation"},
      {"plan", "Plan"},        {"feasibility", "What the prepared reference asks for"},
      {"policy", "Policy"},    {"audit", "Audit: do the recorded forces explain the motion?"},
  };
  return kWords;
}

std::string with_blanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const Words* find_value(const std::string& group, const std::string& name) {
  const Table& words = value_words();
  auto found = words.find(group + "." + name);
  if (found == words.end()) found = words.find(name);
  return found == words.end() ? nullptr : &found->second;
}

}  // namespace

Words words_of_metric(const std::string& name) {
  if (name == "max_distance_mm")
    return {"farthest body from the reference", "mm", "the largest distance that any body ever had"};
  const auto found = metric_words().find(name);
  for (const motion::MetricDefinition& d : motion::metric_definitions()) {
    if (name != d.name) continue;
    std::string unit = d.unit;
    for (const auto& [plain, raised] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}})
      if (const std::size_t at = unit.find(plain); at != std::string::npos) unit.replace(at, 2, raised);
    return {found == metric_words().end() ? name : found->second, unit, d.definition};
  }
  return {with_blanks(name), "", ""};
}

Words words_of_value(const std::string& group, const std::string& name) {
  const Words* found = find_value(group, name);
  return found ? *found : Words{with_blanks(name), "", ""};
}

std::string words_of_group(const std::string& group) {
  const auto found = group_words().find(group);
  return found == group_words().end() ? group : found->second;
}

Words words_of_log(const std::string& title) {
  const auto found = log_words().find(title);
  return found == log_words().end() ? Words{with_blanks(title), "", ""} : found->second;
}

std::string words_of_line(const std::string& name) {
  static const std::map<std::string, std::string> kWords = {
      {"root_position", "place of the pelvis"},
      {"root_rotation", "turn of the pelvis"},
      {"pose", "joint rotations"},
      {"velocity", "joint speeds"},
      {"end_effector", "hands and feet"},
      {"projection", "keypoints (Eq. 3)"},
  };
  const auto found = kWords.find(name);
  return found == kWords.end() ? with_blanks(name) : found->second;
}

std::string words_of_method(const std::string& method) {
  static const std::map<std::string, std::string> kWords = {
      {"plan", "a plan (optimal control)"},
      {"policy", "a policy that the plan has taught"},
      {"paper", "trained options, chosen frame by frame and tuned together"},
      {"imitate", "a policy trained from scratch"},
  };
  const auto found = kWords.find(method);
  return found == kWords.end() ? method : found->second;
}

bool has_words(const std::string& group, const std::string& name) {
  if (group == "log") return log_words().contains(name);
  if (group == "metrics") return metric_words().contains(name) || name == "max_distance_mm";
  return find_value(group, name) != nullptr;
}

}  // namespace mimicx::report

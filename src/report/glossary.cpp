#include "report/glossary.h"

#include <algorithm>
#include <map>

#include "motion/metrics.h"

namespace mimicx::report {
namespace {

using Table = std::map<std::string, Words>;

const std::map<std::string, std::string>& metric_words() {
  static const std::map<std::string, std::string> kWords = {
      {"MRPE", "position of the pelvis"},
      {"gMPJPE", "positions of the joints"},
      {"MPJPE", "pose"},
      {"PA-MPJPE", "pose, without scale and rotation"},
      {"Vel", "speeds of the joints"},
      {"Accel", "accelerations of the joints"},
      {"slip", "sliding"},
      {"slip_share", "sliding, share of frames"},
      {"chatter", "the floor's force chatters"},
      {"FS", "feet move near the floor"},
      {"GP", "penetrates the floor"},
      {"Float", "floats over the floor"},
      {"FS_0", "feet move in the floor"},
      {"FS_gt", "feet move where they should stand"},
      {"GP_max", "deepest point in the floor"},
      {"Float_gt", "floats where it should stand"},
      {"Jitter", "shakes"},
      {"SelfPen", "limbs in the body"},
  };
  return kWords;
}

Table fit_words() {
  return {
      {"residual_before_percent",
       {"distance from the keypoints before", "%",
        "of the projected joints from their detections, root mean square weighted by confidence, in parts of "
        "the person's height"}},
      {"residual_after_percent",
       {"distance from the keypoints after", "%",
        "the same after the fit, without the keypoints' constant offsets"}},
      {"iterations", {"steps of the fit", "", ""}},
      {"focal_scale", {"focal length, times the file's", "", "found by the fit"}},
      {"tilt_deg", {"camera tilted by", "°", "found by the fit"}},
      {"shape_change", {"change of the body's shape", "", "largest change of an entry of β"}},
      {"keypoint_sigma_percent", {"noise of the keypoints", "%", "in parts of the person's height"}},
      {"keypoint_sigma_max_percent", {"noise of the noisiest keypoint", "%", ""}},
      {"confidence_power", {"how well confidences predict the noise", "", "0: not at all; 1: fully"}},
      {"lead_frames", {"keypoints ahead of the poses by", "frames", ""}},
      {"swapped_frames", {"frames with left and right exchanged", "", "corrected"}},
      {"dropped_points", {"keypoints that were rejected", "", ""}},
  };
}

Table general_words() {
  return {
      {"change_mean_mm", {"joints moved by, on average", "mm", ""}},
      {"change_max_mm", {"joints moved by, at most", "mm", ""}},
  };
}

Table preparation_words() {
  return {
      {"floor_shift_mm", {"moved up or down by, all frames alike", "mm", "so that it stands on the floor"}},
      {"max_floor_shift_mm", {"moved up or down by, at most", "mm", ""}},
      {"hinge_residual_mean_mm", {"moved by knees and elbows as hinges, on average", "mm", ""}},
      {"hinge_residual_max_mm", {"moved by knees and elbows as hinges, at most", "mm", ""}},
      {"arms_moved_mm", {"arms moved out of the body by", "mm", ""}},
      {"feet_planted_mm", {"joints moved to plant the feet by", "mm", ""}},
      {"range_frames", {"frames with a joint beyond its range", "", ""}},
      {"range_deg", {"joints beyond their ranges, turned inside, by at most", "°", ""}},
      {"passages", {"passages of limbs through the body, led around it", "", ""}},
      {"passages_left", {"passages of limbs through the body that are left", "", ""}},
      {"foot_level_deg", {"feet turned level by", "°", ""}},
      {"flagged_frames", {"implausible frames that were bridged", "", ""}},
      {"limb_frames", {"frames with a limb that was bridged", "", ""}},
      {"pose_fit_mean_mm",
       {"moved by the fit of poses, on average", "mm",
        "onto its own standing feet and balance, where there are no keypoints"}},
      {"pose_fit_max_mm", {"moved by the fit of poses, at most", "mm", ""}},
  };
}

Table plan_words() {
  return {
      {"frames", {"frames that were planned", "", ""}},
      {"cost", {"cost of the plan", "", "which the planner minimises"}},
      {"worst_distance_mm", {"farthest body from the reference", "mm", ""}},
      {"iterations", {"steps of the planner", "", ""}},
      {"linearised_frames", {"frames whose derivatives were computed", "", ""}},
      {"backtracks", {"stretches that were planned again", "", ""}},
      {"by_way_of_help",
       {"found by assisted stages", "", "1: by plans with assistive forces, reduced to zero"}},
  };
}

Table policy_words() {
  return {
      {"teacher_survives", {"pushes that the plan's feedback survives", "share", ""}},
      {"lessons", {"lessons", "", "states, each with the plan's action"}},
      {"rounds", {"rounds of lessons", "", ""}},
      {"polish_samples", {"samples of the polish by PPO", "", ""}},
      {"success", {"follows the motion unaided", "", "1: yes"}},
      {"gMPJPE", {"positions of the joints against the plan", "mm", ""}},
      {"MPJPE", {"pose against the plan", "mm", ""}},
      {"Jitter", {"shakes", "10 m/s³", ""}},
      {"pushes_survived", {"pushes that the policy survives", "share", ""}},
      {"pushes_tried", {"pushes that were tried", "", ""}},
  };
}

Table audit_words() {
  return {
      {"root_force_mean_N",
       {"unexplained force, on average", "N", "beyond gravity, floor and the body's own forces"}},
      {"root_force_max_N", {"unexplained force, at most", "N", ""}},
      {"root_force_worst", {"unexplained force is largest at frame", "", ""}},
      {"root_moment_mean_Nm", {"unexplained moment, on average", "N·m", "about the centre of mass"}},
      {"root_moment_max_Nm", {"unexplained moment, at most", "N·m", ""}},
      {"root_moment_worst", {"unexplained moment is largest at frame", "", ""}},
      {"torque_gap_mean_Nm", {"recorded minus required joint torques, on average", "N·m", ""}},
      {"torque_gap_max_Nm", {"recorded minus required joint torques, at most", "N·m", ""}},
      {"torque_worst_share", {"largest joint torque, in parts of its bound", "", "1: at its bound"}},
      {"torque_violations", {"frames with a torque over its bound", "", ""}},
      {"beyond_cone_percent", {"friction beyond the friction cone", "%", "of the normal impulse"}},
      {"pull_percent", {"pull of the floor", "%", "of the normal impulse"}},
      {"in_air_percent", {"floor forces on bodies in the air", "%", "of the normal impulse"}},
      {"cone_violations", {"frames with such friction and pull", "", "together over 1 % of the weight"}},
      {"travel_worst_share",
       {"motion of the centre of mass beyond its velocity", "",
        "in parts of what the timing of forces can cause"}},
      {"power_max_W", {"largest power of all joints", "W", ""}},
      {"work_positive_J", {"work of the joints that drive", "J", ""}},
      {"work_negative_J", {"work of the joints that brake", "J", ""}},
  };
}

Table feasibility_words() {
  return {
      {"frames", {"frames that were judged", "", ""}},
      {"fps", {"frame rate", "1/s", ""}},
      {"weight_N", {"weight of the body", "N", ""}},
      {"force_mean_N",
       {"external force needed, on average", "N", "by the poses alone, beside the best floor forces"}},
      {"force_max_N", {"external force needed, at most", "N", ""}},
      {"accel_mean_m_s2", {"the same by the body's mass, on average", "m/s²", ""}},
      {"accel_max_m_s2", {"the same by the body's mass, at most", "m/s²", ""}},
      {"moment_mean_Nm", {"external moment needed, on average", "N·m", ""}},
      {"moment_max_Nm", {"external moment needed, at most", "N·m", ""}},
      {"worst_frame", {"force and moment together are largest at frame", "", ""}},
      {"infeasible_share", {"share of infeasible frames", "", ""}},
      {"hovers_share", {"share of frames that hover", "", "without contact, and without falling"}},
      {"pulled_share", {"share of frames that are pulled down", "", ""}},
      {"drifts_share", {"share of frames that drift in the air", "", ""}},
      {"turns_share", {"share of frames that turn in the air", "", ""}},
      {"slips_share", {"share of frames that would slip", "", ""}},
      {"tips_share", {"share of frames that would tip over", "", ""}},
      {"sunk_share", {"share of frames that are in the floor or a box", "", ""}},
      {"longest_s", {"longest infeasible stretch", "s", ""}},
      {"longest_first", {"it begins at frame", "", ""}},
      {"longest_last", {"it ends at frame", "", ""}},
      {"over_torque_share", {"share of frames with a joint over its bound", "", ""}},
      {"torque_max_share", {"largest torque, in parts of the joint's bound", "", ""}},
      {"lowest_mm", {"lowest contact point over the floor", "mm", ""}},
      {"in_box_mm", {"depth in the side of a box", "mm", ""}},
      {"help_frames", {"frames that were planned with assistive forces", "", "by a plan's assisted stage"}},
      {"help_force_mean_N", {"assistive force, on average", "N", "on the pelvis"}},
      {"help_force_max_N", {"assistive force, at most", "N", ""}},
      {"help_accel_mean_m_s2", {"assistive force by the body's mass, on average", "m/s²", ""}},
      {"help_accel_max_m_s2", {"assistive force by the body's mass, at most", "m/s²", ""}},
      {"help_moment_mean_Nm", {"assistive moment, on average", "N·m", ""}},
      {"help_moment_max_Nm", {"assistive moment, at most", "N·m", ""}},
      {"help_worst_frame", {"assistive force is largest at frame", "", ""}},
  };
}

/// Words of the manifest's values by group; "" has those of all groups.
const std::map<std::string, Table>& value_words() {
  static const std::map<std::string, Table> kWords = {
      {"fit", fit_words()},
      {"", general_words()},
      {"preparation", preparation_words()},
      {"plan", plan_words()},
      {"policy", policy_words()},
      {"audit", audit_words()},
      {"feasibility", feasibility_words()},
  };
  return kWords;
}

const Table& log_words() {
  static const Table kWords = {
      {"iteration", {"iterations", "", ""}},
      {"samples", {"samples", "", "control steps that were simulated"}},
      {"reward",
       {"mean softened reward of a step", "", "with noise on the actions; 1 is the reference itself"}},
      {"episode_length", {"length of an episode", "frames", "until the body falls or the clip ends"}},
      {"reward_term", {"factors of the reward", "", "on average, before softening"}},
      {"kl", {"step of the policy (KL divergence)", "", "how far an update changed the policy"}},
      {"step_size", {"step size of the actor", "", "adapted to the step of the policy"}},
      {"sigma", {"noise on the actions", "rad", "standard deviation"}},
      {"policy_loss", {"loss of the policy", "", ""}},
      {"value_loss", {"loss of the critic", "", ""}},
      {"explained_variance", {"explained variance of the returns", "", "by the critic; 1: all of it"}},
      {"clip_fraction", {"share of clipped ratios", "", "samples whose ratio PPO clips"}},
      {"gradient_norm", {"norm of the gradients", "", ""}},
      {"penalty", {"gradient penalty of the policy", "", "before its weight"}},
      {"saturation", {"share at the bound", "", "actions that were clipped, torques at their bounds"}},
      {"sharpness", {"sharpness of the reward", "", "exponent of the softened reward; 1: the reward itself"}},
      {"rollout_reward", {"mean reward of the mean actions", "", "over the whole clip, not softened"}},
      {"rollout_position_error_mm", {"distance of the joints, mean actions", "mm", "over the whole clip"}},
  };
  return kWords;
}

const std::map<std::string, std::string>& group_words() {
  static const std::map<std::string, std::string> kWords = {
      {"fit", "Keypoint fit"}, {"preparation", "Preparation"},
      {"plan", "Plan"},        {"feasibility", "Feasibility of the prepared reference"},
      {"policy", "Policy"},    {"audit", "Audit: do the recorded forces explain the motion?"},
  };
  return kWords;
}

std::string with_blanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const Words* find_value(const std::string& group, const std::string& name) {
  for (const std::string& key : {group, std::string()}) {
    const auto table = value_words().find(key);
    if (table == value_words().end()) continue;
    const auto found = table->second.find(name);
    if (found != table->second.end()) return &found->second;
  }
  return nullptr;
}

}  // namespace

Words words_of_metric(const std::string& name) {
  if (name == "max_distance_mm")
    return {"farthest body from the reference", "mm", "the largest distance of any body in any frame"};
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
      {"root_position", "position of the pelvis"},
      {"root_rotation", "rotation of the pelvis"},
      {"pose", "joint rotations"},
      {"velocity", "joint velocities"},
      {"end_effector", "hands and feet"},
      {"projection", "keypoints (Eq. 3)"},
  };
  const auto found = kWords.find(name);
  return found == kWords.end() ? with_blanks(name) : found->second;
}

std::string words_of_method(const std::string& method) {
  static const std::map<std::string, std::string> kWords = {
      {"plan", "a plan (optimal control)"},
      {"policy", "a policy taught by the plan"},
      {"options", "trained options, chosen frame by frame and fine-tuned jointly"},
      {"printed", "trained options, by the method as the paper prints it"},
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

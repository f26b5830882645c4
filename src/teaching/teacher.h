/// The DAgger expert: a plan and its feedback gains, which give an action in every state.
///
///     u = ū_t + K_t (z − z̄_t),      z = (state, residual before)                    control/gains.h
///
/// The teacher shows the planned motion itself, not the plan's reference: the planned motion is feasible, so
/// a policy that follows it exactly gets the full reward of rl/tracking. The planned motion therefore becomes
/// a reference (`reference_of_states`). Residuals on it that repeat the motion are found by a short plan that
/// starts from the old ones.
#pragma once

#include <memory>
#include <optional>

#include "control/gains.h"
#include "control/plan.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::teaching {

struct TeacherConfig {
  control::CostWeights weights;    ///< of the short plan and of the gains
  control::HorizonConfig horizon;  ///< of the short plan
  control::GainConfig gains;
  /// Feedback from derivatives that are smoothed over centimetres works for well-balanced motions; motions at
  /// the edge of balance need less smoothing. If the first kind survives less than `enough` of the pushes,
  /// the second is also tried, and the better one is used.
  double less_smoothing = 2.0;  ///< factor on DifferenceSteps for the second kind; the first is in `gains`
  double enough = 0.75;
  control::PushTest pushes{.speed = 0.05, .every = 15};
  double max_correction = 1.0;  ///< entries of K (z − z̄) are clamped to ± this, rad
};

struct Teacher {
  std::shared_ptr<const rl::tracking::TrackingClip> clip;  ///< the planned motion, as a student observes it
  control::Trajectory motion;   ///< the teacher's undisturbed motion; states x̄, controls ū
  List<Eigen::MatrixXf> gains;  ///< [frames − 1] K_t
  /// [frames − 1] the cost of a control error: Q_uu of the gains' backward sweep, [55][55], scaled to a mean
  /// diagonal of 1 over the motion.
  List<Eigen::MatrixXf> importance;
  double max_correction = 1.0;
  int followed = 0;  ///< trials with pushes (TeacherConfig) that the feedback followed to the end

  int size() const { return motion.size(); }  ///< control frames
};

/// @param reference  of the plan @param plan  complete
/// @return none if the short plan failed or was stopped
std::optional<Teacher> make_teacher(const motion::Reference& reference, const control::Plan& plan,
                                    const TeacherConfig& config, const rl::tracking::TrackingConfig& task,
                                    const control::PlanControl& control);

/// The plan with its controls as residuals on its own states instead of on its reference. The targets are the
/// same up to rounding, which feedback, or a short plan that starts here, corrects.
/// @param reference  of the plan
control::Trajectory on_own_states(const motion::Reference& reference, const control::Plan& plan);

/// The residuals of every lane, rad.
using LaneActions = Array<Array<float, kDofs>, physics::kLanes>;

/// The teacher's actions in every lane. @param t  frame of the lanes
/// @param before  residuals of the previous control step
LaneActions ask(const Teacher& teacher, int t, const physics::State<control::P>& x,
                const LaneActions& before);

}  // namespace mimicx::teaching

/// A planned motion as somebody who can be asked: my body is here now, what would you do?
///
///     u = ū_t + K_t (z − z̄_t),      z = (state, residual before)                    control/gains.h
///
/// What is taught is the planned motion itself, not the reference that it was planned for: a body can do it,
/// so whoever follows it exactly earns everything that the reward of rl/tracking has to give. The planned
/// motion therefore becomes a reference of its own (`reference_of_states`), with targets of its own:
/// residuals on it that repeat it, found by a short plan that starts from the old ones.
#pragma once

#include <memory>
#include <optional>

#include "control/gains.h"
#include "control/plan.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::teaching {

struct TeacherConfig {
  control::CostWeights weights;    ///< of the short plan, and behind the gains
  control::HorizonConfig horizon;  ///< likewise
  control::GainConfig gains;
  /// Feedback from derivatives that are smoothed over centimetres holds motions with room to spare; motions
  /// at the edge of balance are held better by less smoothing. Where the first kind survives less than
  /// `enough` of the pushes, the second is tried, too, and the better one teaches.
  double less_smoothing = 2.0;  ///< factor on DifferenceSteps of the second kind; the first is in `gains`
  double enough = 0.75;
  control::PushTest pushes{.speed = 0.05, .every = 15};
  double max_correction = 1.0;  ///< entries of K (z − z̄) are clamped to ± this, rad
};

struct Teacher {
  std::shared_ptr<const rl::tracking::TrackingClip> clip;  ///< the planned motion, as a student sees it
  control::Trajectory motion;                              ///< what the teacher does; states x̄, controls ū
  List<Eigen::MatrixXf> gains;                             ///< [frames − 1] K_t
  /// [frames − 1] what a wrong control costs: Q_uu of the sweep behind the gains, [55][55], scaled to a mean
  /// diagonal of 1 over the motion.
  List<Eigen::MatrixXf> importance;
  double max_correction = 1.0;
  int followed = 0;  ///< of the pushes (TeacherConfig), trials that the feedback followed to the end

  int size() const { return motion.size(); }  ///< control frames
};

/// @param reference  what was planned for  @param plan  followed to the end
/// @return none where the short plan is lost, or was told to stop
std::optional<Teacher> make_teacher(const motion::Reference& reference, const control::Plan& plan,
                                    const TeacherConfig& config, const rl::tracking::TrackingConfig& task,
                                    const control::PlanControl& control);

/// The plan with its controls as residuals on its own states instead of on what was planned for: the same
/// targets to the last bits, which feedback or a short plan that starts here takes care of.
/// @param reference  what was planned for
control::Trajectory on_own_states(const motion::Reference& reference, const control::Plan& plan);

/// The residuals of every lane, rad.
using LaneActions = Array<Array<float, kDofs>, physics::kLanes>;

/// What the teacher would do in every lane. @param t  frame that the lanes are at
/// @param before  residuals of the control step before
LaneActions ask(const Teacher& teacher, int t, const physics::State<control::P>& x,
                const LaneActions& before);

}  // namespace mimicx::teaching

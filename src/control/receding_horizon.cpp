#include "control/receding_horizon.h"

#include <algorithm>
#include <limits>

#include "control/shooting.h"

namespace mimicx::control {
namespace {

/// Frames added to the usual length of a window, in the order in which they are tried at one place.
constexpr Array<int, 3> kLonger = {0, 12, -5};

/// What stays the same from window to window.
struct Task {
  const ControlProblem& problem;
  const HorizonConfig& config;
  int threads;
};

struct Window {
  Trajectory plan;
  IterationState iterations;
};

/// The initial window of `n` frames after the motion's last state: the rest of the previous window, then the
/// guess, then the goal, with gaps.
Trajectory first_guess(const Task& task, const Trajectory& motion, const Trajectory& last, int n,
                       const Trajectory& guess) {
  Trajectory window;
  window.begin = motion.begin + motion.size();
  window.before = motion.u.empty() ? motion.before : motion.u.back();
  window.x.push_back(motion.x.back());
  for (int k = 0; k < n; ++k) {
    const int frame = window.begin + k, in_last = frame - last.begin;
    if (in_last >= 0 && in_last < last.size()) {
      window.u.push_back(last.u[in_last]);
      window.x.push_back(last.x[in_last + 1]);
    } else if (frame < guess.size()) {
      window.u.push_back(guess.u[frame]);
      window.x.push_back(guess.x[frame + 1]);
    } else {
      window.u.push_back(window.u.empty() ? Control{} : window.u.back());
      window.x.push_back(as_floats(task.problem.cost.goal[frame + 1]));
    }
  }
  window.gaps = find_gaps(task.problem.system, window);
  window.cost = window.worst = std::numeric_limits<double>::infinity();
  return window;
}

/// Drops the last frames of a motion.
void shorten(Trajectory& motion, int size) {
  motion.u.resize(size);
  motion.x.resize(size + 1);
}

/// Number of frames before the first gap.
int frames_without_gap(const Trajectory& window) {
  int t = 0;
  while (t < window.size() && window.gaps[t + 1].isZero(0.0)) ++t;
  return t;
}

/// Whether a window needs no iteration after `done` ones.
bool is_good(const HorizonConfig& o, const Trajectory& plan, int done, bool first) {
  const double per_frame = plan.cost / plan.size();  // infinite while there are gaps
  if (done == 0) return false;
  if (first) return done >= o.hard_iterations;
  if (per_frame <= o.easy_cost) return true;
  return done >= (per_frame <= o.hard_cost ? o.iterations : o.hard_iterations);
}

/// Improves the window by some iterations, and cuts off the frames from the first gap that is left.
void solve_window(const Task& task, bool first, Window& window, HorizonResult& result) {
  Trajectory& plan = window.plan;
  IterationState& state = window.iterations;
  state.regularisation = 0.0;
  state.models_current = false;
  for (int i = 0; !is_good(task.config, plan, i, first); ++i) {
    if (!state.models_current) result.linearised += plan.size();
    const Iteration done = improve(task.problem, task.config.trusted, task.threads, state, plan);
    ++result.iterations;
    const bool improved = done.decrease >= 0.0;
    if (improved && done.decrease < task.config.stop) break;
    if (!improved && state.regularisation > 1e4) break;
  }
  if (plan.gaps.empty()) return;
  shorten(plan, frames_without_gap(plan));
  replay_controls(task.problem.system, task.problem.cost, plan);
}

/// Records the failure of a window: its first frame with a body too far off, or the frame after its end if it
/// was cut.
void note_loss(const Task& task, const Trajectory& plan, HorizonResult& result) {
  int t = 0, body = -1;
  double distance = 0.0;
  while (t < plan.size() && distance <= task.config.failure_distance) {
    ++t;
    const int frame = plan.begin + t;
    const BodyPoses poses = poses_of(task.problem.system, plan.x[t]);
    distance = 0.0;
    for (std::size_t i = 0; i < kBodies; ++i) {
      const double off = (poses.p_WB[i] - task.problem.cost.p_WB[frame][i]).norm();
      if (off <= distance) continue;
      distance = off;
      body = static_cast<int>(i);
    }
  }
  const int frame = plan.begin + t + (distance > task.config.failure_distance ? 0 : 1);
  if (frame < result.lost_frame) return;
  result.lost_frame = frame;
  result.lost_body = body;
  result.lost_distance = distance;
}

/// State of the search over window lengths.
struct Search {
  int variant = 0;     ///< index into kLonger
  int until = 0;       ///< frame up to which it is used
  Trajectory longest;  ///< longest motion so far

  /// Goes back after a failure of the window at `begin`. @return false if nothing is left to try
  bool next(const HorizonConfig& config, int begin, int earliest, int frames, HorizonResult& result) {
    Trajectory& motion = result.motion;
    const bool exhausted = (begin <= until && variant + 1 >= static_cast<int>(kLonger.size())) ||
                           result.linearised > config.budget * frames;
    if (motion.size() > longest.size()) longest = motion;
    if (exhausted || result.backtracks >= config.backtracks) {
      motion = longest;
      return false;
    }
    ++result.backtracks;
    variant = begin > until ? 1 : variant + 1;
    until = std::max(until, begin + 2 * config.commit);
    shorten(motion, std::max(earliest, motion.size() - config.back));
    return true;
  }
};

}  // namespace

void replay_controls(const System& system, const Cost& cost, Trajectory& motion) {
  take_lane(roll_out(system, cost, motion, {}, step_lengths()), 0, motion);
}

HorizonResult follow_in_windows(const ControlProblem& problem, const HorizonConfig& config,
                                const PlanControl& control, Trajectory start, int end,
                                const Trajectory& guess) {
  const Task task{problem, config, control.threads};
  HorizonResult result;
  result.motion = std::move(start);
  Trajectory& motion = result.motion;
  const int earliest = motion.size();  // backtracking stops there: the given frames stay
  Search search;
  search.longest = motion;
  Window window;
  while (motion.begin + motion.size() < end) {
    if (control.should_stop && control.should_stop()) {
      result.ending = Ending::kStopped;
      if (search.longest.size() > motion.size()) motion = search.longest;
      return result;
    }
    const int begin = motion.begin + motion.size();
    if (begin >= search.until) search.variant = 0;
    const int n = std::clamp(config.horizon + kLonger[search.variant], 1, end - begin);
    window.plan = first_guess(task, motion, window.plan, n, guess);
    solve_window(task, motion.size() == earliest, window, result);
    const int planned = window.plan.size();
    if (planned < std::min(n, 2 * config.commit) || !(window.plan.worst <= config.failure_distance)) {
      note_loss(task, window.plan, result);
      if (!search.next(config, begin, earliest, end, result)) {
        result.ending = Ending::kLost;
        return result;
      }
      window.plan = {};
      continue;
    }
    const int taken = begin + planned >= end ? planned : std::min(config.commit, planned);
    for (int k = 0; k < taken; ++k) {
      motion.u.push_back(window.plan.u[k]);
      motion.x.push_back(window.plan.x[k + 1]);
    }
    if (control.progress) control.progress(begin + taken, problem.system.frames());
  }
  return result;
}

}  // namespace mimicx::control

#include "control/receding_horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace mimicx::control {
namespace {

/// A way to solve a window.
struct Variant {
  double steps;  ///< factor on the steps of the differences
  int longer;    ///< frames added to the horizon
  bool smoothed;
};
/// The usual one first; the order is that of the study, where each saved a clip that those before had lost.
constexpr std::array<Variant, 7> kVariants = {{{1.0, 0, false},
                                               {1.0, 0, true},
                                               {1.0 / 3.0, 0, false},
                                               {2.0, 5, false},
                                               {0.5, 12, true},
                                               {1.0, 12, false},
                                               {3.0, 0, false}}};

struct Window {
  Trajectory plan;
  std::vector<FrameModel> models;
  Sweep sweep;
};

/// The window of `n` frames after the motion's last state: the rest of the window before, then the guess.
Trajectory first_guess(const Trajectory& motion, const Trajectory& last, int n,
                       const std::vector<Control>& guess) {
  Trajectory window;
  window.begin = motion.begin + motion.size();
  window.before = motion.u.empty() ? motion.before : motion.u.back();
  window.x.assign(static_cast<std::size_t>(n + 1), motion.x.back());
  for (int k = 0; k < n; ++k) {
    const int frame = window.begin + k, in_last = frame - last.begin;
    if (in_last >= 0 && in_last < last.size())
      window.u.push_back(last.u[static_cast<std::size_t>(in_last)]);
    else if (frame < static_cast<int>(guess.size()))
      window.u.push_back(guess[static_cast<std::size_t>(frame)]);
    else
      window.u.push_back(window.u.empty() ? Control{} : window.u.back());
  }
  return window;
}

/// Rolls the window's controls out as they are.
void roll_plain(const System& system, const Cost& cost, Trajectory& window) {
  const auto scratch = std::make_unique<Data<P>>();
  const Fan fan = roll_out(system, cost, window, {}, step_lengths(), in_all_lanes<P>(window.x[0]), *scratch);
  take_lane(fan, 0, window);
}

/// Improves the window by some iterations.
void solve_window(const System& system, const Cost& cost, const Linearisation& how,
                  const HorizonOptions& options, int threads, bool first, Window& window,
                  HorizonResult& result) {
  roll_plain(system, cost, window.plan);
  const int n = window.plan.size();
  const bool hard = first || !(window.plan.cost <= options.hard_cost * n);
  const int iterations = hard ? options.hard_iterations : options.iterations;
  double regularisation = 0.0;
  bool fresh = true;
  for (int i = 0; i < iterations; ++i) {
    const Iteration done =
        improve(system, cost, how, threads, fresh, window.models, window.sweep, regularisation, window.plan);
    ++result.iterations;
    if (fresh) result.linearised += n;
    fresh = done.decrease >= 0.0;
    if (fresh && done.decrease < options.stop) break;
    if (!fresh && regularisation > 1e4) break;
  }
}

Linearisation with_variant(const Linearisation& how, const Variant& variant) {
  Linearisation out = how;
  out.steps = how.steps.scaled(variant.steps);
  if (variant.smoothed) out.derivatives = Derivatives::kSmoothed;
  return out;
}

/// First frame of the trajectory at which a body is farther than `distance`; −1 for none.
int first_far_frame(const System& system, const Cost& cost, const Trajectory& trajectory, double distance) {
  const auto scratch = std::make_unique<Data<P>>();
  for (int t = 1; t <= trajectory.size(); ++t) {
    const State<P> x = in_all_lanes<P>(trajectory.x[static_cast<std::size_t>(t)]);
    const float worst = state_cost(system, cost, trajectory.begin + t, x, *scratch).worst[0];
    if (!(static_cast<double>(worst) <= distance * distance)) return trajectory.begin + t;
  }
  return -1;
}

/// Drops the last frames of a motion.
void shorten(Trajectory& motion, int size) {
  motion.u.resize(static_cast<std::size_t>(size));
  motion.x.resize(static_cast<std::size_t>(size + 1));
}

}  // namespace

HorizonResult follow_in_windows(const System& system, const Cost& cost, const Linearisation& how,
                                const HorizonOptions& options, const PlanControl& control, Trajectory start,
                                int end, const std::vector<Control>& guess) {
  HorizonResult result;
  result.motion = std::move(start);
  Trajectory& motion = result.motion;
  const int earliest = motion.size();  // what was given is not taken back
  std::size_t variant = 0;
  int variant_until = 0;  // frame to which the variant is used
  Window window;
  bool first = true;
  while (motion.begin + motion.size() < end) {
    if (control.should_stop && control.should_stop()) {
      result.ending = Ending::kStopped;
      break;
    }
    const int begin = motion.begin + motion.size();
    if (begin >= variant_until) variant = 0;
    const int n = std::min(options.horizon + kVariants[variant].longer, end - begin);
    window.plan = first_guess(motion, window.plan, n, guess);
    solve_window(system, cost, with_variant(how, kVariants[variant]), options, control.threads, first, window,
                 result);
    first = false;
    if (!(window.plan.worst <= options.lost)) {
      const int far = first_far_frame(system, cost, window.plan, options.lost);
      const bool exhausted = variant + 1 >= kVariants.size() && begin <= variant_until;
      if (result.backtracks >= options.backtracks || exhausted) {
        result.ending = Ending::kLost;
        result.lost_frame = far;
        break;
      }
      ++result.backtracks;
      variant = begin > variant_until ? 1 : variant + 1;
      variant_until = std::max(variant_until, begin + 2 * options.commit);
      shorten(motion, std::max(earliest, motion.size() - options.back));
      window.plan = {};
      continue;
    }
    const int taken = begin + n >= end ? n : std::min(options.commit, n);
    for (int k = 0; k < taken; ++k) {
      motion.u.push_back(window.plan.u[static_cast<std::size_t>(k)]);
      motion.x.push_back(window.plan.x[static_cast<std::size_t>(k + 1)]);
    }
    if (control.progress) control.progress(begin + taken, system.frames());
  }
  return result;
}

}  // namespace mimicx::control

#include "motion/fit/fit.h"

#include <algorithm>

#include "core/error.h"
#include "motion/fit/solution.h"

namespace mimicx::motion::fit {
namespace {

constexpr std::size_t kFewestPoints = 6;  ///< joints among the keypoints, else there is nothing to fit to

/// Why there is nothing to fit to; empty where there is.
std::string reason_to_refuse(const FitProblem& problem) {
  if (problem.points.size() < kFewestPoints) return "too few keypoints of known joints: left as it is";
  const auto seen = std::count_if(problem.box.begin(), problem.box.end(), [](double b) { return b > 0.0; });
  if (2 * seen < problem.frames()) return "the camera does not see the motion: left as it is";
  return "";
}

}  // namespace

Clip fit_keypoints(const Clip& clip, const FitConfig& config, FitReport* report) {
  FitReport r;
  Clip fitted = clip;
  if (!clip.keypoints) {
    r.notes.emplace_back("no keypoints: left as it is");
  } else {
    require_usable(clip, 3);
    FitProblem problem = make_problem(clip, config);
    if (const std::string why = reason_to_refuse(problem); !why.empty())
      r.notes.push_back(why);
    else
      fitted = solved(clip, problem, r);
  }
  if (report) *report = r;
  return fitted;
}

}  // namespace mimicx::motion::fit

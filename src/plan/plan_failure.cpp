#include "plan/plan_failure.h"

#include <algorithm>

#include "audit/pose_verdict.h"
#include "character/body_words.h"
#include "core/number_text.h"

namespace mimicx::plan {
namespace {

/// Frames before the failure that are searched for its cause: toppling takes most of a second.
constexpr int kFramesBefore = 30;
/// Frames after the failure whose assistance is also counted: a body that only just passes falls there.
constexpr int kFramesAfter = 15;
constexpr double kHoldingForce = 150.0;  ///< N, of a self contact that holds the body …
constexpr int kHeldFrames = 5;           ///< … in so many frames

/// The two bodies that push each other hardest in frames first … last, if self contact holds the body there;
/// else nothing.
std::string self_contact_in_words(const std::vector<rl::tracking::ActingForces>& planned, int first,
                                  int last) {
  PerBody<double> largest{};
  int held = 0;
  for (int t = first; t <= last && t < static_cast<int>(planned.size()); ++t) {
    double hardest = 0.0;
    for (int body = 0; body < kBodies; ++body) {
      const double force = planned[static_cast<std::size_t>(t)].self_contact[body].tail<3>().norm();
      largest[body] = std::max(largest[body], force);
      hardest = std::max(hardest, force);
    }
    held += hardest > kHoldingForce ? 1 : 0;
  }
  if (held < kHeldFrames) return "";
  const auto hardest = std::max_element(largest.begin(), largest.end());
  const double force = *hardest;
  const int one = static_cast<int>(hardest - largest.begin());
  *hardest = 0.0;
  const int other = static_cast<int>(std::max_element(largest.begin(), largest.end()) - largest.begin());
  return formatted("self contact holds the body: %s and %s push each other with up to %.0f N",
                   body_in_words(one).c_str(), body_in_words(other).c_str(), force);
}

/// The infeasible stretches of the reference in frames first … last, in words.
std::string needs_in_words(const audit::PoseNeeds& needs, int first, int last) {
  std::string text;
  for (const audit::Stretch& stretch : audit::infeasible_stretches(needs))
    if (stretch.last >= first && stretch.first <= last)
      text += (text.empty() ? "the reference is not feasible there: " : "; ") + audit::in_words(stretch);
  return text;
}

}  // namespace

std::string failure_in_words(const control::Failure& failure, const audit::PoseNeeds& needs,
                             const PerFrame<Vector6d>& assistance,
                             const std::vector<rl::tracking::ActingForces>& planned) {
  std::string text =
      formatted("the plan fails at frame %d (%.2f s)", failure.frame, failure.frame / needs.fps);
  if (failure.body >= 0)
    text += formatted(": the %s is %.2f m from its reference", body_in_words(failure.body).c_str(),
                      failure.distance);
  if (needs.frames.empty()) return text;
  const int first = std::max(failure.frame - kFramesBefore, 0);
  const int last = std::min(failure.frame, needs.frames.count() - 1);
  const std::string needed = needs_in_words(needs, first, last),
                    held = self_contact_in_words(planned, first, last);
  for (const std::string& cause : {needed, held})
    if (!cause.empty()) text += "; " + cause;
  if (needed.empty() && held.empty())
    text += formatted(
        "; over frames %d to %d the reference needs next to nothing from outside: a body could follow "
        "it, and no way was found",
        first, last);
  const std::string helped =
      judge::assistance_in_words(assistance, needs.mass, first, failure.frame + kFramesAfter);
  return helped.empty() ? text : text + "; " + helped;
}

}  // namespace mimicx::plan

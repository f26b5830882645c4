#include "plan/plan_failure.h"

#include <algorithm>
#include <cstdio>

#include "audit/pose_verdict.h"
#include "character/body_words.h"

namespace mimicx::plan {
namespace {

/// Frames before the failure that are searched for its cause: toppling takes most of a second.
constexpr int kFramesBefore = 30;
/// Frames after the failure whose assistance is also counted: a body that only just passes falls there.
constexpr int kFramesAfter = 15;

template <class... Args>
std::string print(const char* format, Args... args) {
  char text[200];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

/// The infeasible stretches of the reference in frames first … last, in words.
std::string needs_in_words(const audit::PoseNeeds& needs, int first, int last) {
  std::string text;
  for (const audit::Stretch& stretch : audit::infeasible_stretches(needs))
    if (stretch.last >= first && stretch.first <= last)
      text += (text.empty() ? "the reference is not feasible there: " : "; ") + audit::in_words(stretch);
  if (!text.empty()) return text;
  return print(
      "over frames %d to %d the reference needs next to nothing from outside: a body could follow it, "
      "and no way was found",
      first, last);
}

}  // namespace

std::string failure_in_words(const control::Failure& failure, const audit::PoseNeeds& needs,
                             const PerFrame<Vector6d>& assistance) {
  std::string text = print("the plan fails at frame %d (%.2f s)", failure.frame, failure.frame / needs.fps);
  if (failure.body >= 0)
    text +=
        print(": the %s is %.2f m from its reference", body_in_words(failure.body).c_str(), failure.distance);
  if (needs.frames.empty()) return text;
  const int first = std::max(failure.frame - kFramesBefore, 0);
  text += "; " + needs_in_words(needs, first, std::min(failure.frame, needs.frames.count() - 1));
  const std::string helped =
      judge::assistance_in_words(assistance, needs.mass, first, failure.frame + kFramesAfter);
  return helped.empty() ? text : text + "; " + helped;
}

}  // namespace mimicx::plan

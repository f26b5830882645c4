#include "pipeline/plan_loss.h"

#include <algorithm>
#include <cstdio>

#include "pipeline/audit/pose_verdict.h"

namespace mimicx::pipeline {
namespace {

/// Frames before the loss in which its cause is looked for: what topples a body takes most of a second.
constexpr int kFramesBefore = 30;

template <class... Args>
std::string print(const char* format, Args... args) {
  char text[200];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

/// What the reference asks for in frames first … last that no body can do.
std::string needs_in_words(const motion::Reference& reference, int first, int last) {
  const audit::PoseNeeds needs = audit::needs_of_poses(reference.character, reference.poses, reference.fps);
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

std::string loss_in_words(const motion::Reference& reference, const control::Loss& loss) {
  std::string text = print("the plan is lost at frame %d (%.2f s)", loss.frame, loss.frame / reference.fps);
  if (loss.body >= 0)
    text +=
        print(": %s is %.2f m from its reference", std::string(kBodyNames[loss.body]).c_str(), loss.distance);
  if (loss.help_force > 0.0 || loss.help_moment > 0.0)
    text += print("; a hand that holds the pelvis would keep it there with %.0f N and %.0f N m",
                  loss.help_force, loss.help_moment);
  if (reference.size() < 3) return text;
  const int first = std::max(loss.frame - kFramesBefore, 0);
  return text + "; " + needs_in_words(reference, first, std::min(loss.frame, reference.size() - 1));
}

}  // namespace mimicx::pipeline

#include "pipeline/plan_loss.h"

#include <algorithm>
#include <cstdio>

#include "pipeline/audit/audit.h"

namespace mimicx::pipeline {
namespace {

/// Frames before the loss in which its cause is looked for: what topples a body takes most of a second.
constexpr int kFramesBefore = 30;
/// Parts of the weight, and of it times one metre, under which a reference asks for nothing that a body
/// cannot do.
constexpr double kNoForce = 0.1, kNoMoment = 0.05;

template <class... Args>
std::string print(const char* format, Args... args) {
  char text[200];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

/// What the reference needs from outside, at its worst frames.
struct Need {
  double force = 0.0, moment = 0.0;       ///< N; N·m about the centre of mass
  int force_frame = 0, moment_frame = 0;  ///< where
  double weight = 0.0;                    ///< N
};

Need need_of(const motion::Reference& reference, int first, int last) {
  std::vector<Vector3d> p_root;
  std::vector<PerBody<Quaterniond>> q;
  for (const motion::ReferenceFrame& frame : reference.frames) {
    p_root.push_back(frame.p_root);
    q.push_back(frame.q);
  }
  const audit::Audit audit =
      audit::audit_poses(motion::to_clip(reference.name, reference.fps, reference.character, p_root, q));
  Need need;
  need.weight = audit.weight;
  for (const audit::AuditRow& row : audit.rows) {
    if (row.index < first || row.index > last) continue;
    const double moment = row.root.head<3>().norm(), force = row.root.tail<3>().norm();
    if (force > need.force) need.force = force, need.force_frame = row.index;
    if (moment > need.moment) need.moment = moment, need.moment_frame = row.index;
  }
  return need;
}

std::string need_in_words(const Need& need, int first, int last) {
  const std::string frames = print("over frames %d to %d", first, last);
  if (need.force < kNoForce * need.weight && need.moment < kNoMoment * need.weight)
    return frames + print(
                        " the reference needs at most %.0f N and %.0f N m from outside: a body could follow "
                        "it, and no way was found",
                        need.force, need.moment);
  return frames + print(
                      " the reference needs up to %.0f N from outside (%.0f %% of the weight, frame %d) and "
                      "%.0f N m (frame %d)",
                      need.force, 100.0 * need.force / need.weight, need.force_frame, need.moment,
                      need.moment_frame);
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
  const int first = std::max(loss.frame - kFramesBefore, 1),
            last = std::min(loss.frame, reference.size() - 2);
  return text + "; " + need_in_words(need_of(reference, first, last), first, last);
}

}  // namespace mimicx::pipeline

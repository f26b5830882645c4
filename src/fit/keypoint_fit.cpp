#include "fit/keypoint_fit.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "fit/camera_smoothing.h"
#include "fit/least_squares/gauss_newton.h"
#include "motion/prepare/bridging.h"

namespace mimicx::fit {
namespace {

constexpr std::size_t kFewestKeypoints = 6;  ///< joints among the keypoints that a fit needs

/// Why the clip cannot be fitted; empty where it can.
std::string reason_to_refuse(const motion::Keypoints& keypoints, const FitProblem& problem) {
  const auto detected = [](const Vector3d& uvc) { return uvc.z() > 0.0; };
  if (std::none_of(keypoints.uvc.begin(), keypoints.uvc.end(),
                   [&](const auto& points) { return std::any_of(points.begin(), points.end(), detected); }))
    return "no keypoint is detected: not fitted";
  if (problem.points.size() < kFewestKeypoints) return "too few keypoints of known joints: not fitted";
  const auto seen = std::count_if(problem.box.begin(), problem.box.end(), [](double b) { return b > 0.0; });
  if (2 * seen < problem.frames()) return "the camera does not see the motion: not fitted";
  return "";
}

/// The clip, its camera smoothed where it trembles.
motion::Clip with_a_calm_camera(const motion::Clip& clip, FitReport& report) {
  motion::Clip calm = clip;
  calm.keypoints->extrinsics = smoothed_path(clip.keypoints->extrinsics, clip.fps);
  if (calm.keypoints->extrinsics != clip.keypoints->extrinsics)
    report.notes.emplace_back("the given camera trembles from frame to frame: smoothed over 0.1 s");
  return calm;
}

}  // namespace

motion::Clip fit_keypoints(const motion::Clip& clip, const FitConfig& config, FitReport* report) {
  FitReport r;
  motion::Clip fitted = clip;
  if (!clip.keypoints) {
    r.notes.emplace_back("no keypoints: not fitted");
  } else {
    motion::require_usable(clip, 3);
    const motion::BridgedClip whole = motion::bridged(clip);
    const motion::Clip calm = with_a_calm_camera(whole.clip, r);
    FitProblem problem = make_problem(calm, config);
    if (const std::string why = reason_to_refuse(*calm.keypoints, problem); !why.empty())
      r.notes.push_back(why);
    else if (motion::Clip found = solved(calm, problem, r); r.fitted)
      fitted = std::move(found);
    r.flagged = whole.flagged;
    r.limb_frames = whole.limb_frames;
  }
  if (report) *report = r;
  return fitted;
}

}  // namespace mimicx::fit

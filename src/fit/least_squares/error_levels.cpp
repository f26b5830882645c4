#include "fit/least_squares/error_levels.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/units.h"
#include "fit/least_squares/projection.h"

namespace mimicx::fit {
namespace {

constexpr double kTail = 4.0;           ///< degrees of freedom of Student's t of a detection's error
constexpr double kPriorCounts = 300.0;  ///< weight of the prior σ, in coordinates of detections
constexpr double kPooledCounts =
    100.0;  ///< weight of the σ of all keypoints in a keypoint's own σ, in coordinates
constexpr double kConfidenceSpread = 0.5;  ///< σ of the prior of the power of the confidence
constexpr double kMostPower = 4.0;

/// Expected square of a keypoint's error in a frame, including the state's uncertainty.
double expected_square(const FitProblem& problem, const FitState& state,
                       const PerFrame<FrameKinematics>& motion, const std::vector<BandSolution>& draws, int t,
                       std::size_t k) {
  const KeypointDerivatives p = keypoint_derivatives(problem, state, motion, t, k);
  double sum = p.seen.error.squaredNorm();
  for (const BandSolution& d : draws)
    sum += (p.by_frame * d.x[t] + p.by_clip * d.g.head<kFirstOffset>() +
            p.by_offset * d.g.segment<kOffsets>(offset_of(k)))
               .squaredNorm() /
           static_cast<double>(draws.size());
  return sum;
}

/// A detection as input of the level estimate.
struct Seen {
  double log_confidence;
  double square;  ///< expected, under the kernel, over σ²
};

std::vector<Seen> seen_of(const FitProblem& problem, const FitState& state,
                          const PerFrame<FrameKinematics>& motion, const std::vector<BandSolution>& draws,
                          const PerFrame<std::vector<double>>& weights, std::size_t k) {
  std::vector<Seen> seen;
  for (int t = 0; t < problem.frames(); ++t)
    if (const double w = weights[t][k]; w > 0.0)
      seen.push_back(
          {log(problem.uvc[t][k].z()), square(w) * expected_square(problem, state, motion, draws, t, k)});
  return seen;
}

/// Sum of expected squares, and the number of coordinates in it.
struct Sum {
  double squares = 0, count = 0;
};

/// Evidence of the detections of a keypoint for the power of the confidence: slope and curvature of the
/// likelihood's logarithm. The mean confidence is left to the keypoint's own σ.
struct Evidence {
  double slope = 0, curvature = 0;
};

void add_evidence(const std::vector<Seen>& seen, Evidence& evidence) {
  double mean = 0.0;
  for (const Seen& s : seen) mean += s.log_confidence / static_cast<double>(seen.size());
  for (const Seen& s : seen) {
    evidence.slope += (s.log_confidence - mean) * (2.0 - s.square);
    evidence.curvature += 2.0 * square(s.log_confidence - mean) * s.square;
  }
}

}  // namespace

double correlation_of(const FitProblem& problem) {
  return pow(problem.config.keypoint_correlation, kReferenceFps / problem.fps);
}

CorrectionLevels correction_levels(const FitProblem& problem) {
  const FitConfig& o = problem.config;
  const double scale = kReferenceFps / problem.fps;
  CorrectionLevels out;
  const auto fill = [&](int at, int count, double size, double rate, double bend, double jitter) {
    out.size.segment(at, count).setConstant(size * std::sqrt(o.prior_frames / scale));
    out.rate.segment(at, count).setConstant(hypot(scale * rate, std::sqrt(2.0) * jitter));
    out.bend.segment(at, count).setConstant(hypot(square(scale) * bend, std::sqrt(6.0) * jitter));
  };
  fill(0, 3, o.root_position_sigma, o.root_rate, o.root_bend, problem.position_jitter);
  const double rate = kDegree * o.joint_rate, bend = kDegree * o.joint_bend;
  fill(kRootRotation, 3, kDegree * o.root_rotation_sigma, rate, bend, problem.rotation_jitter);
  for (int b = 1; b < kBodies; ++b)
    fill(kFirstJoint + first_dof(b), is_hinge(b) ? 1 : 3, kDegree * o.joint_sigma, rate, bend,
         problem.joint_jitter[b]);
  return out;
}

PerFrame<std::vector<double>> detection_weights(const FitProblem& problem, const FitState& state,
                                                const PerFrame<FrameKinematics>& motion) {
  const FitLevels& level = problem.levels;
  PerFrame<std::vector<double>> weights;
  for (int t = 0; t < problem.frames(); ++t) {
    weights.emplace_back(problem.points.size(), 0.0);
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      const double confidence = problem.uvc[t][k].z();
      if (confidence <= 0.0) continue;
      const Projection seen = keypoint_error(problem, state, motion, t, k);
      if (!seen.valid) continue;
      const double plain = pow(confidence, level.confidence_power) / level.keypoint[k];
      const double squares = seen.error.squaredNorm();
      const double kernel = problem.settled ? (kTail + 2.0) / (kTail + square(plain) * squares)
                                            : 1.0 / (1.0 + squares / square(problem.config.keypoint_kernel));
      weights[t][k] = plain * std::sqrt(kernel);
    }
  }
  return weights;
}

FitLevels levels_of(const FitProblem& problem, const FitState& state, const PerFrame<FrameKinematics>& motion,
                    const std::vector<BandSolution>& draws) {
  const FitLevels& before = problem.levels;
  FitLevels levels = before;
  const auto weights = detection_weights(problem, state, motion);
  Evidence evidence;
  std::vector<Sum> sums;
  Sum all{square(problem.config.keypoint_sigma) * kPriorCounts, kPriorCounts};
  List<std::vector<Seen>> of_points(problem.points.size());
  parallel_for(of_points.count(), problem.config.threads, [&](int k) {
    of_points[k] = seen_of(problem, state, motion, draws, weights, static_cast<std::size_t>(k));
  });
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const std::vector<Seen>& seen = of_points[k];
    Sum sum{0.0, 2.0 * static_cast<double>(seen.size())};
    for (const Seen& s : seen) sum.squares += square(before.keypoint[k]) * s.square;
    all.squares += sum.squares, all.count += sum.count;
    sums.push_back(sum);
    add_evidence(seen, evidence);
  }
  const double pooled = all.squares / all.count;
  for (std::size_t k = 0; k < sums.size(); ++k)
    levels.keypoint[k] =
        std::sqrt((sums[k].squares + pooled * kPooledCounts) / (sums[k].count + kPooledCounts));
  const double precision = 1.0 / square(kConfidenceSpread);
  evidence.slope += precision * (problem.config.confidence_power - before.confidence_power);
  levels.confidence_power = std::clamp(
      before.confidence_power + evidence.slope / (evidence.curvature + precision), 0.0, kMostPower);
  return levels;
}

}  // namespace mimicx::fit

#include "pipeline/options/cluster_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/number_text.h"

namespace mimicx::pipeline::options {
namespace {

/// Root-mean-square speeds and accelerations of the body, from its features.
struct Impression {
  double hips = 0;     ///< height of the pelvis, m
  double travel = 0;   ///< horizontal speed of the pelvis, m/s
  double turning = 0;  ///< about the vertical, degrees per second
  double bounce = 0;   ///< vertical speed of the pelvis, m/s
  double feet = 0;     ///< vertical speed of the feet, m/s
  double arms = 0;     ///< speed of the wrists beyond that of the pelvis, m/s
  double effort = 0;   ///< acceleration of the joints, m/s²
};

Impression impression_of(const MotionFeatures& f) {
  const auto squared_speed = [&](std::size_t j) { return f[kPlanarVelocity + j] + f[kVerticalVelocity + j]; };
  Impression i;
  i.hips = f[kRootHeight];
  i.travel = std::sqrt(f[kPlanarVelocity]);
  i.turning = std::sqrt(f[kRootTurning]) * 180.0 / std::numbers::pi;
  i.bounce = std::sqrt(f[kVerticalVelocity]);
  i.feet = std::sqrt(0.5 * (f[kVerticalVelocity + kLeftFoot] + f[kVerticalVelocity + kRightFoot]));
  const double wrists = 0.5 * (squared_speed(kLeftWrist) + squared_speed(kRightWrist));
  i.arms = std::sqrt(std::max(0.0, wrists - squared_speed(kPelvis)));
  double acceleration = 0.0;
  for (std::size_t j = 0; j < kBodies; ++j) acceleration += f[kAcceleration + j] / kBodies;
  i.effort = std::sqrt(acceleration);
  return i;
}

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

/// A quality in which a cluster may exceed all others.
struct Superlative {
  const char* words;
  double Impression::*value;
  double least;  ///< a smaller value is not mentioned, even if it is the largest
};
constexpr std::array<Superlative, 6> kSuperlatives = {{
    {"the fastest", &Impression::travel, 0.5},
    {"turns most", &Impression::turning, 45.0},
    {"goes up and down most", &Impression::bounce, 0.2},
    {"lifts the feet most", &Impression::feet, 0.2},
    {"the busiest arms", &Impression::arms, 0.4},
    {"the most vigorous", &Impression::effort, 3.0},
}};
constexpr double kStandsOut = 1.2;  ///< the largest value is named where it is this many times the next one

}  // namespace

std::string describe_motion(const MotionFeatures& features) {
  const Impression i = impression_of(features);
  std::vector<std::string> words;
  words.push_back(i.effort < 1.5 ? "calm" : i.effort < 6.0 ? "lively" : "vigorous");
  words.push_back(formatted(i.hips < 0.4   ? "close to the floor (hips at %.2f m)"
                            : i.hips < 0.8 ? "low (hips at %.2f m)"
                                           : "upright (hips at %.2f m)",
                            i.hips));
  words.push_back(i.travel < 0.2 ? "stays in place" : formatted("moves about at %.1f m/s", i.travel));
  if (i.turning >= 45.0) words.push_back(formatted("turns (%.0f degrees/s)", i.turning));
  if (i.bounce >= 0.25) words.push_back(i.bounce < 0.6 ? "rises and sinks" : "leaps or drops");
  words.push_back(i.feet < 0.05 ? "feet stay down" : i.feet < 0.3 ? "steps" : "feet swing high");
  words.push_back(i.arms < 0.25 ? "arms quiet" : i.arms < 0.9 ? "arms move" : "arms busy");
  return join(words);
}

std::string describe_cluster(const List<MotionFeatures>& centres, int cluster) {
  const Impression mine = impression_of(centres[cluster]);
  std::vector<std::string> words;
  for (const Superlative& s : kSuperlatives) {
    double next = 0.0;
    for (int c = 0; c < centres.count(); ++c)
      if (c != cluster) next = std::max(next, impression_of(centres[c]).*s.value);
    if (mine.*s.value >= std::max(s.least, kStandsOut * next)) words.push_back(s.words);
  }
  const std::string standing_out = centres.size() > 1 && !words.empty() ? "; of all " + join(words) : "";
  return describe_motion(centres[cluster]) + standing_out;
}

}  // namespace mimicx::pipeline::options

#include "import/evidence/up_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/quantile.h"
#include "import/evidence/falls.h"
#include "import/world_transform.h"

namespace mimicx::import {
namespace {

constexpr std::string_view kDirections = "yzxYXZ";  ///< equal sums: the first one

/// Kinds of evidence, and what the user reads of each.
enum Kind { kCustom, kStands, kSteady, kLevel, kAtRest, kFalls, kFloorAtZero, kBalanced, kRestPose, kKinds };
constexpr std::array<const char*, kKinds> kWords = {"usual for the format",
                                                    "the body stands along it",
                                                    "the lowest points stay at one height",
                                                    "the body does not travel along it",
                                                    "what is lowest is at rest",
                                                    "the body falls along it",
                                                    "the floor is at 0",
                                                    "the body is balanced over its lowest points",
                                                    "the rest pose stands along it"};
using Evidence = Array<double, kKinds>;

// Log-likelihoods; lengths in lengths of the leg.
constexpr double kOfCustom = 2.0, kOfCameras = -1.5, kOfOthers = -3.0;
constexpr double kOfStanding = 3.8, kOfHeadDown = -1.0;
constexpr double kOfSteady = -2.0, kUnsteady = 0.5;
constexpr double kOfTravel = -4.0, kHighest = 0.7, kTravels = 0.6;
constexpr double kOfMovingSupport = -1.5, kMoves = 0.003;  ///< the body moves, a frame
constexpr double kOfFall = 3.0;
constexpr double kOfFloorAtZero = 1.5, kNearZero = 0.2;
constexpr double kOfBalance = 1.5, kSupports = 0.08, kOverSupport = 0.15;
constexpr double kOfRestPose = 1.0;
constexpr std::size_t kBalancedFrames = 60;  ///< that are looked at

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double length = (b - a).squaredNorm();
  const double along = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (a + along * (b - a) - p).norm();
}

/// Whether a point is inside a triangle; all of them in a plane with this normal.
bool is_inside(const Vector3d& p, const std::array<Vector3d, 3>& corners, const Vector3d& normal) {
  int sides = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& a = corners[i];
    sides += (corners[(i + 1) % 3] - a).cross(p - a).dot(normal) >= 0.0 ? 1 : -1;
  }
  return sides == 3 || sides == -3;
}

/// Whether the centre of mass is over the lowest bodies.
bool is_balanced(const PerBody<Vector3d>& p, const Vector3d& center, const Vector3d& up) {
  const double floor = lowest_of(p, up).second;
  const auto flat = [&](const Vector3d& v) { return Vector3d(v - v.dot(up) * up); };
  std::vector<Vector3d> support;
  for (int b = 0; b < kBodies; ++b)
    if (p[b].dot(up) - radius_of(b) < floor + kSupports) support.push_back(flat(p[b]));
  const Vector3d over = flat(center);
  for (std::size_t i = 0; i < support.size(); ++i)
    for (std::size_t j = i; j < support.size(); ++j) {
      if (distance_to_segment(over, support[i], support[j]) < kOverSupport) return true;
      for (std::size_t k = j + 1; k < support.size(); ++k)
        if (i < j && is_inside(over, {support[i], support[j], support[k]}, up)) return true;
    }
  return false;
}

double custom_of(char axis, char custom) {
  if (axis == custom) return kOfCustom;
  if (axis == 'y' || axis == 'z') return 0.0;
  return axis == 'Y' ? kOfCameras : kOfOthers;
}

Evidence evidence_of(const RoughBody& body, char axis, char custom, const std::optional<Landmarks>& rest) {
  const Vector3d up = rotation_to_z_up(axis).conjugate() * Vector3d::UnitZ();
  const int frames = body.p.count();
  Evidence e{};
  e[kCustom] = custom_of(axis, custom);
  double stands = 0.0;
  std::vector<double> lowest, heights, support_speed;
  for (int t = 0; t < frames; ++t) {
    const auto& p = body.p[t];
    stands +=
        (p[kLeftShoulder] + p[kRightShoulder] - p[kLeftAnkle] - p[kRightAnkle]).normalized().dot(up) / frames;
    const auto [low, height] = lowest_of(p, up);
    lowest.push_back(height);
    heights.push_back(body.center[t].dot(up));
    if (t > 0) support_speed.push_back((p[low] - body.p[t - 1][low]).norm());
  }
  e[kStands] = stands > 0.0 ? kOfStanding * stands : -kOfHeadDown * stands;
  e[kSteady] = kOfSteady * std::min(1.0, (quantile(lowest, 0.9) - quantile(lowest, 0.1)) / kUnsteady);
  const double rises = quantile(heights, 0.95) - quantile(heights, 0.05);
  e[kLevel] = kOfTravel * std::clamp((rises - kHighest) / kTravels, 0.0, 1.0);
  if (body.speed > kMoves) e[kAtRest] = kOfMovingSupport * std::min(1.0, median(support_speed) / body.speed);
  const double floor = quantile(lowest, 0.05);
  e[kFalls] = kOfFall * std::min(1.0, 0.7 * static_cast<double>(falls_along(body, lowest, up).size()));
  e[kFloorAtZero] = std::abs(floor) < kNearZero ? kOfFloorAtZero : 0.0;
  const int step = std::max(1, frames / static_cast<int>(kBalancedFrames));
  int looked = 0, balanced = 0;
  for (int t = 0; t < frames; t += step, ++looked) balanced += is_balanced(body.p[t], body.center[t], up);
  e[kBalanced] = kOfBalance * balanced / looked;
  if (rest && is_stance(*rest)) e[kRestPose] = kOfRestPose * std::max(0.0, rest->trunk().dot(up));
  return e;
}

double sum_of(const Evidence& e) {
  double sum = 0.0;
  for (const double part : e) sum += part;
  return sum;
}

}  // namespace

std::string near_up_warning(const UpDecision& decision) {
  return "the up axis, " + axis_name(decision.axis) + ", is not sure: " + axis_name(decision.second) +
         " is nearly as likely (--up " + axis_name(decision.second) + ")";
}

UpDecision decide_up(const PerFrame<Landmarks>& poses, const std::optional<Landmarks>& rest, char custom) {
  const RoughBody body = rough_body_of(poses);
  std::vector<std::pair<char, Evidence>> order;
  for (const char axis : kDirections) order.emplace_back(axis, evidence_of(body, axis, custom, rest));
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return sum_of(a.second) > sum_of(b.second); });
  const auto& [best, second] = std::pair(order[0], order[1]);
  UpDecision out;
  out.axis = best.first;
  out.second = second.first;
  out.lead = sum_of(best.second) - sum_of(second.second);
  constexpr double kWorthSaying = 0.5, kUpright = 1.2;
  if (best.second[kStands] < kUpright) out.why = "the body lies, crawls or turns over";
  for (int kind = 0; kind < kKinds; ++kind)
    if (best.second[kind] - second.second[kind] > kWorthSaying)
      out.why += (out.why.empty() ? "" : "; ") + std::string(kWords[static_cast<std::size_t>(kind)]);
  return out;
}

}  // namespace mimicx::import

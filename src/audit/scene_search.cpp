#include "audit/scene_search.h"

#include <algorithm>
#include <cmath>

#include "audit/friction_cones.h"
#include "audit/pose_needs.h"
#include "core/elementary.h"
#include "core/number_text.h"
#include "core/quantile.h"
#include "core/units.h"

namespace mimicx::audit {
namespace {

constexpr double kSlow = 0.3;          // of a standing foot and of the hips, m/s
constexpr double kSpeedSpan = 0.067;   // speeds are means over twice this, s
constexpr double kStands = 0.13;       // s
constexpr double kSits = 0.3;          // s
constexpr double kLowestPlate = 0.09;  // m; heights of estimated motions wander by less
constexpr double kSameHeight = 0.07;   // of the feet on one plate, m
constexpr int kFlight = 3;             // steps of equal rises, or more
constexpr double kUnequalRise = 0.05;  // of an estimated step from its place in such a flight, m
constexpr double kSameSeat = 0.4;      // from its middle to that of another one, m
constexpr double kRises = 0.15;        // of a standing foot, m/s
constexpr double kLevelSole = 0.5;     // vertical part of its normal
constexpr double kSamePlace = 0.08;    // of a foot that has not stepped, m
constexpr double kSameStep = 0.4;      // from its middle to where feet stand on it again, m
constexpr double kLeastHalf = 0.05;    // of a plate's side, m
constexpr double kReach = 0.03;        // a point so far over the ground touches it, m
constexpr double kMissing = 0.15;      // W
constexpr double kOnOneFoot = 0.7;     // share of a step's frames in which less may be missing
constexpr double kSeatMissing = 0.06, kSeatExplained = 0.03;  // W
constexpr double kExplained = 0.10;                           // W
constexpr double kCarries = 0.6;                              // of a step, W
constexpr double kRemains = 0.3;                              // of what is missing without a step
constexpr double kMargin = 0.06,
                 kStepAside = 0.15;   // of a plate beyond the points that use it; of a step to the sides, m
constexpr double kLevelThigh = 0.55;  // largest sine of its slope
constexpr double kLowestSeat = 0.20;  // m
constexpr double kWindow = 0.2;       // of the needs, s
constexpr double kCushion = 3e4, kCushionDamping = 1.2e3;  // of a seat and flesh, N/m, N·s/m

/// Points that push together while a foot stands or hips rest.
struct Stance {
  int first, last;          ///< frames
  std::vector<int> points;  ///< indices of contact points
  double height;            ///< m
};

/// The motion as the search looks at it.
class SupportedMotion {
 public:
  explicit SupportedMotion(const motion::Clip& clip)
      : c_(motion::character_of(clip)), poses_(motion::poses_of(clip)), fps_(clip.fps) {
    for (const BodyPoses& pose : poses_) {
      place_.emplace_back();
      for (const ContactPoint& point : c_.contact_points)
        place_.back().push_back(lowest_position(point, pose));
    }
    PoseNeedsConfig needs;
    needs.window = kWindow;
    wanted_ = wanted_wrenches(c_, poses_, fps_, needs);
  }

  const Character& character() const { return c_; }
  int frames() const { return poses_.count(); }
  double fps() const { return fps_; }
  const BodyPoses& poses(int t) const { return poses_[t]; }
  const Vector3d& place(int t, int point) const { return place_[t][point]; }
  double weight() const { return kGravity * c_.total_mass(); }

  /// Mean speed around frame t, m/s.
  double speed(int t, int point) const {
    const int a = std::max(0, t - away()), b = std::min(frames() - 1, t + away());
    return (place_[b][point] - place_[a][point]).norm() * fps_ / (b - a);
  }
  double lowest_of(int t, const std::vector<int>& points) const {
    double z = HUGE_VAL;
    for (const int i : points) z = std::min(z, place_[t][i].z());
    return z;
  }

  /// Median height of the points of a sole, m: the ball's, whatever the foot's pitch or a raised heel.
  double sole_height(int t, const std::vector<int>& points) const {
    std::vector<double> z;
    for (const int i : points) z.push_back(place_[t][i].z());
    return median(z);
  }

  bool level(int t, int foot) const {
    return (poses_[t].q_WB[kLeftAnkle + foot] * Vector3d::UnitY()).z() > kLevelSole;
  }

  /// Mean vertical speed of the lowest of the points around frame t, m/s.
  double rise(int t, const std::vector<int>& points) const {
    const int a = std::max(0, t - away()), b = std::min(frames() - 1, t + away());
    return (lowest_of(b, points) - lowest_of(a, points)) * fps_ / (b - a);
  }

  struct Rest {
    double missing;  ///< W
    double carried;  ///< upward force of the asked points, W
  };
  /// What is missing at frame t if points at most kReach over `floor` push, and `others`.
  /// @param asked  indices whose load is returned
  Rest rest(int t, double floor, std::vector<int> others, const std::vector<int>& asked = {}) const {
    for (int i = 0; i < c_.contact_points.count(); ++i)
      if (place_[t][i].z() < floor + kReach) others.push_back(i);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    List<Push> pushes;
    for (const int i : others) pushes.push_back({c_.contact_points[i].body, place_[t][i], Vector3d::Zero()});
    const Vector6d left = fit_cone_forces({}, center_of_mass(c_, poses_[t]), wanted_[t], pushes);
    Rest rest{left.norm() / weight(), 0.0};
    for (int k = 0; k < pushes.count(); ++k)
      if (std::find(asked.begin(), asked.end(), others[static_cast<std::size_t>(k)]) != asked.end())
        rest.carried += pushes[k].force.z() / weight();
    return rest;
  }

 private:
  int away() const { return std::max(1, static_cast<int>(std::lround(kSpeedSpan * fps_))); }
  Character c_;
  PerFrame<BodyPoses> poses_;
  double fps_;
  PerFrame<List<Vector3d>> place_;
  PerFrame<Vector6d> wanted_;
};

std::vector<int> foot_points(int foot) {
  std::vector<int> points;
  for (int i = 0; i < kPointsPerFoot; ++i) points.push_back(foot * kPointsPerFoot + i);
  return points;
}

/// Calls visit(first, last) for every run of frames that are `on`, at least `seconds` long.
template <class Visit>
void for_each_run(const PerFrame<bool>& on, double fps, double seconds, const Visit& visit) {
  for (int t = 0; t < on.count(); ++t) {
    if (!on[t]) continue;
    const int first = t;
    while (t + 1 < on.count() && on[t + 1]) ++t;
    if ((t - first + 1) / fps >= seconds) visit(first, t);
  }
}

/// Standing feet, in order of time. A foot stands where two of its points are slow.
std::vector<Stance> stances(const SupportedMotion& e) {
  std::vector<Stance> found;
  for (int foot = 0; foot < 2; ++foot) {
    const std::vector<int> points = foot_points(foot);
    PerFrame<bool> stands(static_cast<std::size_t>(e.frames()), false);
    for (int t = 0; t < e.frames(); ++t)
      stands[t] =
          std::abs(e.rise(t, points)) < kRises && e.level(t, foot) &&
          std::count_if(points.begin(), points.end(), [&](int i) { return e.speed(t, i) < kSlow; }) >= 2;
    for_each_run(stands, e.fps(), kStands, [&](int first, int last) {
      std::vector<double> heights;
      for (int t = first; t <= last; ++t) heights.push_back(e.sole_height(t, points));
      found.push_back({first, last, points, median(heights)});
    });
  }
  std::sort(found.begin(), found.end(), [](const Stance& a, const Stance& b) {
    return a.first != b.first ? a.first < b.first : a.points < b.points;
  });
  return found;
}

/// How much higher the left foot of an estimate is than the right one, from the frames in which both stand at
/// nearly one height, m; 0 without such frames.
double left_over_right(const SupportedMotion& e, const std::vector<Stance>& all) {
  std::vector<double> differences;
  for (const Stance& left : all)
    for (const Stance& right : all)
      if (left.points.front() == 0 && right.points.front() != 0)
        for (int t = std::max(left.first, right.first); t <= std::min(left.last, right.last); ++t) {
          const double difference = e.sole_height(t, left.points) - e.sole_height(t, right.points);
          if (std::abs(difference) < kSameHeight) differences.push_back(difference);
        }
  return differences.empty() ? 0.0 : median(differences);
}

/// The stances of one plate.
using Group = std::vector<Stance>;

double group_height(const Group& group) {
  std::vector<double> heights;
  for (const Stance& stance : group) heights.push_back(stance.height);
  return median(heights);
}

/// Where the ball of the foot stands, m.
Eigen::Vector2d place_of(const SupportedMotion& e, const Stance& stance) {
  return e.place((stance.first + stance.last) / 2, stance.points[2]).head<2>();
}

Eigen::Vector2d mean_place_of(const SupportedMotion& e, const Group& group) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Stance& stance : group) sum += place_of(e, stance);
  return sum / static_cast<double>(group.size());
}

/// Whether the foot that stands longest stands lower at another time without having stepped: the estimate
/// drifts.
bool drifts(const SupportedMotion& e, const std::vector<Stance>& all, const Group& group) {
  const Stance& longest = *std::max_element(group.begin(), group.end(), [](const Stance& a, const Stance& b) {
    return a.last - a.first < b.last - b.first;
  });
  return std::any_of(all.begin(), all.end(), [&](const Stance& other) {
    return other.points == longest.points && other.height < longest.height - kSameHeight &&
           (place_of(e, other) - place_of(e, longest)).norm() < kSamePlace;
  });
}

std::vector<Group> raised_groups(const std::vector<Stance>& all, double floor) {
  std::vector<Group> groups;
  bool broken = true;  // by a foot at another height
  for (const Stance& stance : all) {
    if (stance.height < floor + kLowestPlate) continue;
    if (!groups.empty() && std::abs(stance.height - group_height(groups.back())) < kSameHeight)
      broken = std::any_of(all.begin(), all.end(), [&](const Stance& between) {
        return between.first > groups.back().back().last && between.last < stance.first &&
               std::abs(between.height - stance.height) >= kSameHeight;
      });
    else
      broken = true;
    if (broken) groups.emplace_back();
    groups.back().push_back(stance);
  }
  return groups;
}

/// The points of the stances of all groups but `left_out` that push at frame t.
std::vector<int> pushing(const std::vector<Group>& groups, int t, const Group* left_out = nullptr) {
  std::vector<int> points;
  for (const Group& group : groups)
    if (&group != left_out)
      for (const Stance& stance : group)
        if (t >= stance.first && t <= stance.last)
          points.insert(points.end(), stance.points.begin(), stance.points.end());
  return points;
}

/// Every second frame of the stances, each once; not the first and last two frames of the motion, whose
/// accelerations are unknown.
std::vector<int> frames_of(const Group& group, int frames) {
  std::vector<int> list;
  for (const Stance& stance : group)
    for (int t = std::max(2, stance.first); t <= std::min(frames - 3, stance.last); t += 2) list.push_back(t);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

/// The rectangle under the points of the stances, its first side along `ahead`. @param aside  margin to the
/// sides, m
Plate plate_under(const SupportedMotion& e, const Group& group, const Eigen::Vector2d& ahead, double height,
                  double aside) {
  const Eigen::Vector2d along = ahead.normalized(), across(-along.y(), along.x());
  Eigen::Vector2d low(HUGE_VAL, HUGE_VAL), high = -low;
  for (const Stance& stance : group)
    for (int t = stance.first; t <= stance.last; ++t)
      for (const int i : stance.points) {
        const Eigen::Vector2d p = e.place(t, i).head<2>(), at(p.dot(along), p.dot(across));
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
      }
  const Eigen::Vector2d middle = 0.5 * (low + high);
  Plate plate;
  plate.centre = middle.x() * along + middle.y() * across;
  plate.yaw = atan2(along.y(), along.x());
  plate.half_extents = 0.5 * (high - low) + Eigen::Vector2d(kMargin, aside);
  plate.height = height;
  return plate;
}

/// Takes away from a plate what is on the other side of a point of it, on the side where that is least.
void cut_at(const Eigen::Vector2d& point, Plate& plate) {
  const Eigen::Rotation2Dd turn(plate.yaw);
  const Eigen::Vector2d from = turn.inverse() * (point - plate.centre);
  const Eigen::Vector2d behind = plate.half_extents - from.cwiseAbs();
  const int axis = behind.x() < behind.y() ? 0 : 1;
  const double cut =
      std::clamp(0.5 * behind[axis], 0.0, std::max(0.0, plate.half_extents[axis] - kLeastHalf));
  plate.half_extents[axis] -= cut;
  plate.centre -= turn * (std::copysign(cut, from[axis]) * Eigen::Vector2d::Unit(axis));
}

/// Where a foot stands lower, the margin of a step is too wide.
void cut_where_feet_stand_lower(const SupportedMotion& e, const std::vector<Stance>& all, double floor,
                                Plate& plate) {
  for (const Stance& stance : all)
    if (stance.height < floor + plate.height - kSameHeight)
      for (int t = stance.first; t <= stance.last; ++t)
        for (const int i : stance.points)
          if (plate.spans(e.place(t, i))) cut_at(e.place(t, i).head<2>(), plate);
}

/// Direction in which the feet of the stances point.
Eigen::Vector2d toes_of(const SupportedMotion& e, const Group& group) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Stance& s : group)
    for (int t = s.first; t <= s.last; ++t)
      sum += (e.place(t, s.points[4]) - e.place(t, s.points[0])).head<2>();
  return sum;
}

std::string plate_in_words(const char* what, double height, const char* under, int first, int last,
                           double carried) {
  return formatted("a %s of %.2f m under the %s, frames %d to %d: %.2f of the weight", what, height, under,
                   first, last, carried);
}

/// The steps of a flight rise equally (building codes allow a centimetre between them), which says more of
/// their heights than an estimate does. Heights over the floor that may be r, 2 r, 3 r … become so, with r by
/// least squares.
/// @param heights  of the steps, m, in any order; more than one step may have a height
void make_rises_equal(std::vector<double>& heights) {
  std::vector<double> sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> levels;  // of the heights, 1 for the lowest
  for (const double height : heights) {
    levels.push_back(1);
    for (std::size_t i = 1; i < sorted.size() && sorted[i] <= height; ++i)
      levels.back() += sorted[i] - sorted[i - 1] > kSameHeight;
  }
  if (levels.empty() || *std::max_element(levels.begin(), levels.end()) < kFlight) return;
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    sum += levels[k] * heights[k];
    squares += levels[k] * levels[k];
  }
  std::vector<double> equal;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    equal.push_back(levels[k] * (sum / squares));
    if (std::abs(heights[k] - equal.back()) > kUnequalRise) return;
  }
  heights = equal;
}

/// @param all  stances
void find_steps(const SupportedMotion& e, const std::vector<Stance>& all, FoundScene& found,
                std::vector<Group>& accepted) {
  const std::vector<Group> groups = raised_groups(all, found.floor);
  std::vector<double> loads, heights;
  for (const Group& group : groups) {
    std::vector<double> without, with, carried;
    std::vector<int> points;
    for (const Stance& stance : group)
      points.insert(points.end(), stance.points.begin(), stance.points.end());
    for (const int t : frames_of(group, e.frames())) {
      without.push_back(e.rest(t, found.floor, pushing(groups, t, &group)).missing);
      const SupportedMotion::Rest rest = e.rest(t, found.floor, pushing(groups, t), points);
      with.push_back(rest.missing);
      carried.push_back(rest.carried);
    }
    if (without.empty() || drifts(e, all, group)) continue;
    const double missing = quantile(without, kOnOneFoot), remains = median(with), load = median(carried);
    if (missing < kMissing || remains > std::max(kExplained, kRemains * missing) || load < kCarries) continue;
    const auto again = std::find_if(accepted.begin(), accepted.end(), [&](const Group& other) {
      return std::abs(group_height(other) - group_height(group)) < kSameHeight &&
             (mean_place_of(e, other) - mean_place_of(e, group)).norm() < kSameStep;
    });
    if (again != accepted.end()) {
      again->insert(again->end(), group.begin(), group.end());
      heights[static_cast<std::size_t>(again - accepted.begin())] = group_height(*again) - found.floor;
      continue;
    }
    accepted.push_back(group);
    heights.push_back(group_height(group) - found.floor);
    loads.push_back(load);
  }
  make_rises_equal(heights);
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    const Group& group = accepted[k];
    Plate plate = plate_under(e, group, toes_of(e, group), heights[k], kStepAside);
    cut_where_feet_stand_lower(e, all, found.floor, plate);
    found.scene.plates.push_back(plate);
    int last = 0;
    bool left = false, right = false;
    for (const Stance& stance : group) {
      last = std::max(last, stance.last);
      (stance.points.front() == 0 ? left : right) = true;
    }
    found.words.push_back(plate_in_words("step", heights[k],
                                         left && right ? "feet"
                                         : left        ? "left foot"
                                                       : "right foot",
                                         group.front().first, last, loads[k]));
  }
}

/// Whether someone may sit at frame t: hips slow, thighs nearly level.
bool may_sit(const SupportedMotion& e, int t, const std::vector<int>& seat, double floor) {
  for (int side = 0; side < 2; ++side) {
    const Vector3d thigh = e.poses(t).p_WB[kLeftKnee + side] - e.poses(t).p_WB[kLeftHip + side];
    if (std::abs(thigh.z()) > kLevelThigh * thigh.norm()) return false;
  }
  if (e.lowest_of(t, seat) < floor + kLowestSeat) return false;
  return std::all_of(seat.begin(), seat.end(), [&](int i) { return e.speed(t, i) < kSlow; });
}

void find_seats(const SupportedMotion& e, const std::vector<Group>& steps, FoundScene& found) {
  std::vector<int> seat, hips, thighs;
  for (int i = kFootPoints; i < e.character().contact_points.count(); ++i) {
    const int body = e.character().contact_points[i].body;
    if (body == kPelvis) hips.push_back(i);
    if (body == kLeftHip || body == kRightHip) thighs.push_back(i);
    if (body == kPelvis || body == kLeftHip || body == kRightHip) seat.push_back(i);
  }
  const auto feet_and = [&](int t, std::vector<int> points) {
    for (int i = 0; i < kFootPoints; ++i)
      if (e.place(t, i).z() < found.floor + kLowestPlate) points.push_back(i);
    for (const int i : pushing(steps, t)) points.push_back(i);
    return points;
  };
  // An estimate wanders up and down as a whole: a seat is as high as the hips are over standing feet.
  const auto ground_at = [&](int t) {
    const double feet = 0.5 * (e.sole_height(t, foot_points(0)) + e.sole_height(t, foot_points(1)));
    return feet < found.floor + kLowestPlate ? feet : found.floor;
  };
  PerFrame<bool> sits(static_cast<std::size_t>(e.frames()), false);
  for (int t = 0; t < e.frames(); ++t) sits[t] = may_sit(e, t, seat, found.floor) && !feet_and(t, {}).empty();
  for_each_run(sits, e.fps(), kSits, [&](int first, int last) {
    std::vector<double> without, with, carried, heights;
    Eigen::Vector2d ahead = Eigen::Vector2d::Zero();
    for (int t = first; t <= last; ++t) {
      const SupportedMotion::Rest rest = e.rest(t, found.floor, feet_and(t, seat), seat);
      with.push_back(rest.missing);
      carried.push_back(rest.carried);
      without.push_back(e.rest(t, found.floor, feet_and(t, {})).missing);
      heights.push_back(0.5 * (e.lowest_of(t, hips) + e.lowest_of(t, thighs)) - ground_at(t));
      for (int side = 0; side < 2; ++side)
        ahead += (e.poses(t).p_WB[kLeftKnee + side] - e.poses(t).p_WB[kLeftHip + side]).head<2>();
    }
    if (median(without) < kSeatMissing || median(with) > kSeatExplained) return;
    const double height = median(heights);
    Plate plate = plate_under(e, {{first, last, seat, height}}, ahead, height, kMargin);
    plate.stiffness = kCushion;
    plate.damping = kCushionDamping;
    plate.height += plate.give();  // the body lies in it
    for (const Plate& other : found.scene.plates)
      if (other.stiffness == kCushion && std::abs(other.height - plate.height) < kSameHeight &&
          (other.centre - plate.centre).norm() < kSameSeat)
        return;  // the same seat once more
    found.scene.plates.push_back(plate);
    found.words.push_back(plate_in_words("seat", plate.height, "pelvis", first, last, median(carried)));
  });
}

}  // namespace

FoundScene find_scene(const motion::Clip& clip) {
  motion::require_usable(clip, 3);
  const SupportedMotion e(clip);
  FoundScene found;
  std::vector<double> lowest;
  std::vector<Stance> all = stances(e);
  const double uneven = left_over_right(e, all);
  for (Stance& stance : all) stance.height -= (stance.points.front() == 0 ? 0.5 : -0.5) * uneven;
  for (const Stance& stance : all) lowest.push_back(stance.height);
  if (lowest.empty())
    for (int t = 0; t < e.frames(); ++t)
      lowest.push_back(std::min(e.lowest_of(t, foot_points(0)), e.lowest_of(t, foot_points(1))));
  const double least = *std::min_element(lowest.begin(), lowest.end());
  std::erase_if(lowest, [&](double height) { return height > least + kSameHeight; });
  found.floor = clip.on_floor ? 0.0 : median(lowest);
  std::vector<Group> steps;
  find_steps(e, all, found, steps);
  find_seats(e, steps, found);
  return found;
}

}  // namespace mimicx::audit

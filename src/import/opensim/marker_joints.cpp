#include "import/opensim/marker_joints.h"

#include <cmath>
#include <limits>

#include "character/character.h"
#include "core/quantile.h"
#include "import/evidence/length_unit.h"
#include "import/evidence/up_axis.h"
#include "import/joint_positions.h"
#include "import/opensim/functional_axis.h"
#include "import/opensim/marker_names.h"
#include "import/plausibility.h"
#include "import/world_transform.h"

namespace mimicx::import {
namespace {

Track middle(const Track& a, const Track& b) {
  Track between;
  for (int t = 0; t < a.count(); ++t) between.push_back(0.5 * (a[t] + b[t]));
  return between;
}

Track mean_of_tracks(const std::vector<Track>& tracks) {
  Track mean(tracks[0].count(), Vector3d::Zero());
  for (const Track& track : tracks)
    for (int t = 0; t < mean.count(); ++t) mean[t] += track[t] / static_cast<double>(tracks.size());
  return mean;
}

double mean_distance(const Track& a, const Track& b) {
  double sum = 0.0;
  for (int t = 0; t < a.count(); ++t) sum += (a[t] - b[t]).norm();
  return sum / static_cast<double>(a.size());
}

/// The direction of a vector's part across a unit vector.
Vector3d direction_across(const Vector3d& v, const Vector3d& axis) {
  return (v - v.dot(axis) * axis).normalized();
}

/// Columns: to the left, up, forward; up is exact.
Matrix3d axes_of(const Vector3d& left, const Vector3d& up) {
  Matrix3d axes;
  axes.col(1) = up.normalized();
  axes.col(0) = direction_across(left, axes.col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// The point of a line that moves with it, in the middle of where each frame wants it.
/// @param wanted  how far along the line, m, of a frame; not finite: nowhere
Track on_line(const JointLine& line, const auto& wanted) {
  std::vector<double> along;
  for (int t = 0; t < line.point.count(); ++t)
    if (const double s = wanted(t); std::isfinite(s)) along.push_back(s);
  const double s = along.empty() ? 0.0 : median(along);
  Track points;
  for (int t = 0; t < line.point.count(); ++t) points.push_back(line.point[t] + s * line.direction[t]);
  return points;
}

/// The joints of a person; those of a side at left + side.
class Joints {
 public:
  explicit Joints(const Markers& markers) : named_(markers), frames_(markers.tracks[0].count()) {
    find_pelvis();
    for (int side = 0; side < 2; ++side) {
      find_foot(side);
      find_leg(side);
      find_arm(side);
    }
    find_trunk();
  }

  const NamedMarkers& named() const { return named_; }
  PerBody<Track> p;
  Array<std::string, 2> knees, ankles;  ///< how each side's was found

 private:
  void find_pelvis() {
    const Track &left = named_.one(kAsis, 0), &right = named_.one(kAsis, 1), front = middle(left, right);
    const bool sacrum = !(named_.has(kPsis, 0) && named_.has(kPsis, 1)) && named_.has(kSacrum, 0);
    const Track back = sacrum ? named_.one(kSacrum, 0) : middle(named_.one(kPsis, 0), named_.one(kPsis, 1));
    const double width = mean_distance(left, right), depth = mean_distance(front, back);
    const double forward = -0.24 * depth - 0.0099, up = -0.30 * width - 0.0109, out = 0.33 * width + 0.0073;
    for (int t = 0; t < frames_; ++t) {
      Matrix3d axes;
      axes.col(0) = (left[t] - right[t]).normalized();
      axes.col(2) = direction_across(front[t] - back[t], axes.col(0));
      axes.col(1) = axes.col(2).cross(axes.col(0));
      p[kLeftHip].push_back(front[t] + axes * Vector3d(out, up, forward));
      p[kRightHip].push_back(front[t] + axes * Vector3d(-out, up, forward));
      across_.push_back(axes.col(0));
    }
  }

  void find_foot(int side) {
    const bool first = named_.has(kFirstToe, side);
    const Track& toe = first ? named_.one(kFirstToe, side) : named_.one(kToe, side);
    p[kLeftFoot + side] = named_.has(kFifthToe, side) ? middle(toe, named_.one(kFifthToe, side)) : toe;
  }

  /// The line through a lateral marker, or the functional axis of what is above and below the joint.
  /// @param how  gets the way in words
  JointLine line_of(Landmark marker, int side, const std::vector<Track>& above,
                    const std::vector<Track>& below, const char* expected, std::string& how) const {
    if (named_.has(marker, side)) {
      how = "from the lateral marker inwards";
      return {named_.one(marker, side), across_};
    }
    how = "on the functional axis (Ehrig et al. 2007)";
    const auto axis = functional_axis(above, below);
    if (!axis) named_.fail(marker, side, std::string(side == 0 ? "left " : "right ") + expected);
    return *axis;
  }

  void find_leg(int side) {
    const std::vector<Track>& shank = named_.all(kShankMarker, side);
    const Track &hip = p[kLeftHip + side], &ball = p[kLeftFoot + side];
    Track &knee = p[kLeftKnee + side], &ankle = p[kLeftAnkle + side];
    if (named_.has(kMedialAnkle, side)) {
      ankle = middle(named_.one(kAnkleMarker, side), named_.one(kMedialAnkle, side));
      ankles[side] = "in the middle of the malleoli";
    } else {
      const Track& heel = named_.one(kHeel, side);
      std::vector<Track> foot = {heel};
      for (const Landmark toe : {kFirstToe, kFifthToe, kToe})
        for (const Track& track : named_.all(toe, side))
          if (foot.size() < 3) foot.push_back(track);
      const JointLine line =
          line_of(kAnkleMarker, side, shank, foot,
                  "ankle: a marker, or three of the shank and of the foot while it turns", ankles[side]);
      ankle = on_line(line, [&](int t) {
        const Vector3d normal = (ball[t] - heel[t]).cross(hip[t] - heel[t]).normalized();
        const double slope = line.direction[t].dot(normal);
        return std::abs(slope) > 0.5 ? (heel[t] - line.point[t]).dot(normal) / slope
                                     : std::numeric_limits<double>::quiet_NaN();
      });
    }
    if (named_.has(kMedialKnee, side)) {
      knee = middle(named_.one(kKneeMarker, side), named_.one(kMedialKnee, side));
      knees[side] = "in the middle of the epicondyles";
      return;
    }
    const JointLine line =
        line_of(kKneeMarker, side, named_.all(kThighMarker, side), shank,
                "knee: a marker, or three of the thigh and of the shank while it bends", knees[side]);
    knee = on_line(line, [&](int t) {
      const Vector3d leg = ankle[t] - hip[t], to_point = line.point[t] - hip[t];
      const Vector3d aside = leg * (to_point.dot(leg) / leg.squaredNorm()) - to_point;
      return aside.dot(line.direction[t]);
    });
  }

  Track middle_of(Landmark marker, Landmark medial, int side) const {
    const Track& track = named_.one(marker, side);
    return named_.has(medial, side) ? middle(track, named_.one(medial, side)) : track;
  }

  void find_arm(int side) {
    p[kLeftElbow + side] = middle_of(kElbowMarker, kMedialElbow, side);
    p[kLeftWrist + side] = middle_of(kWristMarker, kMedialWrist, side);
  }

  void find_trunk() {
    const Track &left = named_.one(kShoulderMarker, 0), &right = named_.one(kShoulderMarker, 1);
    const double below = 0.17 * mean_distance(left, right);
    const Track hips = middle(p[kLeftHip], p[kRightHip]), tops = middle(left, right);
    for (int t = 0; t < frames_; ++t)
      for (int side = 0; side < 2; ++side)
        p[kLeftShoulder + side].push_back((side == 0 ? left : right)[t] -
                                          below * (tops[t] - hips[t]).normalized());
    const Track shoulders = middle(p[kLeftShoulder], p[kRightShoulder]);

    PerBody<Vector3d> rest = joint_offsets({});
    for (int b = 1; b < kBodies; ++b) rest[b] += rest[kParents[b]];
    const Vector3d rest_hips = 0.5 * (rest[kLeftHip] + rest[kRightHip]),
                   rest_trunk = 0.5 * (rest[kLeftShoulder] + rest[kRightShoulder]) - rest_hips;
    const Matrix3d to_trunk = axes_of(Vector3d::UnitX(), rest_trunk).transpose();
    std::vector<Track> head = named_.all(kHeadMarker, 0);
    for (const Track& track : named_.all(kHeadMarker, 1)) head.push_back(track);
    for (int t = 0; t < frames_; ++t) {
      const Vector3d trunk = shoulders[t] - hips[t];
      for (const int b : {kPelvis, kSpine1, kSpine2, kSpine3, kNeck, kLeftCollar, kRightCollar, kHead}) {
        const Vector3d across = b == kPelvis ? Vector3d(across_[t]) : Vector3d(left[t] - right[t]);
        p[b].push_back(hips[t] + trunk.norm() / rest_trunk.norm() *
                                     (axes_of(across, trunk) * (to_trunk * (rest[b] - rest_hips))));
      }
    }
    if (!head.empty()) p[kHead] = mean_of_tracks(head);
  }

  NamedMarkers named_;
  int frames_;
  Track across_;  ///< the pelvis' transverse axis, to the left
};

/// Velocity of the belt of a treadmill, m/s; 0 where the person is on none.
Vector3d belt_velocity(const PerBody<Track>& p, double fps, const Vector3d& up) {
  constexpr double kSlowest = 0.3;   // m/s
  constexpr double kStays = 0.2;     // of it: speed of the pelvis
  constexpr double kScatter = 0.15;  // of it: median distance of the standing feet's velocities
  const int frames = p[kPelvis].count();
  if (frames < 3) return Vector3d::Zero();
  Array<std::vector<double>, 3> parts;
  Track standing;
  for (int t = 1; t < frames; ++t) {
    const Track& foot = p[p[kLeftFoot][t].dot(up) < p[kRightFoot][t].dot(up) ? kLeftFoot : kRightFoot];
    standing.push_back(fps * (foot[t] - foot[t - 1]));
    for (int axis = 0; axis < 3; ++axis) parts[axis].push_back(standing.back()[axis]);
  }
  Vector3d belt(median(parts[0]), median(parts[1]), median(parts[2]));
  belt -= belt.dot(up) * up;
  const Vector3d travelled = fps / (frames - 1) * (p[kPelvis].back() - p[kPelvis].front());
  std::vector<double> away;
  for (const Vector3d& v : standing) away.push_back((v - belt - v.dot(up) * up).norm());
  const double speed = belt.norm();
  const bool treadmill =
      speed > kSlowest && travelled.norm() < kStays * speed && median(away) < kScatter * speed;
  return treadmill ? belt : Vector3d(Vector3d::Zero());
}

/// A warning where the rate contradicts the times of the rows.
std::vector<std::string> rate_warnings(const Markers& markers) {
  constexpr double kSame = 0.02,
                   kLastPlace = 0.01;  // relative; s, of times that are printed with two decimals
  const double steps = markers.tracks[0].count() - 1.0, said = steps / markers.fps;
  if (!(markers.seconds > 0.0) || std::abs(markers.seconds - said) < kSame * said + kLastPlace) return {};
  const std::string other = short_number(steps / markers.seconds);
  return {"two frame rates: DataRate says " + short_number(markers.fps) + ", the Time column " + other +
          "; DataRate counts without --fps " + other};
}

}  // namespace

PerFrame<PerBody<Vector3d>> joints_of_markers(const Markers& markers, const Vector3d& up,
                                              std::vector<std::string>& decisions,
                                              std::vector<std::string>& warnings) {
  const Joints joints(markers);
  const NamedMarkers& named = joints.named();
  warnings.insert(warnings.end(), named.warnings.begin(), named.warnings.end());
  decisions.push_back("markers: " + std::to_string(named.used) + " of " +
                      std::to_string(markers.names.size()) +
                      " are used; hips by the regression of Harrington et al. 2007");
  for (const auto& [what, how] : {std::pair("knees", &joints.knees), {"ankles", &joints.ankles}})
    decisions.push_back(std::string(what) + ": " + (*how)[0] +
                        ((*how)[0] == (*how)[1] ? "" : "; the right one " + (*how)[1]));
  const Vector3d belt = belt_velocity(joints.p, markers.fps, up);
  if (!belt.isZero(0.0))
    decisions.push_back("treadmill: the standing foot moves at " + short_number(belt.norm()) +
                        " m/s while the pelvis stays; the belt's velocity is taken out");
  PerFrame<PerBody<Vector3d>> frames;
  for (int t = 0; t < joints.p[kPelvis].count(); ++t) {
    PerBody<Vector3d>& now = frames.emplace_back();
    for (int b = 0; b < kBodies; ++b) now[b] = joints.p[b][t] - t / markers.fps * belt;
  }
  return frames;
}

SkeletonMotion skeleton_of_markers(std::string_view text, const std::string& name, const std::string& path,
                                   std::optional<char> up, std::optional<double> metres) {
  const Markers markers = parse_trc(text, path, metres);
  if (markers.names.empty() || markers.tracks[0].empty())
    throw DataError(path, "", "at least one marker and frame", "none");
  const auto skeleton = [&](char axis) {
    std::vector<std::string> decisions = {
        "frame rate: " + short_number(markers.fps) + " fps, by DataRate",
        "unit: " + short_number(markers.unit) + (metres ? " m, as asked for" : " m, by Units")};
    std::vector<std::string> warnings = rate_warnings(markers);
    const PerFrame<PerBody<Vector3d>> frames = joints_of_markers(
        markers, rotation_to_z_up(axis).conjugate() * Vector3d::UnitZ(), decisions, warnings);
    std::vector<double> values;
    for (const PerBody<Vector3d>& joints : frames)
      for (const Vector3d& joint : joints) values.insert(values.end(), joint.data(), joint.data() + 3);
    SkeletonMotion motion =
        skeleton_of_positions(NpyArray::from_double({frames.size(), kBodies, 3}, values.data()), name, path);
    motion.fps = markers.fps;
    motion.metric_up = axis;
    motion.decisions = decisions;
    motion.warnings = warnings;
    return motion;
  };
  SkeletonMotion motion = skeleton(up.value_or('y'));
  const PerFrame<Landmarks> landmarks = landmarks_of(motion, map_joints(motion, {}));
  if (const double leg = leg_length(landmarks); !metres && !is_human_leg(leg))
    throw DataError(path, "line 3", "Units that give legs of 0.28 to 1.3 m",
                    "legs of " + short_number(leg) + " m (--scale gives metres per unit)");
  if (up) return motion;
  const UpDecision found = decide_up(landmarks, std::nullopt, 'y');
  if (found.axis == 'y' || found.is_near()) return motion;
  motion = skeleton(found.axis);
  motion.warnings.push_back("up axis " + axis_name(found.axis) + ", not y as is usual for markers (" +
                            found.why + "): --up " + axis_name(found.axis) + ", or --up y");
  return motion;
}

}  // namespace mimicx::import

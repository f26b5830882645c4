#include "files/exchange/opensim.h"

#include <vector>

#include "core/number_text.h"

namespace mimicx::files {
namespace {

using Row = std::vector<double>;

void add_to_row(const Vector3d& v, Row& row) { row.insert(row.end(), v.data(), v.data() + 3); }
Vector3d to_ground(const Vector3d& v) { return {v.x(), v.z(), -v.y()}; }
/// From our axes of a body (x to the left, y up, z forward).
Vector3d to_segment(const Vector3d& v) { return {v.z(), v.y(), -v.x()}; }

/// @param names  of the columns behind the time @param rows  of the intervals
std::string storage(std::string_view opening, double fps, const std::vector<std::string>& names,
                    const std::vector<Row>& rows) {
  std::string text(opening);
  text += "nRows=" + std::to_string(rows.size()) + "\nnColumns=" + std::to_string(names.size() + 1) +
          "\ninDegrees=no\nendheader\ntime";
  for (const std::string& name : names) text += '\t' + name;
  text += '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += formatted("%.9f", middle_of_interval(static_cast<int>(i), fps));
    for (const double value : rows[i]) text += formatted("\t%.6f", value == 0.0 ? 0.0 : value);  // no "-0"
    text += '\n';
  }
  return text;
}

/// The ankle's axis in the shank of gait2392 (x forward, y up, z to the right; of the right leg), about which
/// the toes come up.
const Vector3d kAnkleAxis(-0.10501355, -0.17402245, 0.97912632);

/// To our axes of a body, of the leg of a side.
Vector3d from_segment(const Vector3d& v, bool right) { return {right ? -v.z() : v.z(), v.y(), v.x()}; }

bool rests_on_more_than_feet(const List<FloorForces>& floor) {
  for (const FloorForces& row : floor)
    if (!row[kOnTheRest].force.isZero(0.0)) return true;
  return false;
}

}  // namespace

Array<double, kGaitMoments> gait_moments(const BodyPoses& poses, const PerBody<Vector3d>& torque,
                                         bool right) {
  const int side = right ? 1 : 0;
  const auto in_world = [&](int body) { return Vector3d(poses.q_WB[body + side] * torque[body + side]); };
  // Turning about the axis to the left swings what hangs from it backwards.
  const Vector3d left = poses.q_WB[kPelvis] * Vector3d::UnitX();
  Vector3d ankle = from_segment(kAnkleAxis, right);
  if (!right) ankle = -ankle;  // a mirrored axis turns the other way
  ankle = poses.q_WB[kLeftKnee + side] * ankle;
  return {-in_world(kLeftHip).dot(left), -torque[kLeftKnee + side].dot(hinge_axis(kLeftKnee + side)),
          in_world(kLeftAnkle).dot(ankle)};
}

std::string gait_moment_name(int joint, bool right) {
  constexpr Array<const char*, kGaitMoments> kCoordinates = {"hip_flexion_", "knee_angle_", "ankle_angle_"};
  return std::string(kCoordinates[joint]) + (right ? "r_moment" : "l_moment");
}

std::string format_mot(const motion::Clip& clip, const RecordedForces& forces) {
  const List<FloorForces> floor = floor_forces(motion::poses_of(clip), forces, clip.scene);
  const int carriers = rests_on_more_than_feet(floor) ? 3 : 2;
  std::vector<std::string> names;
  for (int c = 0; c < carriers; ++c) {
    const std::string side(1, "rlo"[c]);
    for (const char* what : {"_vx", "_vy", "_vz", "_px", "_py", "_pz"})
      names.push_back("ground_force_" + side + what);
    for (const char* what : {"_x", "_y", "_z"}) names.push_back("ground_torque_" + side + what);
  }
  std::vector<Row> rows;
  for (const FloorForces& now : floor) {
    Row row;
    for (int c = 0; c < carriers; ++c) {
      add_to_row(to_ground(now[c].force), row);
      add_to_row(to_ground(now[c].point), row);
      add_to_row(to_ground(now[c].free_moment * Vector3d::UnitZ()), row);
    }
    rows.push_back(row);
  }
  return storage(kMotOpening, clip.fps, names, rows);
}

std::string format_sto(const motion::Clip& clip, const RecordedForces& forces) {
  std::vector<std::string> names;
  for (int b = 1; b < kBodies; ++b) {
    const std::string name(kBodyNames[b]);
    if (is_hinge(b))
      names.push_back(name + "_flexion_moment");
    else
      for (const char* axis : {"_moment_x", "_moment_y", "_moment_z"}) names.push_back(name + axis);
  }
  for (const bool right : {true, false})
    for (int k = 0; k < kGaitMoments; ++k) names.push_back(gait_moment_name(k, right));
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<Row> rows;
  for (int t = 1; t < clip.frames(); ++t) {
    Row row;
    for (int b = 1; b < kBodies; ++b) {
      const Vector3d& torque = forces.torque[t][b];
      if (is_hinge(b))
        row.push_back(torque.dot(hinge_axis(b)));
      else
        add_to_row(to_segment(torque), row);
    }
    for (const bool right : {true, false})
      for (const double moment : gait_moments(poses[t], forces.torque[t], right)) row.push_back(moment);
    rows.push_back(row);
  }
  return storage(kStoOpening, clip.fps, names, rows);
}

}  // namespace mimicx::files

#include "files/exchange/csv.h"

#include <vector>

#include "core/number_text.h"
#include "core/units.h"

namespace mimicx::files {
namespace {

constexpr Array<const char*, kCarriers> kCarrierNames = {"right_foot", "left_foot", "rest"};

void add_cells(double value, std::string& text) {
  text += formatted(",%.9g", value == 0.0 ? 0.0 : value);  // no "-0"
}
void add_cells(const Vector3d& v, std::string& text) {
  for (const double value : v) add_cells(value, text);
}

void add_names(const std::string& name, const char* unit, std::string& text) {
  for (const char* axis : {"_x", "_y", "_z"}) text += "," + name + axis + unit;
}

std::string heading(bool with_forces) {
  std::string text = "time_s";
  for (const std::string_view name : kBodyNames) add_names(std::string(name), "_m", text);
  text += ",root_qw,root_qx,root_qy,root_qz";
  if (!with_forces) return text + '\n';
  for (const std::string name : kCarrierNames) {
    add_names(name + "_force", "_N", text);
    text += "," + name + "_pressure_x_m," + name + "_pressure_y_m," + name + "_free_moment_Nm," + name +
            "_load_body_weights";
  }
  for (int b = 1; b < kBodies; ++b) {
    const std::string name = std::string(kBodyNames[b]) + "_torque";
    if (is_hinge(b))
      text += "," + name + "_Nm";
    else
      add_names(name, "_Nm", text);
  }
  return text + '\n';
}

/// @param weight  of the body, N
void add_forces(const FloorForces& floor, const PerBody<Vector3d>& torque, double weight, std::string& text) {
  for (const FloorForce& f : floor) {
    add_cells(f.force, text);
    if (f.loaded) {
      add_cells(f.point.x(), text);
      add_cells(f.point.y(), text);
      add_cells(f.free_moment, text);
    } else {
      text += ",,,";
    }
    add_cells(f.force.z() / weight, text);
  }
  for (int b = 1; b < kBodies; ++b) {
    if (is_hinge(b))
      add_cells(torque[b].dot(hinge_axis(b)), text);
    else
      add_cells(torque[b], text);
  }
}

}  // namespace

std::string format_csv(const motion::Clip& clip, const std::optional<RecordedForces>& forces) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const List<FloorForces> floor = forces ? floor_forces(poses, *forces, clip.scene) : List<FloorForces>();
  const double weight = recorded_gravity(clip) * motion::character_of(clip).total_mass();
  std::string text = heading(forces.has_value());
  for (int t = 0; t < clip.frames(); ++t) {
    text += formatted("%.9f", t / clip.fps);
    for (const Vector3d& p : poses[t].p_WB) add_cells(p, text);
    const Quaterniond& q = poses[t].q_WB[kPelvis];
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) add_cells(value, text);
    if (forces && t > 0) add_forces(floor[t - 1], forces->torque[t], weight, text);
    if (forces && t == 0) text += std::string(7 * kCarriers + kDofs, ',');
    text += '\n';
  }
  return text;
}

}  // namespace mimicx::files

#include "physics/mjcf.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace mimicx::physics {
namespace {

std::string numbers(const Vector3d& v) {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10) << v.x() << ' ' << v.y() << ' '
      << v.z();
  return out.str();
}

void write_joint(const Character& c, int body, const MjcfConfig& what, std::ostream& out) {
  if (body == kPelvis) {
    out << "<freejoint name=\"pelvis\"/>\n";
    return;
  }
  const JointParameters& j = c.joint[body];
  out << "<joint name=\"" << kBodyNames[body] << "\" type=\"" << (is_hinge(body) ? "hinge" : "ball")
      << "\" armature=\"" << j.armature << '"';
  if (what.springs) out << " stiffness=\"" << j.kp << "\" damping=\"" << j.kd << '"';
  if (is_hinge(body)) out << " axis=\"" << numbers(hinge_axis(body)) << '"';
  out << "/>\n";
}

/// A geometry without collisions and mass: the inertia is written explicitly.
void write_shape(const Capsule& k, std::ostream& out) {
  out << "<geom type=\"capsule\" size=\"" << k.radius << "\" fromto=\"" << numbers(k.a_B) << ' '
      << numbers(k.b_B) << "\" contype=\"0\" conaffinity=\"0\" rgba=\"0.7 0.65 0.6 1\"/>\n";
}

void write_body(const Character& c, int body, const MjcfConfig& what, std::ostream& out) {
  const Matrix3d& I = c.inertia_B[body];
  out << "<body name=\"" << kBodyNames[body] << "\" pos=\"" << numbers(c.joint_offset[body]) << "\">\n";
  write_joint(c, body, what, out);
  out << "<inertial pos=\"" << numbers(c.com_B[body]) << "\" mass=\"" << c.mass[body] << "\" fullinertia=\""
      << numbers(I.diagonal()) << ' ' << numbers({I(0, 1), I(0, 2), I(1, 2)}) << "\"/>\n";
  if (what.shapes) write_shape(c.capsule[body], out);
  for (const ContactPoint& point : c.contact_points) {
    if (point.body != body) continue;
    const double radius = std::max(point.radius, 0.005);
    const Vector3d centre = point.p_B + Vector3d(0, radius - point.radius, 0);  // soles face −y
    out << "<geom type=\"sphere\" size=\"" << radius << "\" pos=\"" << numbers(centre) << "\"/>\n";
  }
  for (int child = body + 1; child < kBodies; ++child)
    if (kParents[child] == body) write_body(c, child, what, out);
  out << "</body>\n";
}

void append_subtree(int body, PerBody<int>& order, int& count) {
  order[count++] = body;
  for (int child = body + 1; child < kBodies; ++child)
    if (kParents[child] == body) append_subtree(child, order, count);
}

/// A comment with the places of each joint in qpos and qvel.
void write_coordinates(std::ostream& out) {
  out << kMjcfOpening;
  int qpos = 0, qvel = 0;
  for (const int body : mjcf_order()) {
    const int positions = body == kPelvis ? 7 : is_hinge(body) ? 1 : 4;
    const int velocities = body == kPelvis ? 6 : is_hinge(body) ? 1 : 3;
    out << kBodyNames[body] << ": " << qpos << " (" << positions << "), " << qvel << " (" << velocities
        << ")\n";
    qpos += positions;
    qvel += velocities;
  }
  out << "-->\n";
}

}  // namespace

PerBody<int> mjcf_order() {
  PerBody<int> order{};
  int count = 0;
  append_subtree(kPelvis, order, count);
  return order;
}

std::string to_mjcf(const Character& character, const SimulationConfig& config, const MjcfConfig& what,
                    const Scene& scene) {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  write_coordinates(out);
  out << "<mujoco model=\"humanoid\">\n"
      << "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n"
      << "<option timestep=\"" << 1.0 / config.rate << "\" gravity=\"0 0 " << -config.gravity << "\"/>\n"
      << "<default><geom contype=\"0\" conaffinity=\"1\" friction=\"" << config.friction
      << " 0.005 0.0001\"/></default>\n"
      << "<worldbody>\n"
      << "<light pos=\"0 0 4\"/>\n"
      << "<geom name=\"floor\" type=\"plane\" size=\"0 0 1\" contype=\"1\" conaffinity=\"0\"/>\n";
  for (const Plate& p : scene.plates)
    out << "<geom type=\"box\" pos=\"" << numbers({p.centre.x(), p.centre.y(), 0.5 * p.height})
        << "\" size=\"" << numbers({p.half_extents.x(), p.half_extents.y(), 0.5 * p.height})
        << "\" euler=\"0 0 " << p.yaw << "\" contype=\"1\" conaffinity=\"0\"/>\n";
  write_body(character, 0, what, out);
  out << "</worldbody>\n</mujoco>\n";
  return out.str();
}

}  // namespace mimicx::physics

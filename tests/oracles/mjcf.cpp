#include "oracles/mjcf.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace mimicx {
namespace {

std::string numbers(const Vector3d& v) {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10) << v.x() << ' ' << v.y() << ' '
      << v.z();
  return out.str();
}

void write_joint(const Character& c, int body, std::ostream& out) {
  const auto i = static_cast<std::size_t>(body);
  if (body == 0) {
    out << "<freejoint name=\"pelvis\"/>\n";
    return;
  }
  const JointParameters& j = c.joint[i];
  out << "<joint name=\"" << kBodyNames[i] << "\" type=\"" << (is_hinge(body) ? "hinge" : "ball")
      << "\" armature=\"" << j.armature << "\" stiffness=\"" << j.kp << "\" damping=\"" << j.kd << '"';
  if (is_hinge(body)) out << " axis=\"" << numbers(hinge_axis(body)) << '"';
  out << "/>\n";
}

void write_body(const Character& c, int body, std::ostream& out) {
  const auto i = static_cast<std::size_t>(body);
  const Matrix3d& I = c.inertia_B[i];
  out << "<body name=\"" << kBodyNames[i] << "\" pos=\"" << numbers(c.joint_offset[i]) << "\">\n";
  write_joint(c, body, out);
  out << "<inertial pos=\"" << numbers(c.com_B[i]) << "\" mass=\"" << c.mass[i] << "\" fullinertia=\""
      << numbers(I.diagonal()) << ' ' << numbers({I(0, 1), I(0, 2), I(1, 2)}) << "\"/>\n";
  for (const ContactPoint& point : c.contact_points) {
    if (point.body != body) continue;
    const double radius = std::max(point.radius, 0.005);
    const Vector3d centre = point.p_B + Vector3d(0, radius - point.radius, 0);  // soles look along −y
    out << "<geom type=\"sphere\" size=\"" << radius << "\" pos=\"" << numbers(centre) << "\"/>\n";
  }
  for (int child = body + 1; child < kBodies; ++child)
    if (kParents[static_cast<std::size_t>(child)] == body) write_body(c, child, out);
  out << "</body>\n";
}

}  // namespace

std::string to_mjcf(const Character& character, const SimulationOptions& options) {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << "<mujoco model=\"humanoid\">\n"
      << "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n"
      << "<option timestep=\"" << 1.0 / options.rate << "\" gravity=\"0 0 " << -options.gravity << "\"/>\n"
      << "<default><geom contype=\"0\" conaffinity=\"1\" friction=\"" << options.friction
      << " 0.005 0.0001\"/></default>\n"
      << "<worldbody>\n"
      << "<geom name=\"floor\" type=\"plane\" size=\"0 0 1\" contype=\"1\" conaffinity=\"0\"/>\n";
  write_body(character, 0, out);
  out << "</worldbody>\n</mujoco>\n";
  return out.str();
}

}  // namespace mimicx

#include "picture/posed_motion.h"

#include <algorithm>
#include <cmath>

#include "skin/arrow.h"
#include "skin/box.h"
#include "skin/mannequin.h"
#include "skin/shapes.h"

namespace mimicx::picture {
namespace {

const render::Colour kForceColour(0.85F, 0.22F, 0.05F);
const render::Colour kSceneColour(0.62F, 0.60F, 0.56F);
constexpr float kLeftTint = 0.2F;  ///< by how much left limbs are mixed with white

bool is_of_left_limb(int body) {
  return kLimbOf[body] == kLimbOf[kLeftHip] || kLimbOf[body] == kLimbOf[kLeftShoulder];
}

List<render::Colour> colours_of(const skin::Mesh& mesh, const render::Colour& colour) {
  List<render::Colour> colours;
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    double left = 0.0;
    for (int k = 0; k < skin::kInfluences; ++k)
      if (is_of_left_limb(mesh.joints[v][k])) left += mesh.weights[v][k];
    const float tint = kLeftTint * static_cast<float>(left);
    colours.push_back((1.0F - tint) * colour + tint * render::Colour::Ones());
  }
  return colours;
}

render::Solid arrow_of(const files::FloorForce& force) {
  const skin::Mesh mesh = skin::arrow();
  const double length = files::kMetresPerNewton * force.force.norm();
  const Quaterniond turn = rotation_between(Vector3d::UnitY(), force.force);
  render::Solid solid;
  solid.is_sign = true;
  for (const Vector3d& p : mesh.vertices)
    solid.vertices.push_back(force.point + turn * Vector3d(p.x(), length * p.y(), p.z()));
  for (const Vector3d& n : mesh.normals) solid.normals.push_back(turn * n);
  solid.triangles = mesh.triangles;
  solid.colours.assign(mesh.vertices.count(), kForceColour);
  return solid;
}

}  // namespace

int PosedMotion::frame_at(double time) const {
  return static_cast<int>(std::clamp(std::floor(time * fps + 0.5), 0.0, poses.count() - 1.0));
}

PosedMotion posed_motion(const motion::Clip& clip, files::Skin skin,
                         const std::optional<files::RecordedForces>& forces) {
  PosedMotion out;
  out.label = clip.name;
  out.fps = clip.fps;
  out.scene = clip.scene;
  out.poses = motion::poses_of(clip);
  out.character = motion::character_of(clip);
  out.mesh =
      skin == files::Skin::kShapes ? skin::collision_shapes(out.character) : skin::mannequin(out.character);
  if (forces) out.forces = files::floor_forces(out.poses, *forces, clip.scene);
  return out;
}

List<render::Solid> solids_at(const PosedMotion& motion, int frame, const render::Colour& colour) {
  render::Solid body;
  body.vertices = skin::posed_vertices(motion.mesh, motion.character, motion.poses[frame]);
  body.normals = skin::vertex_normals(body.vertices, motion.mesh.triangles);
  body.triangles = motion.mesh.triangles;
  body.colours = colours_of(motion.mesh, colour);
  List<render::Solid> solids = {body};
  if (frame > 0 && !motion.forces.empty())
    for (const files::FloorForce& force : motion.forces[frame - 1])
      if (force.loaded) solids.push_back(arrow_of(force));
  return solids;
}

List<render::Solid> scene_solids(const PosedMotion& motion) {
  List<render::Solid> solids;
  const skin::Mesh mesh = skin::box();
  for (const Plate& plate : motion.scene.plates) {
    render::Solid& solid = solids.emplace_back();
    solid.vertices = skin::box_under(plate, mesh);
    for (const Vector3d& n : mesh.normals) solid.normals.push_back(rotation_z(plate.yaw) * n);
    solid.triangles = mesh.triangles;
    solid.colours.assign(mesh.vertices.count(), kSceneColour);
  }
  return solids;
}

}  // namespace mimicx::picture

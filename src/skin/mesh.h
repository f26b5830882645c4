/// A closed triangle mesh that a skeleton moves: linear blend skinning.
///
/// Bind pose: the character's T-pose, with the pelvis joint at the origin and the axes of the model frame (x
/// to the character's left, y up, z forward), which are those of glTF. A vertex follows up to four bodies.
///
/// It has no textures and no corrective shapes; a joint that twists by half a turn pinches its skin.
#pragma once

#include <array>

#include "character/character.h"

namespace mimicx::skin {

/// Three vertices, counter-clockwise from outside.
using Triangle = std::array<int, 3>;

inline constexpr int kInfluences = 4;  ///< bodies that a vertex may follow

struct Mesh {
  List<Vector3d> vertices;                   ///< [V] in bind pose, m
  List<Vector3d> normals;                    ///< [V] outward, unit length
  List<Triangle> triangles;                  ///< [F]
  List<Array<int, kInfluences>> joints;      ///< [V] bodies, the heaviest first; 0 where the weight is 0
  List<Array<double, kInfluences>> weights;  ///< [V] from 0 to 1; those of a vertex sum to 1
};

/// Positions of the joints in bind pose, m; the frames of bodies are parallel to the model's there.
PerBody<Vector3d> bind_joints(const Character& character);

/// The vertices in a pose, world, m.
List<Vector3d> posed_vertices(const Mesh& mesh, const Character& character, const BodyPoses& poses);

/// Outward unit normals of a mesh in any pose: the area-weighted mean over the triangles around a vertex; up
/// for a vertex whose triangles have no area.
List<Vector3d> vertex_normals(const List<Vector3d>& vertices, const List<Triangle>& triangles);

}  // namespace mimicx::skin

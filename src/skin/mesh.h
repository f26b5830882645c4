/// A closed triangle mesh that a skeleton moves: linear blend skinning.
///
/// Bind pose: the character's T-pose, with the pelvis joint at the origin and the axes of the model frame (x
/// to the character's left, y up, z forward), which are those of glTF. A vertex follows up to four bodies.
///
/// What it does not do: no textures, no corrective shapes; a joint that twists by half a turn pinches its
/// skin.
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

/// Where the joints are in bind pose, m: a body's frame there is parallel to the model's.
PerBody<Vector3d> bind_joints(const Character& character);

/// The vertices in a pose, world, m.
List<Vector3d> posed_vertices(const Mesh& mesh, const Character& character, const BodyPoses& poses);

/// Outward normals of a mesh in any pose, unit length: of its triangles around every vertex, by their areas.
/// Of a vertex whose triangles have no area: up.
List<Vector3d> vertex_normals(const List<Vector3d>& vertices, const List<Triangle>& triangles);

/// What a closed mesh encloses, m³; negative where its triangles face inward.
double enclosed_volume(const List<Vector3d>& vertices, const List<Triangle>& triangles);

}  // namespace mimicx::skin

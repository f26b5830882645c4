/// How deep the legs are in the sides of boxes (character/scene.h), with its derivatives by the pose.
///                                                                                         docs/control.md §6
/// Contact is with top faces alone: without a term in the cost a shin may pass through a riser. A leg is a
/// row of spheres, o the depth of each (`Scene::way_out`).
#pragma once

#include <Eigen/Core>

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

/// Whether any plate of the scene has sides.
bool has_sides(const System& system);

/// o of every sphere, lane by lane, m. @param kinematics  of the states
Array<P, kLegSpheres> depths_in_sides(const System& system, const Data<P>& kinematics);

struct SideDepths {
  Eigen::Matrix<double, kLegSpheres, 1> depth;  ///< o, m
  Eigen::Matrix<double, kLegSpheres, kTangent>
      by_tangent;  ///< by the coordinates of tangent.h; of velocities 0
};
SideDepths side_depths(const System& system, const Data<double>& kinematics);

}  // namespace mimicx::control

/// The numbers of the standard body: proportions, masses, joints. character.cpp makes a character of them.
#pragma once

#include <array>
#include <vector>

#include "character/bodies.h"
#include "character/joint_parameters.h"

namespace mimicx {

inline constexpr double kStandardMass = 70.0;  ///< kg

/// Standard body: joint positions relative to the parent, m, for the left side and the middle; the right
/// side is its mirror image in x. Proportions of a 1.72 m adult after segment lengths in Winter,
/// "Biomechanics and Motor Control of Human Movement" (4th ed., fig. 4.1), placed on the SMPL-X joints.
Vector3d standard_offset(int body);

/// Share of each segment in the total mass, after de Leva, "Adjustments to Zatsiorsky-Seluyanov's segment
/// inertia parameters", J. Biomech. 29 (1996), table 4 (mean of both sexes), trunk parts split over the
/// spine's bodies. Shares sum to 1.
double mass_share(int body);

/// Pairs of bodies that touch in human motion: arms with trunk, head and legs; arms with each other; legs
/// with each other. Without neighbours in the tree and bodies that overlap at rest. docs/physics.md §5
std::vector<std::array<int, 2>> make_self_pairs();

/// Controller, bound and range of a body's joint; the pelvis has none. Gains of DeepMimic and ASE; torque
/// bounds from peak voluntary and gait moments (docs/physics.md, "Joints"); ranges from goniometry tables,
/// widened for the soft tissue of a T-pose rig.
JointParameters standard_joint(int body);

}  // namespace mimicx

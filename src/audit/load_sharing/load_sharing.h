/// How two feet may share a load: what poses do not say.                   docs/metrics.md, "Load sharing"
///
/// The motion and the floor's forces on other bodies fix the sum of the wrenches on both feet, not what each
/// foot carries. With A the wrenches of the edges of the friction cones at the points of the soles, all x ≥ 0
/// with A x = h explain the motion equally well, and so do those with a centre of pressure of both feet that
/// is a centimetre away, because the motion is not known better. Per component and foot this gives the least
/// and the most force, by linear programs, and, with A x = h, the sharing of least effort: the smallest sum
/// over the joints of the legs of (torque / bound)².
///
/// What it does not do: intervals are judged one by one, and a person may share a load in any of these ways.
#pragma once

#include "audit/audit.h"
#include "audit/body_loads.h"
#include "character/character.h"
#include "core/containers.h"
#include "files/archive_members.h"

namespace mimicx::audit {

/// [left, right] (forward, to the left, up) of the hips, N.
using FootForces = Array<Vector3d, 2>;

/// Of the floor on each foot, over the interval that ends at the frame; zero at frame 0.
struct LoadSharing {
  FootForces least, most, least_effort;
  static LoadSharing none() {
    FootForces zero;
    zero.fill(Vector3d::Zero());
    return {zero, zero, zero};
  }
};

struct SharingConfig {
  double reach = 0.02;     ///< a sole's point up to this far above the ground touches it, m
  double window = 0.1;     ///< time around the interval in which a point must touch it to carry, s
  double friction = 1.0;   ///< μ
  int edges = 8;           ///< of the pyramid inscribed in the friction cone
  double pressure = 0.01;  ///< to which the centre of pressure of both feet is known, m
};

/// The torques of the legs' joints as functions of the feet's forces: rows · force at a point, against
/// `wanted`, in parts of the joints' bounds.
struct LegEffort {
  BodyPoses poses;           ///< joint centres, m; axes of the hinges
  PerBody<Vector3d> moment;  ///< torque plus the floor's moment on the feet, about the joint, world axes, N·m
  PerBody<double> bound;     ///< N·m
};

/// The columns of (forward, left, up) of the hips in world axes; of the world where the hips are one above
/// the other.
Matrix3d heading_axes(const PerBody<Vector3d>& joints);

/// @param wanted  of the floor on both feet together: (moment about `center`, N·m; force, N). What the points
///                cannot supply of it is left out
/// @param points  of the feet, with their bodies; forces are not used
/// @param axes    columns forward, left, up
LoadSharing share_load(const Vector6d& wanted, const Vector3d& center, const List<Push>& points,
                       const Matrix3d& axes, const LegEffort& legs, const SharingConfig& config = {});

/// Of a simulated motion. @throws std::invalid_argument if frames and forces differ in number
PerFrame<LoadSharing> load_sharing(const SimulatedFrames& motion, const SharingConfig& config = {});

/// As members of a motion's file, each (T, 2, 3) (docs/formats.md): foot_force_least, foot_force_most,
/// foot_force_least_effort.
files::Members sharing_members(const PerFrame<LoadSharing>& sharing);
/// @throws DataError naming file and member that is missing or of another shape
PerFrame<LoadSharing> read_sharing(const Npz& npz, std::size_t frames);

}  // namespace mimicx::audit

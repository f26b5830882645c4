/// Rotations in double precision, for all code outside the simulator's inner loop.
///
/// Conventions: quaternions are unit Hamilton quaternions and rotate column vectors; R_WB maps vectors
/// from frame B to frame W; rotation vectors (axis times angle) are in radians. The simulator has its own
/// rotations over its scalar type (physics/spatial.h).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mimicx {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Rotation vector → quaternion.
Quaterniond exp_map(const Vector3d& rotation_vector);
/// Quaternion → rotation vector of the shorter rotation, angle in [0, π].
Vector3d log_map(const Quaterniond& q);
/// First two columns of the rotation matrix (Zhou et al. 2019): continuous, 6 numbers.
Vector6d rotation_6d(const Quaterniond& q);
/// Heading of q: the direction of its local z axis ("forward" of the SMPL body frame), projected onto the
/// floor, as an angle from world x. If the body looks straight up or down, that projection is zero, and the
/// heading is that of the local y axis.
double heading_angle(const Quaterniond& q_WB);
/// Rotation about the world's vertical.
Quaterniond rotation_z(double angle);
/// Rotation about a unit axis.
Quaterniond rotation_about(const Vector3d& axis, double angle);
/// Interpolates from a (share 0) to b (share 1) along the shorter rotation at constant angular velocity.
Quaterniond slerp(const Quaterniond& a, double share, const Quaterniond& b);
/// Angle of the rotation from a to b, in [0, π].
double angle_between(const Quaterniond& a, const Quaterniond& b);
/// Angle between two vectors of any length, in [0, π], accurate near both ends.
double angle_between(const Vector3d& a, const Vector3d& b);
/// The shortest rotation from the direction of one vector to that of another.
Quaterniond rotation_between(const Vector3d& from, const Vector3d& to);
/// R q, where R is the shortest world rotation that takes q·from to the direction of `to`.
Quaterniond swung(const Quaterniond& q, const Vector3d& from, const Vector3d& to);
/// Swing-twist: q = swing · twist with twist about the unit axis (child side).
Quaterniond twist_about(const Quaterniond& q, const Vector3d& axis);

}  // namespace mimicx

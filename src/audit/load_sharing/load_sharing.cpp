#include "audit/load_sharing/load_sharing.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "audit/load_sharing/linear_program.h"
#include "audit/non_negative_least_squares.h"
#include "core/elementary.h"
#include "files/floor_forces.h"

namespace mimicx::audit {
namespace {

/// Of the squared forces relative to the squared rest of the wrench, in parts of the load.
constexpr double kSmallForces = 1e-6;
/// Of the squared efforts relative to the squared rest of the wrench: the rest is below 1e-3 of the load.
constexpr double kEffortPrice = 1e-4;
/// Of the squared forces beside efforts.
constexpr double kTinyForces = 1e-9;

/// Unknowns of the linear program beside the forces: how its centre of pressure moves (program_of).
constexpr Eigen::Index kMoves = 5;

constexpr Array<int, 8> kLegJoints = {kLeftHip,   kRightHip,   kLeftKnee, kRightKnee,
                                      kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot};

/// The members of a file and what they hold.
struct SharingMember {
  const char* name;
  FootForces LoadSharing::*forces;
};
constexpr SharingMember kSharingMembers[] = {{"foot_force_least", &LoadSharing::least},
                                             {"foot_force_most", &LoadSharing::most},
                                             {"foot_force_least_effort", &LoadSharing::least_effort}};

int foot_of(int body) { return files::carrier_of(body) == files::kOnLeftFoot ? 0 : 1; }

bool carries(int joint, int body) {
  for (int b = body; b >= 0; b = kParents[b])
    if (b == joint) return true;
  return false;
}

/// A force of one newton along an edge of a point's friction cone.
struct Edge {
  int body;
  Vector3d p, force;
};

List<Edge> edges_of(const List<Push>& points, const SharingConfig& config) {
  List<Edge> edges;
  for (const Push& point : points)
    for (int k = 0; k < config.edges; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / config.edges;
      edges.push_back(
          {point.body, point.p, {config.friction * cos(angle), config.friction * sin(angle), 1.0}});
    }
  return edges;
}

/// Parts of the joint's torque that count as effort, in parts of its bound: all three of a spherical joint,
/// of a hinge the one about its axis.
Eigen::VectorXd effort_of(const LegEffort& legs, int joint, const Vector3d& moment) {
  if (!is_hinge(joint)) return moment / legs.bound[joint];
  const Vector3d axis = legs.poses.q_WB[joint] * hinge_axis(joint);
  return Eigen::VectorXd::Constant(1, axis.dot(moment) / legs.bound[joint]);
}

/// All efforts of a force, or of the moments without one.
template <class Moment>
Eigen::VectorXd efforts(const LegEffort& legs, const Moment& moment_about) {
  Eigen::VectorXd all(3 * kLegJoints.size());
  Eigen::Index row = 0;
  for (const int joint : kLegJoints) {
    const Eigen::VectorXd part = effort_of(legs, joint, moment_about(joint));
    all.segment(row, part.size()) = part;
    row += part.size();
  }
  return all.head(row);
}

FootForces foot_forces(const List<Edge>& edges, const Eigen::VectorXd& x, const Matrix3d& axes) {
  FootForces sums = LoadSharing::none().least;
  for (int k = 0; k < edges.count(); ++k)
    sums[foot_of(edges[k].body)] += x[k] * (axes.transpose() * edges[k].force);
  return sums;
}

/// The x of least effort with A x = b. @param efforts_A  efforts per edge; efforts_b  without forces
Eigen::VectorXd least_effort(const Matrix6X& A, const Vector6d& b, const Eigen::MatrixXd& efforts_A,
                             const Eigen::VectorXd& efforts_b) {
  Eigen::MatrixXd both(6 + efforts_A.rows(), A.cols());
  Eigen::VectorXd wanted(both.rows());
  const double price = std::sqrt(kEffortPrice);
  both << A, price * efforts_A;
  wanted << b, price * efforts_b;
  return non_negative_least_squares(both, wanted, kTinyForces);
}

/// A x = b up to horizontal moments whose sizes add up to `most`. kMoves unknowns follow those of A: the
/// moments about x and y, the same in the other direction, and what is left of `most`.
LinearProgram program_of(const Matrix6X& A, const Vector6d& b, double most) {
  const Eigen::Index n = A.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(7, n + kMoves);
  rows.topLeftCorner(6, n) = A;
  rows.block<2, 2>(0, n).setIdentity();
  rows.block<2, 2>(0, n + 2) = -Eigen::Matrix2d::Identity();
  rows.row(6).tail<kMoves>().setOnes();
  Eigen::VectorXd wanted(7);
  wanted << b, most;
  return {rows, wanted};
}

BodyPoses midway(const BodyPoses& a, const BodyPoses& b) {
  BodyPoses mid;
  for (int i = 0; i < kBodies; ++i) {
    mid.p_WB[i] = 0.5 * (a.p_WB[i] + b.p_WB[i]);
    const double sign = a.q_WB[i].dot(b.q_WB[i]) < 0.0 ? -1.0 : 1.0;
    mid.q_WB[i] = Quaterniond(a.q_WB[i].coeffs() + sign * b.q_WB[i].coeffs()).normalized();
  }
  return mid;
}

/// The lowest points of a character's contact points in every frame, m.
PerFrame<List<Vector3d>> contact_tracks(const Character& c, const PerFrame<BodyPoses>& poses) {
  PerFrame<List<Vector3d>> tracks;
  for (const BodyPoses& frame : poses) {
    List<Vector3d> points;
    for (const ContactPoint& point : c.contact_points) points.push_back(lowest_position(point, frame));
    tracks.push_back(points);
  }
  return tracks;
}

/// Points of the feet that touch the floor within the window around the interval that ends at frame t, where
/// they do so at the frame next to its middle.
List<Push> points_in_reach(const SimulatedFrames& motion, const PerFrame<List<Vector3d>>& tracks, int t,
                           const SharingConfig& config) {
  const Character& c = motion.character;
  const int most = static_cast<int>(std::lround(config.window * motion.fps));
  const auto touching = [&](int i) -> const Vector3d* {
    for (int away = 0; away <= most; ++away)
      for (const int frame : {t - 1 - away, t + away})
        if (frame >= 0 && frame < tracks.count() && motion.scene.clearance(tracks[frame][i]) <= config.reach)
          return &tracks[frame][i];
    return nullptr;
  };
  List<Push> points;
  for (int i = 0; i < c.contact_points.count(); ++i) {
    const int body = c.contact_points[i].body;
    if (files::carrier_of(body) == files::kOnTheRest) continue;
    if (const Vector3d* p = touching(i))
      points.push_back({body, {p->x(), p->y(), motion.scene.height_under(*p)}, Vector3d::Zero()});
  }
  return points;
}

/// The torques without the floor under the feet: what is recorded, and the moments of the floor on the feet
/// that it had to bear. Forces on other bodies, of one who kneels or sits, act whatever the feet carry.
LegEffort leg_effort(const Character& c, const BodyPoses& mid, const rl::tracking::ActingForces& acting) {
  LegEffort legs{mid, {}, {}};
  for (const int joint : kLegJoints) {
    Vector3d moment = mid.q_WB[joint] * acting.joint_torque[joint];
    for (int b = joint; b < kBodies; ++b)
      if (files::carrier_of(b) != files::kOnTheRest && carries(joint, b))
        moment += acting.ground[b].head<3>() +
                  (mid.p_WB[b] - mid.p_WB[joint]).cross(Vector3d(acting.ground[b].tail<3>()));
    legs.moment[joint] = moment;
    legs.bound[joint] = c.joint[joint].torque_limit;
  }
  return legs;
}

}  // namespace

Matrix3d heading_axes(const PerBody<Vector3d>& joints) {
  Vector3d left = joints[kLeftHip] - joints[kRightHip];
  left.z() = 0.0;
  if (left.norm() < 1e-9) return Matrix3d::Identity();
  left.normalize();
  Matrix3d axes;
  axes << Vector3d(left.y(), -left.x(), 0.0), left, Vector3d::UnitZ();
  return axes;
}

LoadSharing share_load(const Vector6d& wanted, const Vector3d& center, const List<Push>& points,
                       const Matrix3d& axes, const LegEffort& legs, const SharingConfig& config) {
  LoadSharing sharing = LoadSharing::none();
  const double load = wanted.norm();
  if (points.empty() || !(load > 0.0)) return sharing;
  const List<Edge> edges = edges_of(points, config);
  Matrix6X A(6, edges.count());
  Eigen::MatrixXd efforts_A;
  const Eigen::VectorXd efforts_b = efforts(legs, [&](int joint) { return legs.moment[joint]; }) / load;
  efforts_A.resize(efforts_b.size(), edges.count());
  for (int k = 0; k < edges.count(); ++k) {
    const Edge& e = edges[k];
    A.col(k) << (e.p - center).cross(e.force), e.force;
    efforts_A.col(k) = efforts(legs, [&](int joint) -> Vector3d {
      return carries(joint, e.body) ? Vector3d((e.p - legs.poses.p_WB[joint]).cross(e.force))
                                    : Vector3d(Vector3d::Zero());
    });
  }
  const Vector6d supplied = A * non_negative_least_squares(A, wanted / load, kSmallForces);
  sharing.least_effort = foot_forces(edges, load * least_effort(A, supplied, efforts_A, efforts_b), axes);
  sharing.least = sharing.most = sharing.least_effort;
  LinearProgram program = program_of(A, supplied, config.pressure * supplied[5]);
  if (!program.feasible()) return sharing;  // `supplied` is feasible: rounding alone
  for (int foot = 0; foot < 2; ++foot)
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::VectorXd component = Eigen::VectorXd::Zero(edges.count() + kMoves);
      for (int k = 0; k < edges.count(); ++k)
        if (foot_of(edges[k].body) == foot) component[k] = axes.col(axis).dot(edges[k].force);
      sharing.least[foot][axis] = load * component.dot(program.minimum(component));
      sharing.most[foot][axis] = load * component.dot(program.minimum(-component));
    }
  return sharing;
}

PerFrame<LoadSharing> load_sharing(const SimulatedFrames& motion, const SharingConfig& config) {
  if (motion.frames.size() != motion.forces.size())
    throw std::invalid_argument("load_sharing: frames and forces differ in number");
  const Character& c = motion.character;
  PerFrame<BodyPoses> poses;
  for (const motion::ReferenceFrame& frame : motion.frames)
    poses.push_back(forward_kinematics(c, frame.p_root, frame.q));
  const PerFrame<List<Vector3d>> tracks = contact_tracks(c, poses);
  PerFrame<LoadSharing> sharing(poses.count(), LoadSharing::none());
  for (int t = 1; t < poses.count(); ++t) {
    const rl::tracking::ActingForces& acting = motion.forces[static_cast<std::size_t>(t)];
    const BodyPoses mid = midway(poses[t - 1], poses[t]);
    const Vector3d center = center_of_mass(c, mid);
    const auto wrenches = files::floor_wrenches(acting.ground, mid.p_WB);
    Vector6d wanted = wrenches[files::kOnLeftFoot] + wrenches[files::kOnRightFoot];
    wanted.head<3>() -= center.cross(Vector3d(wanted.tail<3>()));
    sharing[t] = share_load(wanted, center, points_in_reach(motion, tracks, t, config),
                            heading_axes(mid.p_WB), leg_effort(c, mid, acting), config);
  }
  return sharing;
}

files::Members sharing_members(const PerFrame<LoadSharing>& sharing) {
  files::Members members;
  for (const SharingMember& member : kSharingMembers) {
    std::vector<double> values;
    for (const LoadSharing& frame : sharing)
      for (const Vector3d& force : frame.*member.forces) files::append(force, values);
    members.emplace_back(member.name,
                         files::numbers_member({sharing.size(), 2, 3}, values, files::Precision::kFloat64));
  }
  return members;
}

PerFrame<LoadSharing> read_sharing(const Npz& npz, std::size_t frames) {
  PerFrame<LoadSharing> sharing(frames);
  for (const SharingMember& member : kSharingMembers) {
    const std::vector<double> values = files::read_numbers(npz, member.name, frames, 6);
    for (std::size_t i = 0; i < 2 * frames; ++i)
      (sharing[i / 2].*member.forces)[i % 2] = Eigen::Map<const Vector3d>(&values[3 * i]);
  }
  return sharing;
}

}  // namespace mimicx::audit

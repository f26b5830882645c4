#include "import/joint_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "character/body_words.h"
#include "character/character.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/quantile.h"

namespace mimicx::import {
namespace {

using Positions = PerBody<Vector3d>;
using Rotations = PerBody<Quaterniond>;

constexpr double kStraightSine = 0.1,
                 kBentSine = 0.35;  ///< sines of the bend where a hinge starts to count, and counts fully
constexpr double kTallest = 5.0;    ///< m, of features that are not normalised

PerFrame<Positions> positions_of(const Eigen::MatrixXd& rows) {
  PerFrame<Positions> frames;
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    auto& p = frames.emplace_back();
    for (int b = 0; b < kBodies; ++b) p[b] = rows.row(t).segment<3>(3 * b);
  }
  return frames;
}

/// How an array has the joints or features of every frame.
struct Layout {
  bool features = false;
  std::size_t frames = 0, joints = kBodies;
  bool frames_last = false;  ///< (joints, 3, frames)
};

/// The layout of (T, J, 3), (J, 3, T), (T, 263), each also with dimensions of one in front. The first 22 of
/// 24, 52 and 55 joints, SMPL's, SMPL-H's and SMPL-X's, are ours.
std::optional<Layout> layout_of(std::vector<std::size_t> shape) {
  while (shape.size() > 3 && shape[0] == 1) shape.erase(shape.begin());
  if (shape.size() == 3 && shape[0] == 1 && shape[2] == kHumanMl3dFeatures) shape.erase(shape.begin());
  const auto known = [](std::size_t joints) {
    return joints == kBodies || joints == 24 || joints == 52 || joints == 55;
  };
  if (shape.size() == 2 && shape[1] == kHumanMl3dFeatures) return Layout{true, shape[0], kBodies, false};
  if (shape.size() != 3) return std::nullopt;
  if (shape[2] == 3 && known(shape[1])) return Layout{false, shape[0], shape[1], false};
  if (shape[1] == 3 && known(shape[0])) return Layout{false, shape[2], shape[0], true};
  return std::nullopt;
}

/// A row per frame: features, or the positions of our joints.
Eigen::MatrixXd rows_of(const NpyArray& array, const Layout& layout) {
  const std::vector<double> values = array.to_double();
  const Eigen::Index frames = static_cast<Eigen::Index>(layout.frames),
                     columns =
                         static_cast<Eigen::Index>(layout.features ? kHumanMl3dFeatures : 3 * layout.joints);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd all =
      layout.frames_last
          ? Eigen::MatrixXd(Eigen::Map<const RowMajor>(values.data(), columns, frames).transpose())
          : Eigen::MatrixXd(Eigen::Map<const RowMajor>(values.data(), frames, columns));
  return layout.features ? all : Eigen::MatrixXd(all.leftCols(3 * kBodies));
}

/// Throws where the bones change their lengths from frame to frame, as they do where the numbers are
/// rotations.
void require_bones(const PerFrame<Positions>& frames, const std::string& path) {
  constexpr double kMostChange = 0.3;  // of the mean, root mean square, in the median over the bones
  std::vector<double> changes;
  for (int b = 1; b < kBodies; ++b) {
    double sum = 0.0, squares = 0.0;
    for (const Positions& p : frames) {
      const double length = (p[b] - p[kParents[b]]).norm();
      sum += length;
      squares += length * length;
    }
    const double n = static_cast<double>(frames.size()), mean = sum / n;
    changes.push_back(mean > 0.0 ? std::sqrt(std::max(0.0, squares / n - mean * mean)) / mean : 0.0);
  }
  if (median(changes) > kMostChange)
    throw DataError(path, "", "joint positions, whose bones keep their lengths",
                    "lengths that change by " + std::to_string(std::lround(100.0 * median(changes))) +
                        " % (rotations? normalised numbers?)");
}

/// Throws where left and right bones have other lengths, as they do where the joints have another order.
void require_our_order(const PerFrame<Positions>& frames, const std::string& path) {
  constexpr double kMostDifference = 0.2;  // of the longer one, in the median over the pairs
  const auto length = [&](int b) {
    double sum = 0.0;
    for (const Positions& p : frames) sum += (p[b] - p[kParents[b]]).norm();
    return sum;
  };
  std::vector<double> differences;
  for (int b = 1; b < kBodies; ++b)
    if (is_right(b)) {
      const double left = length(b - 1), right = length(b), longer = std::max(left, right);
      differences.push_back(longer > 0.0 ? std::abs(left - right) / longer : 0.0);
    }
  if (median(differences) > kMostDifference)
    throw DataError(
        path, "",
        "joints in SMPL's order (pelvis, left hip, right hip, spine1, left knee, …), whose left and "
        "right bones are alike",
        "lengths that differ by " + std::to_string(std::lround(100.0 * median(differences))) +
            " % (another order?)");
}

/// How many rows are left without those at the end that are all zeros or all not numbers, with which batches
/// are padded.
Eigen::Index without_padding(const Eigen::MatrixXd& rows) {
  Eigen::Index count = rows.rows();
  while (count > 0 && (rows.row(count - 1).isZero(0.0) || rows.row(count - 1).array().isNaN().all())) --count;
  return count;
}

/// Warnings of joints at the origin in some frames, where a tracker has not seen them. The pelvis may be
/// there.
std::vector<std::string> origin_warnings(const PerFrame<Positions>& frames) {
  std::vector<std::string> said;
  for (int b = 1; b < kBodies; ++b) {
    int lost = 0, last = 0;
    for (int t = 0; t < frames.count(); ++t)
      if (frames[t][b].isZero(0.0)) ++lost, last = t;
    if (lost > 0)
      said.push_back(body_in_words(b) + " at (0, 0, 0) in " + std::to_string(lost) + " of " +
                     std::to_string(frames.count()) + " frames, last in frame " + std::to_string(last) +
                     ": was it not seen? It is taken to be there");
  }
  return said;
}

/// The root's heading and place are sums over the frames before; the joints stand in its heading.
PerFrame<Positions> positions_of_features(const Eigen::MatrixXd& rows, const std::string& path) {
  constexpr int kTurn = 0, kStep = 1, kHeight = 3, kJointsAt = 4;
  const auto height = rows.col(kHeight);
  if (height.minCoeff() < 0.0 || height.maxCoeff() > kTallest || height.maxCoeff() < 0.2)
    throw DataError(path, "", "HumanML3D's features in metres",
                    "heights of the root of " + std::to_string(height.minCoeff()) + " to " +
                        std::to_string(height.maxCoeff()) +
                        " m: are they normalised? Multiply by Std.npy and add Mean.npy");
  PerFrame<Positions> frames;
  double heading = 0.0;  // half the angle, as the features have it
  Vector3d root = Vector3d::Zero();
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    if (t > 0) heading += rows(t - 1, kTurn);
    const Quaterniond to_world(cos(heading), 0.0, -sin(heading), 0.0);
    if (t > 0) root += to_world * Vector3d(rows(t - 1, kStep), 0.0, rows(t - 1, kStep + 1));
    root.y() = rows(t, kHeight);
    auto& p = frames.emplace_back();
    p[kPelvis] = root;
    for (int b = 1; b < kBodies; ++b) {
      p[b] = to_world * Vector3d(rows.row(t).segment<3>(kJointsAt + 3 * (b - 1)));
      p[b].x() += root.x();
      p[b].z() += root.z();
    }
  }
  return frames;
}

/// The rotation that takes x to `across` and y as near to `along` as it can.
Quaterniond frame_of(const Vector3d& across, const Vector3d& along) {
  Matrix3d m;
  m.col(0) = across.normalized();
  m.col(2) = m.col(0).cross(along).normalized();
  m.col(1) = m.col(2).cross(m.col(0));
  return Quaterniond(m);
}

/// Turns a body about its bone so that an axis is perpendicular to the plane of the bone and a neighbour, if
/// they are not in line.
/// @param q     of the body, its bone in place
/// @param axis  in the body's frame
Quaterniond with_hinge(const Quaterniond& q, const Vector3d& axis, const Vector3d& bone,
                       const Vector3d& neighbour) {
  const Vector3d u = bone.normalized(), across = u.cross(neighbour.normalized()), now = q * axis;
  const double shown = std::clamp((across.norm() - kStraightSine) / (kBentSine - kStraightSine), 0.0, 1.0);
  if (shown == 0.0) return q;
  const Vector3d flat = (now - now.dot(u) * u).normalized();
  const double angle = atan2(flat.cross(across).dot(u), flat.dot(across));
  return (rotation_about(u, shown * angle) * q).normalized();
}

struct Limb {
  int upper, lower, end;
};
constexpr std::array<Limb, 4> kLimbs = {{{kLeftHip, kLeftKnee, kLeftAnkle},
                                         {kRightHip, kRightKnee, kRightAnkle},
                                         {kLeftShoulder, kLeftElbow, kLeftWrist},
                                         {kRightShoulder, kRightElbow, kRightWrist}}};

/// From the middle of the hips to the middle of the shoulders.
Vector3d hips_to_shoulders(const Positions& p) {
  return 0.5 * (p[kLeftShoulder] + p[kRightShoulder]) - 0.5 * (p[kLeftHip] + p[kRightHip]);
}

/// `frame_of` the character's trunk in the rest pose, where it leans back.
Quaterniond rest_frame(const Character& character) {
  Rotations unrotated;
  unrotated.fill(Quaterniond::Identity());
  return frame_of(Vector3d::UnitX(),
                  hips_to_shoulders(forward_kinematics(character, Vector3d::Zero(), unrotated).p_WB));
}

/// World rotations of the bodies; identity where all bones have the directions of the character's rest pose.
/// @param rest  rest_frame of the character
Rotations rotations_of(const Character& character, const Quaterniond& rest, const Positions& p) {
  Rotations q;
  const Vector3d trunk = hips_to_shoulders(p);
  q[kPelvis] = frame_of(p[kLeftHip] - p[kRightHip], trunk) * rest.conjugate();
  const Quaterniond chest = frame_of(p[kLeftShoulder] - p[kRightShoulder], trunk) * rest.conjugate();
  for (int b = 1; b < kBodies; ++b) {
    q[b] = q[kParents[b]];
    if (b == kSpine1) q[b] = slerp(q[kPelvis], 1.0 / 3.0, chest);
    if (b == kSpine2) q[b] = slerp(q[kPelvis], 2.0 / 3.0, chest);
    if (b == kSpine3) q[b] = chest;
    for (const Limb& limb : kLimbs) {
      if (b == limb.upper) {
        q[b] = swung(q[b], character.joint_offset[limb.lower], p[limb.lower] - p[b]);
        q[b] = with_hinge(q[b], hinge_axis(limb.lower), p[limb.lower] - p[b], p[limb.end] - p[limb.lower]);
      }
      if (b == limb.lower) q[b] = swung(q[b], character.joint_offset[limb.end], p[limb.end] - p[b]);
    }
    for (const auto& [from, to] :
         {std::pair{kLeftAnkle, kLeftFoot}, {kRightAnkle, kRightFoot}, {kNeck, kHead}})
      if (b == from) {
        const Vector3d& bone = character.joint_offset[to];
        q[b] = swung(q[b], bone, p[to] - p[b]);
        // Feet turn with the shank and bend; how far they roll does not show.
        if (b != kNeck)
          q[b] = with_hinge(q[b], bone.cross(character.joint_offset[b]).normalized(), p[to] - p[b],
                            p[b] - p[kParents[b]]);
      }
  }
  return q;
}

/// The rest skeleton: bones with the character's rest directions and their mean lengths in the motion.
PerJoint<SkeletonJoint> joints_of(const Character& character, const PerFrame<Positions>& frames,
                                  const std::string& path) {
  PerJoint<SkeletonJoint> joints;
  for (int b = 0; b < kBodies; ++b) {
    const int parent = kParents[b];
    double length = 0.0;
    for (const Positions& p : frames)
      length += parent < 0 ? 0.0 : (p[b] - p[parent]).norm() / static_cast<double>(frames.size());
    if (parent >= 0 && !(length > 0.0))
      throw DataError(path, "", body_in_words(b) + " and its parent at different places",
                      "both at the same place");
    const Vector3d rest = parent < 0 ? Vector3d::Zero() : character.joint_offset[b].normalized();
    // Names differ from ours, because retarget.h would take the skeleton for one of our own files, y up and
    // exact.
    joints.push_back({parent < 0 ? "root" : std::string(kBodyNames[b]), parent, length * rest});
  }
  return joints;
}

}  // namespace

bool is_positions(const std::vector<std::size_t>& shape) { return layout_of(shape).has_value(); }

SkeletonMotion skeleton_of_positions(const NpyArray& array, const std::string& name,
                                     const std::string& path) {
  const Layout layout = layout_of(array.shape).value();
  const bool features = layout.features;
  if (array.type == NpyArray::Type::kText || layout.frames == 0)
    throw DataError(path, "", "at least one frame of numbers", "none");
  Eigen::MatrixXd rows = rows_of(array, layout);
  const Eigen::Index padded = rows.rows(), used = without_padding(rows);
  if (used == 0) throw DataError(path, "", "at least one frame that is not all zeros", "none");
  rows.conservativeResize(used, Eigen::NoChange);
  for (Eigen::Index t = 0; t < rows.rows(); ++t)
    if (!rows.row(t).allFinite() || rows.row(t).cwiseAbs().maxCoeff() > 1e7)
      throw DataError(path, "frame " + std::to_string(t), "finite numbers within ±1e7", "one that is not");
  const PerFrame<Positions> frames = features ? positions_of_features(rows, path) : positions_of(rows);
  require_bones(frames, path);
  require_our_order(frames, path);
  const Character character = make_character();
  const Quaterniond rest = rest_frame(character);
  SkeletonMotion motion;
  motion.name = name;
  motion.path = path;
  motion.fps = kPositionsFps;
  motion.positions_only = true;
  motion.metric_up = features ? 'y' : 0;
  motion.warnings = origin_warnings(frames);
  motion.joints = joints_of(character, frames, path);
  for (const Positions& p : frames) {
    const Rotations q = rotations_of(character, rest, p);
    auto& translation = motion.translation.emplace_back();
    auto& rotation = motion.rotation.emplace_back();
    for (int b = 0; b < kBodies; ++b) {
      const int parent = kParents[b];
      translation.push_back(parent < 0 ? p[b] : Vector3d(q[parent].conjugate() * (p[b] - p[parent])));
      rotation.push_back(parent < 0 ? q[b] : (q[parent].conjugate() * q[b]).normalized());
    }
  }
  motion.decisions.emplace_back(features ? "frame rate: 20 fps, that of HumanML3D; --fps overrides"
                                         : kAssumedRate);
  if (used < padded)
    motion.decisions.push_back("frames: the last " + std::to_string(padded - used) + " of " +
                               std::to_string(padded) + std::string(kPaddingLeftOut));
  return motion;
}

}  // namespace mimicx::import

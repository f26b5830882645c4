#include "rl/tracking/mirror.h"

#include <algorithm>
#include <array>

#include "rl/tracking/state.h"

namespace mimicx::rl::tracking {
namespace {

using Signs = std::array<float, 3>;

constexpr Signs kPolar = {1, -1, 1};   ///< under y → −y: positions and velocities
constexpr Signs kAxial = {-1, 1, -1};  ///< under y → −y: angular velocities
// In body frames the mirror is x → −x.
constexpr Signs kBodyPolar = {-1, 1, 1};
constexpr Signs kBodyAxial = {1, -1, -1};

/// The mirror image of a body.
int other_side(int body) {
  if (is_right(body)) return body - 1;
  return kBodyNames[body].starts_with("left") ? body + 1 : body;
}

/// Factor on the angle of the other side's hinge.
float hinge_sign(int body) {
  const Vector3d axis = hinge_axis(other_side(body));
  return Vector3d(axis.x(), -axis.y(), -axis.z()).dot(hinge_axis(body)) > 0.0 ? 1.0F : -1.0F;
}

/// Writes a map entry by entry.
class Writer {
 public:
  void one(int from, float sign) {
    map_.from.push_back(from);
    map_.sign.push_back(sign);
  }
  void three(int from, const Signs& signs, float factor = 1.0F) {
    for (int k = 0; k < 3; ++k) one(from + k, factor * signs[static_cast<std::size_t>(k)]);
  }
  MirrorMap take() { return std::move(map_); }

 private:
  MirrorMap map_;
};

/// Maps the entries of every body's joint, bodies in order, from those of the other side's joint.
/// @param spherical, hinge  numbers per joint of that kind
template <class Write>
void for_each_joint(int spherical, int hinge, Write write) {
  PerBody<int> first{};
  for (int body = 1, next = 0; body < kBodies; ++body) {
    first[body] = next;
    next += is_hinge(body) ? hinge : spherical;
  }
  for (int body = 1; body < kBodies; ++body) write(body, first[other_side(body)]);
}

/// Rotation vectors or angular velocities of the joints.
void joint_vectors(int begin, Writer& writer) {
  for_each_joint(3, 1, [&](int body, int from) {
    if (is_hinge(body))
      writer.one(begin + from, hinge_sign(body));
    else
      writer.three(begin + from, kBodyAxial);
  });
}

/// Maps P of state.h, which begins at an entry of the state.
void pose(int begin, Writer& writer) {
  writer.one(begin, 1.0F);  // the height
  // R becomes M R M with the mirrors of world and body: the first column changes its sign, too.
  writer.three(begin + 1, kPolar, -1.0F);
  writer.three(begin + 4, kPolar);
  writer.three(begin + 7, kPolar);
  writer.three(begin + 10, kAxial);
  const int rotations = begin + 13, velocities = rotations + kJointFeatures - kDofs;
  for_each_joint(6, 1, [&](int body, int from) {
    if (is_hinge(body)) {
      writer.one(rotations + from, hinge_sign(body));
    } else {
      writer.three(rotations + from, kBodyPolar, -1.0F);
      writer.three(rotations + from + 3, kBodyPolar);
    }
  });
  joint_vectors(velocities, writer);
  const int effectors = velocities + kDofs;
  for (const int body : kEndEffectors) {
    const auto other = std::find(kEndEffectors.begin(), kEndEffectors.end(), other_side(body));
    writer.three(effectors + 3 * static_cast<int>(other - kEndEffectors.begin()), kPolar);
  }
}

}  // namespace

MirrorMap mirror_of_state() {
  Writer writer;
  pose(0, writer);
  for (int k = 0; k < static_cast<int>(kBetas); ++k) writer.one(kPoseFeatures + k, 1.0F);
  pose(kPoseFeatures + kBetas, writer);
  pose(2 * kPoseFeatures + kBetas, writer);
  writer.one(kStateSize - 2, 1.0F);
  writer.one(kStateSize - 1, -1.0F);
  return writer.take();
}

MirrorMap mirror_of_action() {
  Writer writer;
  joint_vectors(0, writer);
  return writer.take();
}

void reflect(const MirrorMap& map, const float* in, float* out) {
  for (int k = 0; k < map.size(); ++k) out[k] = map.sign[k] * in[map.from[k]];
}

}  // namespace mimicx::rl::tracking

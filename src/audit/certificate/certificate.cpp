#include "audit/certificate/certificate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "audit/certificate/sha256.h"
#include "core/bits.h"
#include "core/error.h"
#include "core/file.h"
#include "files/archive_members.h"
#include "motion/clip_file.h"
#include "physics/joint_torques.h"
#include "physics/lanes.h"
#include "physics/step.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::audit {
namespace {

constexpr std::string_view kMagic = "MIMICERT";
constexpr std::uint32_t kVersion = 6;
constexpr std::size_t kFixed = 64, kHash = 32;
constexpr double kEdge = 1e-6;  ///< of touching, within which float32 decides, m
constexpr std::size_t kPoints = 37, kPlateNumbers = 8;
constexpr std::size_t kState = 2 * 3 + 7 * kBodies, kNext = 3 + 3 * kBodies, kTargets = 7 * kJoints;
constexpr std::size_t kRecord = kState + kNext + kTargets + 3 * kJoints + 3 * kPoints;
constexpr std::size_t kHead = 11 + kBetas + 4 + 20 * kBodies + 5 * kPoints;

void append_integer(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i);
}
std::uint64_t integer_at(std::string_view bytes, std::size_t at, int size) {
  std::uint64_t value = 0;
  while (size-- > 0)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(size)]);
  return value;
}
void append_number(std::string& bytes, double value) {
  append_integer(bytes, mimicx::bit_cast<std::uint64_t>(value), 8);
}

/// Numbers in the order of the page.
struct Numbers {
  std::vector<double> values;
  void add(double v) { values.push_back(v); }
  void add(const Vector3d& v) { values.insert(values.end(), v.data(), v.data() + 3); }
  void add(const physics::Vec3<double>& v) { add(physics::to_eigen(v)); }
  void add(const physics::Quat<double>& q) { values.insert(values.end(), {q.w, q.x, q.y, q.z}); }
};

/// What the certificate claims of the motion as a whole.
struct Claims {
  double torque_share = 0, beyond = 0, pull = 0, push = 0, deepest = 0;
};

/// The state of a record with its bits, and the target.
struct Record {
  physics::State<double> state;
  physics::Target<double> target;
};

Record record_of(const rl::tracking::Substep& step) {
  Record record;
  record.state = rl::tracking::simulator_state(step.state);
  for (std::size_t i = 0; i < kBodies; ++i) {
    record.target.q[i] = physics::from_eigen(step.target_q[i]);
    record.target.omega[i] = physics::from_eigen(step.target_omega[i]);
  }
  return record;
}

void add_state(const physics::State<double>& s, Numbers& out) {
  out.add(s.p_root);
  for (const auto& q : s.q) out.add(q);
  out.add(s.v_root);
  for (const auto& w : s.omega) out.add(w);
}

physics::Quat<double> unit(const physics::Quat<double>& q) {
  return physics::from_eigen(physics::to_eigen(q).normalized());
}

/// Takes steps in double precision.
class Stepper {
 public:
  Stepper(const Character& character, const Scene& scene)
      : scene_(scene),
        model_(physics::make_model<double>(character, {}, scene)),
        data_(std::make_unique<physics::Data<double>>()),
        single_(physics::make_model<float>(character, {}, scene)),
        single_data_(std::make_unique<physics::Data<Packed>>()) {}

  /// Appends the record of a step; adds to the claims.
  void append(const Record& record, Numbers& out, Claims& claims) {
    physics::State<double> state = record.state;
    physics::Target<double> target = record.target;
    for (auto& q : state.q) q = unit(q);
    for (std::size_t i = 1; i < kBodies; ++i) target.q[i] = unit(target.q[i]);
    physics::Data<double>& d = *data_;
    const physics::State<double> before = state;
    physics::step(model_, target, state, d);
    if (agree_on_edges(record)) {
      state = before;
      physics::step(model_, target, state, d);
      model_.plates.resize(scene_.plates.count());
    }
    add_state(record.state, out);
    out.add(state.v_root);
    for (const auto& w : state.omega) out.add(w);
    for (int i = 1; i < kBodies; ++i) out.add(record.target.q[i]);
    for (int i = 1; i < kBodies; ++i) out.add(record.target.omega[i]);
    for (int i = 1; i < kBodies; ++i) {
      const auto torque = transpose_times(d.R_WB[i], physics::applied_pd_torque(d, i));
      claims.torque_share = std::max(claims.torque_share, norm(torque) / model_.torque_limit[i]);
      out.add(torque);
    }
    add_forces(out, claims);
  }

 private:
  using Packed = physics::Pack<physics::kLanes>;

  /// Lets the points that touch in float32 touch in double precision, and no others, where rounding decides:
  /// a point within kEdge of touching gets a plate of its own, which is a hair above it, or does not push.
  /// @return whether any differed, so that the step has to be taken again
  bool agree_on_edges(const Record& record) {
    auto state = physics::in_all_lanes<Packed>(record.state);
    physics::step(single_, physics::in_all_lanes<Packed>(record.target), state, *single_data_);
    std::array<bool, kPoints> in_single{}, in_double{};
    for (int k = 0; k < single_data_->ground_count; ++k)
      in_single[static_cast<std::size_t>(single_data_->ground[k].index)] = true;
    for (int k = 0; k < data_->ground_count; ++k)
      in_double[static_cast<std::size_t>(data_->ground[k].index)] = true;
    bool differs = false;
    for (int n = 0; n < model_.contacts.count(); ++n) {
      const auto at = static_cast<std::size_t>(n);
      if (in_single[at] == in_double[at] || model_.plates.count() == kMaxPlates) continue;
      const ContactPoint& point = model_.contacts[n];
      Vector3d place = physics::to_eigen(data_->p_WB[point.body] +
                                         data_->R_WB[point.body] * physics::from_eigen(point.p_B));
      place.z() -= point.radius;
      const Plate* under = scene_.plate_under(place, Scene::kReach);
      const Plate ground = under != nullptr ? *under : Plate{};  // the floor is a plate of height 0
      if (std::abs(ground.height + model_.config.skin - place.z()) > kEdge) continue;
      constexpr double kHalf = 1e-7, kHair = 1e-13, kDeep = 1.0;  // m
      const bool touches = in_single[at];
      const double height = (touches ? place.z() - model_.config.skin : ground.height) + kHair;
      model_.plates.push_back({place.x(), place.y(), 1.0, 0.0, kHalf, kHalf, height,
                               touches ? ground.stiffness : 0.0, touches ? ground.damping : 0.0, kDeep});
      differs = true;
    }
    return differs;
  }

  void add_forces(Numbers& out, Claims& claims) const {
    std::array<Vector3d, kPoints> force;
    force.fill(Vector3d::Zero());
    for (int k = 0; k < data_->ground_count; ++k) {
      const physics::GroundContact<double>& c = data_->ground[k];
      const Vector3d f = physics::to_eigen(c.applied);
      force[static_cast<std::size_t>(model_.contact_source[c.index])] = f;
      const double push = std::max(f.z(), 0.0);
      claims.push += push;
      claims.pull += std::max(-f.z(), 0.0);
      claims.beyond += std::max(f.head<2>().norm() - model_.config.friction * push, 0.0);
      const Vector3d place = physics::to_eigen(data_->p_WB[model_.contacts[c.index].body] + c.arm);
      claims.deepest = std::max(claims.deepest, scene_.height_under(place) - place.z());
    }
    for (const Vector3d& f : force) out.add(f);
  }

  Scene scene_;
  physics::Model<double> model_;
  std::unique_ptr<physics::Data<double>> data_;
  physics::Model<float> single_;
  std::unique_ptr<physics::Data<Packed>> single_data_;
};

std::array<double, 11> constants_of(const physics::SimulationConfig& o) {
  return {o.rate, o.gravity,        o.ground_stiffness, o.ground_damping,  o.friction,     o.slip_speed,
          o.skin, o.self_stiffness, o.self_damping,     o.limit_stiffness, o.limit_damping};
}

void add_body(const Character& c, Numbers& out) {
  for (int i = 0; i < kBodies; ++i) {
    const JointParameters& j = c.joint[i];
    const Vector3d axis = (c.capsule[i].b_B - c.capsule[i].a_B).normalized();
    const double along = axis.dot(c.inertia_B[i] * axis), across = 0.5 * (c.inertia_B[i].trace() - along);
    out.add(c.joint_offset[i]);
    out.add(c.com_B[i]);
    for (const double v : {c.mass[i], along, across, j.kp, j.kd, j.armature, j.torque_limit}) out.add(v);
    out.add(c.capsule[i].a_B);
    out.add(c.capsule[i].b_B);
    out.add(c.capsule[i].radius);
  }
  for (const ContactPoint& point : c.contact_points) {
    out.add(point.body);
    out.add(point.p_B);
    out.add(point.radius);
  }
}

void add_plates(const Scene& scene, Numbers& out) {
  for (const Plate& p : scene.plates)
    for (const double v : {p.centre.x(), p.centre.y(), p.yaw, p.half_extents.x(), p.half_extents.y(),
                           p.height, p.stiffness, p.damping})
      out.add(v);
}

/// The largest difference between the motion's frames and the states that they should be: m and rad.
double frame_gap(const motion::Clip& clip, const SubstepMotion& motion, int stride) {
  const Vector3d rest = rest_pelvis(clip.body_model);
  double gap = 0.0;
  for (int t = 0; t < clip.frames(); ++t) {
    const std::size_t k = static_cast<std::size_t>(t) * static_cast<std::size_t>(stride);
    const motion::ReferenceFrame& state = k < motion.steps.size() ? motion.steps[k].state : motion.last;
    gap = std::max(gap, (clip.trans[t] + rest - state.p_root).norm());
    for (std::size_t i = 0; i < kBodies; ++i)
      gap =
          std::max(gap, log_map(exp_map(clip.rotations[t][i]).conjugate() * state.q[i].normalized()).norm());
  }
  return gap;
}

}  // namespace

std::string certificate_of(const SubstepMotion& motion, const CertifiedMotion& about) {
  const auto constants = constants_of(motion.simulation);
  if (constants != constants_of({}) || !motion.simulation.self_contact ||
      motion.simulation.passes != physics::SimulationConfig{}.passes)
    raise(std::invalid_argument("simulated with other settings than those of docs/certificate.md"));
  Numbers steps;
  steps.values.reserve(motion.steps.size() * kRecord + kState);
  Claims claims;
  Stepper stepper(motion.character, motion.scene);
  for (const rl::tracking::Substep& step : motion.steps) stepper.append(record_of(step), steps, claims);
  rl::tracking::Substep last;
  last.state = motion.last;
  last.target_q.fill(Quaterniond::Identity());
  last.target_omega.fill(Vector3d::Zero());
  add_state(record_of(last).state, steps);

  Numbers head;
  for (const double v : constants) head.add(v);
  for (const double v : motion.character.betas) head.add(v);
  const double push = std::max(claims.push, 1.0);
  for (const double v : {claims.torque_share, claims.beyond / push, claims.pull / push, claims.deepest})
    head.add(v);
  add_body(motion.character, head);
  add_plates(motion.scene, head);

  std::string bytes(kMagic);
  append_integer(bytes, kVersion, 4);
  append_integer(bytes, static_cast<std::uint64_t>(about.steps_per_frame), 4);
  append_integer(bytes, motion.steps.size(), 8);
  append_integer(bytes, static_cast<std::uint64_t>(motion.scene.plates.count()), 8);
  bytes += sha256(about.motion_bytes);
  for (const double v : head.values) append_number(bytes, v);
  for (const double v : steps.values) append_number(bytes, v);
  return bytes + sha256(bytes);
}

std::filesystem::path steps_of_motion(const std::filesystem::path& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path);
  for (auto motions = whole.parent_path(); motions.has_relative_path(); motions = motions.parent_path()) {
    const auto steps = motions.parent_path() / "substeps" / whole.lexically_relative(motions);
    if (std::filesystem::exists(steps)) return steps;
  }
  return {};
}

std::string certify_file(const std::filesystem::path& path) {
  const std::string name = path.stem().string(), bytes = read_file(path);
  const std::filesystem::path steps_path = steps_of_motion(path);
  if (steps_path.empty()) {
    const auto wanted = path.parent_path().parent_path() / "substeps" / path.filename();
    throw DataError(wanted.string(), "", "the physics steps of the motion (plan or adapt with --substeps)",
                    "no file");
  }
  const Npz npz = parse_npz(bytes, path.string()), steps = read_npz(steps_path);
  const SubstepMotion motion = read_substeps(steps);
  const motion::Clip clip = motion::clip_from(npz, name);
  if (clip.body_model != "mimicx" || clip.rest_joints || motion.rest_joints)
    throw DataError(path.string(), "body_model", "a body of our shapes, 'mimicx'",
                    "'" + clip.body_model + "'");
  if (clip.betas != motion.character.betas)
    throw DataError(path.string(), "betas", "the shape of its physics steps", "another shape");
  if (clip.scene != motion.scene)
    throw DataError(path.string(), "scene_plates", "the scene of its physics steps", "another scene");
  const double per_frame = motion.simulation.rate / clip.fps;
  const int stride = static_cast<int>(std::lround(per_frame));
  if (stride < 1 || std::abs(per_frame - stride) > 1e-6 ||
      static_cast<std::size_t>(clip.frames() - 1) * static_cast<std::size_t>(stride) != motion.steps.size())
    throw DataError(path.string(), "poses", "a frame every so many physics steps", "other numbers of frames");
  if (const double gap = frame_gap(clip, motion, stride); !(gap < 1e-5))
    throw DataError(path.string(), "poses", "the states of its physics steps",
                    "poses " + std::to_string(gap) + " m or rad from them");
  return certificate_of(motion, {bytes, stride});
}

CertificateReplay replay_certificate(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const auto refuse = [&](const std::string& found) {
    throw DataError(path.string(), "", "a certificate of version " + std::to_string(kVersion), found);
  };
  if (bytes.size() < kFixed + 8 * (kHead + kState) + kHash || !bytes.starts_with(kMagic))
    refuse("another file");
  if (integer_at(bytes, 8, 4) != kVersion) refuse("another version");
  const std::uint64_t count = integer_at(bytes, 16, 8), plates = integer_at(bytes, 24, 8);
  const std::uint64_t start = kFixed + 8 * (kHead + kPlateNumbers * plates);
  if (count < 1 || count > (1U << 24) || plates > kMaxPlates ||
      bytes.size() != start + 8 * (count * kRecord + kState) + kHash)
    refuse("a file of another length");
  if (sha256(std::string_view(bytes).substr(0, bytes.size() - kHash)) != bytes.substr(bytes.size() - kHash))
    refuse("a file whose hash differs");
  const auto number = [&](std::size_t at) { return mimicx::bit_cast<double>(integer_at(bytes, at, 8)); };
  std::array<double, kBetas> betas{};
  for (std::size_t k = 0; k < kBetas; ++k) betas[k] = number(kFixed + 8 * (11 + k));
  for (const double beta : betas)
    if (!(std::abs(beta) <= kMaxBeta)) refuse("a shape parameter beyond 5");

  Scene scene;
  for (std::size_t k = 0; k < plates; ++k) {
    const auto v = [&](std::size_t i) { return number(kFixed + 8 * (kHead + kPlateNumbers * k + i)); };
    scene.plates.push_back({{v(0), v(1)}, v(2), {v(3), v(4)}, v(5), v(6), v(7)});
  }
  require_scene(scene, path.string());

  const auto record_at = [&](std::uint64_t k) {
    auto at = static_cast<std::size_t>(start + 8 * kRecord * k);
    const auto next = [&] { return number(std::exchange(at, at + 8)); };
    const auto vector = [&](physics::Vec3<double>& v) { v.x = next(), v.y = next(), v.z = next(); };
    const auto quaternion = [&](physics::Quat<double>& q) {
      q.w = next(), q.x = next(), q.y = next(), q.z = next();
    };
    Record record;
    vector(record.state.p_root);
    for (auto& q : record.state.q) quaternion(q);
    vector(record.state.v_root);
    for (auto& w : record.state.omega) vector(w);
    if (k == count) return record;
    at += 8 * kNext;
    for (int i = 1; i < kBodies; ++i) quaternion(record.target.q[i]);
    for (int i = 1; i < kBodies; ++i) vector(record.target.omega[i]);
    return record;
  };
  using Packed = physics::Pack<physics::kLanes>;
  const Character character = make_character(betas);
  Stepper stepper(character, scene);
  const physics::Model<float> model = physics::make_model<float>(character, {}, scene);
  const auto data = std::make_unique<physics::Data<Packed>>();
  auto state = physics::in_all_lanes<Packed>(record_at(0).state);
  CertificateReplay replay;
  for (std::uint64_t k = 0; k < count; ++k, ++replay.steps) {
    const Record record = record_at(k);
    Numbers again, next, found;
    Claims claims;
    stepper.append(record, again, claims);
    for (std::size_t i = 0; i < kRecord; ++i)
      if (replay.first_step < 0 &&
          mimicx::bit_cast<std::uint64_t>(again.values[i]) !=
              integer_at(bytes, static_cast<std::size_t>(start + 8 * (kRecord * k + i)), 8))
        replay.first_step = replay.steps;
    physics::step(model, physics::in_all_lanes<Packed>(record.target), state, *data);
    add_state(record_at(k + 1).state, next);
    add_state(physics::lane_of(state, 0), found);
    if (replay.first_state < 0 && next.values != found.values) replay.first_state = replay.steps;
  }
  return replay;
}

}  // namespace mimicx::audit

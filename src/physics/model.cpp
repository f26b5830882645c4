#include "physics/model.h"

#include <algorithm>
#include <stdexcept>

#include "core/elementary.h"
#include "core/error.h"

namespace mimicx::physics {
namespace {

template <class Real>
Vec3<Real> convert(const Vector3d& v) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

void check(const SimulationConfig& o) {
  if (!(o.rate >= 30.0 && o.rate <= 10000.0))
    raise(std::invalid_argument("simulation rate must be 30..10000 Hz"));
  if (o.passes < 1 || o.passes > 20) raise(std::invalid_argument("simulation passes must be 1..20"));
  for (double positive : {o.ground_stiffness, o.ground_damping, o.slip_speed, o.max_speed, o.max_joint_speed})
    if (!(positive > 0.0))
      raise(std::invalid_argument("contact parameters and largest speeds must be positive"));
  for (double value : {o.friction, o.self_stiffness, o.self_damping, o.limit_stiffness, o.limit_damping})
    if (!(value >= 0.0)) raise(std::invalid_argument("contact parameters must not be negative"));
}

template <class Real>
void fill_joints(const Character& c, Model<Real>& m) {
  for (int i = 1; i < kBodies; ++i) {
    const JointParameters& j = c.joint[i];
    const bool hinge = is_hinge(i);
    m.kp[i] = static_cast<Real>(j.kp);
    m.kd[i] = static_cast<Real>(j.kd);
    m.armature[i] = static_cast<Real>(j.armature);
    m.torque_limit[i] = static_cast<Real>(j.torque_limit);
    m.axis[i] = hinge ? convert<Real>(hinge_axis(i)) : Vec3<Real>{0, 0, 0};
    const Vector3d centre = hinge ? Vector3d(j.centre.x() * hinge_axis(i)) : j.centre;
    const Quaterniond q = exp_map(centre);
    m.range_centre[i] = {static_cast<Real>(q.w()), static_cast<Real>(q.x()), static_cast<Real>(q.y()),
                         static_cast<Real>(q.z())};
    m.range_inverse[i] = convert<Real>(
        Vector3d(j.half_range.unaryExpr([](double half) { return 1.0 / (2.0 * sin(0.5 * half)); })));
  }
}

template <class Real>
void fill_contacts(const Character& c, Model<Real>& m) {
  for (int body = 0; body < kBodies; ++body)
    for (int k = 0; k < c.contact_points.count(); ++k)
      if (c.contact_points[k].body == body) {
        m.contacts.push_back(c.contact_points[k]);
        m.contact_source.push_back(k);
      }
  m.capsule = c.capsule;
  m.self_pairs = c.self_pairs;
  for (int body = 0; body < kBodies; ++body)
    if (std::any_of(m.self_pairs.begin(), m.self_pairs.end(),
                    [&](const auto& pair) { return pair[0] == body || pair[1] == body; }))
      m.capsule_bodies.push_back(body);
}

/// How far contact points can be from the joint centre of their body, and from the pelvis joint.
template <class Real>
void fill_spans(const Character& c, Model<Real>& m) {
  PerBody<double> chain{};
  for (int i = 1; i < kBodies; ++i) chain[i] = chain[kParents[i]] + c.joint_offset[i].norm();
  for (const ContactPoint& p : c.contact_points) {
    const double span = p.p_B.norm() + p.radius;
    m.contact_span[p.body] = std::max(m.contact_span[p.body], static_cast<Real>(span));
    m.span = std::max(m.span, static_cast<Real>(chain[p.body] + span));
  }
}

template <class Real>
void fill_plates(const Scene& scene, Model<Real>& m) {
  for (const Plate& p : scene.plates) {
    const auto real = [](double x) { return static_cast<Real>(x); };
    m.plates.push_back({real(p.centre.x()), real(p.centre.y()), real(cos(p.yaw)), real(sin(p.yaw)),
                        real(p.half_extents.x()), real(p.half_extents.y()), real(p.height), real(p.stiffness),
                        real(p.damping), real(kMostPlatePush / p.stiffness)});
  }
}

}  // namespace

template <class Real>
Model<Real> make_model(const Character& c, const SimulationConfig& config, const Scene& scene) {
  check(config);
  if (c.contact_points.count() > kMaxContacts)
    raise(std::invalid_argument("make_model: too many contact points"));
  require_scene(scene, "the scene");
  Model<Real> m{};
  m.config = config;
  m.dt = static_cast<Real>(1.0 / config.rate);
  for (int i = 0; i < kBodies; ++i) {
    m.joint_offset[i] = convert<Real>(c.joint_offset[i]);
    m.mass[i] = static_cast<Real>(c.mass[i]);
    m.com[i] = convert<Real>(c.com_B[i]);
    const Vector3d& d = c.com_B[i];
    const Matrix3d I =
        c.inertia_B[i] + c.mass[i] * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
    const auto e = [&](int row, int col) { return static_cast<Real>(I(row, col)); };
    m.inertia_o[i] = {e(0, 0), e(0, 1), e(0, 2), e(1, 1), e(1, 2), e(2, 2)};
  }
  fill_joints(c, m);
  fill_contacts(c, m);
  fill_spans(c, m);
  fill_plates(scene, m);
  return m;
}

template Model<float> make_model(const Character&, const SimulationConfig&, const Scene&);
template Model<double> make_model(const Character&, const SimulationConfig&, const Scene&);

}  // namespace mimicx::physics

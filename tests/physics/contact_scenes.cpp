#include "physics/contact_scenes.h"

#include <memory>

namespace mimicx::physics {

Snapshot snapshot_of(Scene scene, const Character& c, std::uint64_t lane) {
  Random r(71, {lane});
  Snapshot s = standing(c);
  const auto spin = [&](double speed) {
    for (int i = 0; i < kBodies; ++i)
      s.omega[i] =
          is_hinge(i) ? Vector3d(speed * r.normal() * hinge_axis(i)) : Vector3d(speed * random_vector(r));
  };
  if (scene == Scene::kFall) {
    s.v_root = random_vector(r);
    spin(0.5);
  }
  if (scene == Scene::kDrop) {
    s.q[0] = exp_map(0.3 * random_vector(r)) * s.q[0];
    s.p_root.z() += 1.0 - lowest_point(c, s);
  }
  if (scene == Scene::kThrow) {
    s.q[0] = exp_map(3.0 * random_vector(r));
    s.p_root.z() += 0.2 - lowest_point(c, s);
    s.v_root = 3.0 * random_vector(r);
    spin(3.0);
  }
  return s;
}

namespace {

double energy(const Character& c, const Data<Pack<kLanes>>& d, int lane, double gravity) {
  double sum = 0;
  for (int i = 0; i < kBodies; ++i) {
    const Quaterniond q = lane_of(d.q_WB[i], lane);
    const Vector3d w = lane_of(d.w[i], lane), arm = q * c.com_B[i], v = lane_of(d.v[i], lane) + w.cross(arm);
    const Vector3d w_B = q.conjugate() * w;
    sum += 0.5 * c.mass[i] * v.squaredNorm() + 0.5 * w_B.dot(c.inertia_B[i] * w_B) +
           c.mass[i] * gravity * (lane_of(d.p_WB[i], lane) + arm).z();
  }
  return sum;
}

}  // namespace

SceneReport run_scene(Scene scene, double rate, int passes) {
  using P = Pack<kLanes>;
  const Character c = make_character();
  SimulationConfig o;
  o.rate = rate;
  o.passes = passes;
  const auto s = std::make_unique<Simulation<P>>(c, o);
  for (int lane = 0; lane < kLanes; ++lane)
    set_lane(snapshot_of(scene, c, static_cast<std::uint64_t>(lane)), lane, s->state, s->target);
  SceneReport report;
  Array<double, kLanes> first{};
  double normal = 0, pull = 0, beyond = 0;
  for (int k = 0; k < static_cast<int>(3 * rate); ++k) {
    report.wrong = any(s->advance()) || report.wrong;
    for (int lane = 0; lane < kLanes; ++lane) {
      const double now = energy(c, s->data, lane, o.gravity);
      double& start = first[lane];
      if (k == 0) start = now;
      report.energy_ratio = std::max(report.energy_ratio, now / start);
      for (int n = 0; n < s->data.ground_count; ++n) {
        const GroundContact<P>& contact = s->data.ground[n];
        const Vector3d f = lane_of(contact.applied, lane);
        report.deepest = std::max(report.deepest, ScalarTraits<P>::get(contact.depth, lane) - o.skin);
        const double f_n = std::max(0.0, f.z());
        normal += f_n;
        pull += std::max(0.0, -f.z());
        beyond += std::max(0.0, f.head<2>().norm() - o.friction * f_n);
      }
    }
  }
  report.outside_cone = beyond / normal;
  report.adhesion = pull / normal;
  return report;
}

}  // namespace mimicx::physics

#include "physics/contact_scenes.h"

#include <algorithm>
#include <memory>

namespace mimicx::physics {

Snapshot snapshot_of(ContactScene scene, const Character& c, std::uint64_t lane) {
  Random r(71, {lane});
  Snapshot s = standing(c);
  const auto spin = [&](double speed) {
    for (int i = 0; i < kBodies; ++i)
      s.omega[i] =
          is_hinge(i) ? Vector3d(speed * r.normal() * hinge_axis(i)) : Vector3d(speed * random_vector(r));
  };
  if (scene == ContactScene::kFall) {
    s.v_root = random_vector(r);
    spin(0.5);
  }
  if (scene == ContactScene::kDrop) {
    s.q[0] = exp_map(0.3 * random_vector(r)) * s.q[0];
    s.p_root.z() += 1.0 - lowest_point(c, s);
  }
  if (scene == ContactScene::kThrow) {
    s.q[0] = exp_map(3.0 * random_vector(r));
    s.p_root.z() += 0.2 - lowest_point(c, s);
    s.v_root = 3.0 * random_vector(r);
    spin(3.0);
  }
  return s;
}

Energy energy_of(const Character& c, const Data<Pack<kLanes>>& d, int lane, double gravity) {
  Energy sum;
  for (int i = 0; i < kBodies; ++i) {
    const Quaterniond q = lane_of(d.q_WB[i], lane);
    const Vector3d w = lane_of(d.w[i], lane), arm = q * c.com_B[i], v = lane_of(d.v[i], lane) + w.cross(arm);
    const Vector3d w_B = q.conjugate() * w;
    sum.kinetic += 0.5 * c.mass[i] * v.squaredNorm() + 0.5 * w_B.dot(c.inertia_B[i] * w_B);
    sum.potential += c.mass[i] * gravity * (lane_of(d.p_WB[i], lane) + arm).z();
  }
  return sum;
}

SceneReport run_scene(ContactScene scene, double rate, int passes) {
  using P = Pack<kLanes>;
  const Character c = make_character();
  SimulationConfig o;
  o.rate = rate;
  o.passes = passes;
  const auto s = std::make_unique<Simulation<P>>(c, o);
  for (int lane = 0; lane < kLanes; ++lane)
    set_lane(snapshot_of(scene, c, static_cast<std::uint64_t>(lane)), lane, s->state, s->target);
  SceneReport report;
  Array<double, kLanes> first{}, last{};
  double normal = 0, pull = 0, beyond = 0, late = 0;
  const int steps = static_cast<int>(3 * rate), late_steps = static_cast<int>(0.5 * rate);
  for (int k = 0; k < steps; ++k) {
    report.wrong = any(s->advance()) || report.wrong;
    for (int lane = 0; lane < kLanes; ++lane) {
      const Energy e = energy_of(c, s->data, lane, o.gravity);
      const double now = e.kinetic + e.potential;
      double& start = first[lane];
      last[lane] = e.kinetic;
      if (k == 0) start = now;
      report.energy_ratio = std::max(report.energy_ratio, now / start);
      for (int n = 0; n < s->data.ground_count; ++n) {
        const GroundContact<P>& contact = s->data.ground[n];
        const Vector3d f = lane_of(contact.applied, lane);
        report.deepest = std::max(report.deepest, ScalarTraits<P>::get(contact.surface.depth, lane) - o.skin);
        const double f_n = std::max(0.0, f.z());
        normal += f_n;
        if (k >= steps - late_steps) late += f.z();
        pull += std::max(0.0, -f.z());
        beyond += std::max(0.0, f.head<2>().norm() - o.friction * f_n);
      }
    }
  }
  report.outside_cone = beyond / normal;
  report.adhesion = pull / normal;
  std::nth_element(last.begin(), last.begin() + kLanes / 2, last.end());
  report.kinetic = last[kLanes / 2];
  double mass = 0;
  for (const double m : c.mass) mass += m;
  report.load = late / (late_steps * kLanes * mass * o.gravity);
  return report;
}

}  // namespace mimicx::physics

// Six ways to linearise the floor's contacts beside the one of the simulator (docs/physics.md §4), judged as
// bench_contact judges that one: friction beyond the cone and pull on the ground in percent of the normal
// impulse, means of the violent scenes. At 240 Hz with one to four passes, at 480 Hz with one to three.
//   bench_linearisation
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "physics/contact_scenes.h"
#include "physics/step_in_parts.h"

namespace mimicx::tools {
namespace {

using P = physics::Pack<physics::kLanes>;
using FloorModel = physics::Model<physics::RealOf<P>>;
using Contact = physics::GroundContact<P>;

/// The first pass takes all of the law at the velocities that the accelerations of the step before predict.
/// These are still in `d`; before the first step they are zero.
struct StartAhead : physics::StepParts {
  static void linearise_first(const FloorModel& model, physics::Data<P>& d) {
    physics::relinearise_ground(model, P(1.0) > P(0.0), d);
  }
};

/// The first pass takes c_t there, who pushes and the spring at the start of the step.
struct FrictionAhead : physics::StepParts {
  static void linearise_first(const FloorModel& model, physics::Data<P>& d) {
    const auto start = d.ground;
    physics::relinearise_ground(model, P(1.0) > P(0.0), d);
    for (int k = 0; k < d.ground_count; ++k) {
      Contact& c = d.ground[k];
      const physics::MaskOf<P> pushes = start[k].W_n > P(0.0);
      c.f = physics::select<P>(pushes, {c.f.x, c.f.y, start[k].f.z}, physics::zero3<P>());
      c.W_t = physics::select(pushes, c.W_t, P(0.0));
      c.W_n = start[k].W_n;
    }
  }
};

/// Linearises like `step` and then takes another c_t for the contacts that push.
/// @param friction  (contact before, as `step` has it now, predicted velocity) to W_t = dt c_t
template <class Friction>
void relinearise_with(const FloorModel& model, const physics::MaskOf<P>& lanes, physics::Data<P>& d,
                      Friction&& friction) {
  const P dt(model.dt);
  const auto before = d.ground;
  physics::relinearise_ground(model, lanes, d);
  for (int k = 0; k < d.ground_count; ++k) {
    Contact& c = d.ground[k];
    const physics::Vec3<P> v_end =
        physics::add_scaled(c.velocity, dt, physics::point_acceleration(model, c, d));
    const P W_t = friction(before[k], c, v_end), c_t = W_t / dt;
    const physics::MaskOf<P> changes = lanes & (c.W_n > P(0.0));
    c.W_t = physics::select(changes, W_t, c.W_t);
    c.f.x = physics::select(changes, -c_t * c.velocity.x, c.f.x);
    c.f.y = physics::select(changes, -c_t * c.velocity.y, c.f.y);
  }
}

/// The geometric mean of the coefficient before and the new one; the new one where there was none.
struct HalfWay : physics::StepParts {
  static void linearise_again(const FloorModel& model, const physics::MaskOf<P>& lanes, physics::Data<P>& d) {
    relinearise_with(model, lanes, d, [](const Contact& before, const Contact& now, const physics::Vec3<P>&) {
      return physics::select(before.W_t > P(0.0), physics::sqrt(before.W_t * now.W_t), now.W_t);
    });
  }
};

/// The slip of c_t = μ f_n / slip is that of the mean of the last two predicted velocities; the first of all
/// is the one at the start of the step.
struct MeanVelocity : physics::StepParts {
  Array<physics::Vec3<P>, physics::kMaxContacts> last{};  ///< by GroundContact::index

  void linearise_first(const FloorModel&, const physics::Data<P>& d) {
    for (int k = 0; k < d.ground_count; ++k) {
      const Contact& c = d.ground[k];
      last[c.index] = c.velocity;
    }
  }
  void linearise_again(const FloorModel& model, const physics::MaskOf<P>& lanes, physics::Data<P>& d) {
    relinearise_with(model, lanes, d, [&](const Contact&, const Contact& now, const physics::Vec3<P>& v_end) {
      physics::Vec3<P>& v_last = last[now.index];
      Contact at_mean = now;
      physics::Vec3<P> v = P(0.5) * (v_last + v_end);
      v.z = v_end.z;
      physics::linearise_ground(model.config, P(model.dt), v, at_mean);
      v_last = v_end;
      return at_mean.W_t;
    });
  }
};

/// As if each point were a mass of its own: takes the friction of the pass before from the predicted slip,
/// lets friction on the cone act instead, and has c_t be the one that gives this friction at the slip left.
struct LocalMass : physics::StepParts {
  double mass;  ///< kg
  explicit LocalMass(double kg) : mass(kg) {}

  void linearise_again(const FloorModel& model, const physics::MaskOf<P>& lanes, physics::Data<P>& d) {
    const P m(mass), v_s_2(model.config.slip_speed * model.config.slip_speed);
    relinearise_with(model, lanes, d,
                     [&](const Contact& before, const Contact& now, const physics::Vec3<P>& v_end) {
                       const P slip_2 = physics::fma(v_end.x, v_end.x, v_end.y * v_end.y);
                       const P cone = now.W_t * physics::sqrt(slip_2 + v_s_2);  // μ f_n dt
                       const P without_friction = physics::sqrt(slip_2) * (P(1.0) + before.W_t / m);
                       const P slip_left = physics::max(without_friction - cone / m, P(0.0));
                       return cone / physics::sqrt(physics::fma(slip_left, slip_left, v_s_2));
                     });
  }
};

template <class Parts>
physics::SceneStep step_with(Parts parts) {
  return [parts](physics::ScenePack& s) mutable {
    physics::step_in_parts(s.model, s.target, s.state, s.data, parts);
    return physics::any(physics::gone_wrong(s.model, s.state));
  };
}

struct Row {
  const char* name;
  physics::SceneStep step;
};

/// "beyond the cone / adhesion"; a star where a lane was flagged.
void print_cell(const physics::SceneStep& step, double rate, int passes) {
  constexpr physics::Scene kScenes[] = {physics::Scene::kFall, physics::Scene::kDrop, physics::Scene::kThrow};
  double beyond = 0, adhesion = 0;
  bool wrong = false;
  for (physics::Scene scene : kScenes) {
    const physics::SceneReport r = physics::run_scene(scene, rate, passes, step);
    beyond += 100 * r.outside_cone / std::size(kScenes);
    adhesion += 100 * r.adhesion / std::size(kScenes);
    wrong = wrong || r.wrong;
  }
  std::printf("  %6.2f / %4.2f%c", beyond, adhesion, wrong ? '*' : ' ');
}

void print_table(const std::vector<Row>& rows, double rate, int most_passes) {
  std::printf("\n%-58s", (std::to_string(static_cast<int>(rate)) + " Hz").c_str());
  for (int passes = 1; passes <= most_passes; ++passes)
    std::printf("  %8d pass%s", passes, passes == 1 ? "  " : "es");
  std::printf("\n");
  for (const Row& row : rows) {
    std::printf("%-58s", row.name);
    for (int passes = 1; passes <= most_passes; ++passes) print_cell(row.step, rate, passes);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace mimicx::tools

int main() {
  using namespace mimicx::tools;
  const std::vector<Row> rows = {
      {"as it is", step_with(mimicx::physics::StepParts())},
      {"first pass at the velocity predicted by the step before", step_with(StartAhead())},
      {"c_t of the first pass there, the rest at the start", step_with(FrictionAhead())},
      {"c_t half way to its new value (geometric mean)", step_with(HalfWay())},
      {"c_t at the slip of the mean of the last two velocities", step_with(MeanVelocity())},
      {"c_t that brings the slip onto the cone, local mass 30 kg", step_with(LocalMass(30.0))},
      {"the same for 3 kg", step_with(LocalMass(3.0))}};
  std::printf("%d characters, 3 s; means of fall, drop and throw: beyond the cone / adhesion, percent\n",
              mimicx::physics::kLanes);
  print_table(rows, 240.0, 4);
  print_table(rows, 480.0, 3);
  return 0;
}

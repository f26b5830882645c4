// A character follows its motion by an exported policy in the project's own simulator: no files, no threads,
// no heap once it runs. The same source runs on a microcontroller without an operating system and on a PC;
// both print the same bits (tools/check_microcontroller). The policy is a header of `mimicx export-policy`,
// POLICY its namespace.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "machine.h"
#include "physics/control_interval.h"
#include "physics/lanes.h"
#include "policy.h"

namespace policy = POLICY;
using namespace mimicx;
using physics::ScalarTraits;

#ifdef __arm__
using T = physics::Pack<1>;
#else
using T = physics::Pack<physics::kLanes>;
#endif

namespace {

constexpr int kFrames = 150;  // five seconds at 30 frames per second
static_assert(policy::kFps == 30.0, "five seconds are counted in frames");

/// Source: Fowler, Noll and Vo's FNV-1a.
class Hash {
 public:
  void add(const float* values, int count) {
    for (int k = 0; k < count; ++k) {
      std::uint32_t bits;
      std::memcpy(&bits, &values[k], sizeof bits);
      value_ = (value_ ^ bits) * 16777619u;
    }
  }
  void add(const policy::State& s) {
    add(s.p_root, 3);
    add(s.v_root, 3);
    add(s.q[0], 4 * policy::kBodyCount);
    add(s.omega[0], 3 * policy::kBodyCount);
  }
  std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 2166136261u;
};

physics::Vec3<T> vector_of(const float* v) { return {T(v[0]), T(v[1]), T(v[2])}; }
physics::Quat<T> quaternion_of(const float* q) { return {T(q[0]), T(q[1]), T(q[2]), T(q[3])}; }

physics::State<T> to_simulator(const policy::State& s) {
  physics::State<T> out;
  out.p_root = vector_of(s.p_root);
  out.v_root = vector_of(s.v_root);
  for (int i = 0; i < kBodies; ++i) {
    out.q[i] = quaternion_of(s.q[i]);
    out.omega[i] = vector_of(s.omega[i]);
  }
  return out;
}

physics::Target<T> to_simulator(const policy::Targets& t) {
  physics::Target<T> out{};
  for (int i = 1; i < kBodies; ++i) {
    out.q[i] = quaternion_of(t.q[i]);
    out.omega[i] = vector_of(t.omega[i]);
  }
  return out;
}

policy::State from_simulator(const physics::State<T>& s) {
  const auto put = [](const physics::Vec3<T>& v, float* out) {
    out[0] = ScalarTraits<T>::get(v.x, 0);
    out[1] = ScalarTraits<T>::get(v.y, 0);
    out[2] = ScalarTraits<T>::get(v.z, 0);
  };
  policy::State out;
  put(s.p_root, out.p_root);
  put(s.v_root, out.v_root);
  for (int i = 0; i < kBodies; ++i) {
    const physics::Quat<T>& q = s.q[i];
    const T values[4] = {q.w, q.x, q.y, q.z};
    for (int k = 0; k < 4; ++k) out.q[i][k] = ScalarTraits<T>::get(values[k], 0);
    put(s.omega[i], out.omega[i]);
  }
  return out;
}

/// Distance of two places of the pelvis, mm: how well the motion is followed.
double distance(const policy::State& a, const policy::State& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += double(a.p_root[k] - b.p_root[k]) * double(a.p_root[k] - b.p_root[k]);
  return 1000.0 * __builtin_sqrt(sum);
}

Character body_of_policy() {
  std::array<double, kBetas> betas;
  for (std::size_t k = 0; k < betas.size(); ++k) betas[k] = double(policy::kShape[k]);
  return make_character(betas);
}

struct World {
  explicit World(const Character& character)
      : model(physics::make_model<float>(
            character,
            {.rate = policy::kPhysicsRate, .gravity = policy::kGravity, .friction = policy::kFriction})) {}
  physics::Model<float> model;
  physics::Data<T> scratch;
  physics::State<T> state;
  physics::Target<T> from, to;
};

}  // namespace

#ifndef __cpp_exceptions
void mimicx::stop(const char* message) {
  std::fprintf(stderr, "%s\n", message);
  std::exit(1);
}
#endif

int main() {
  const auto world = std::make_unique<World>(body_of_policy());
  const int substeps = static_cast<int>(policy::kPhysicsRate / policy::kFps);
  policy::State body = policy::reference(0);
  world->state = to_simulator(body);
  policy::Targets targets{};
  std::memcpy(targets.q, body.q, sizeof targets.q);
  std::memcpy(targets.omega, body.omega, sizeof targets.omega);
  world->from = to_simulator(targets);

  Hash hash;
  double worst = 0.0;
  Counted thinking, moving;
  const int last = policy::kFrames - 1 < kFrames ? policy::kFrames - 1 : kFrames;
  for (int t = 0; t < last; ++t) {
    thinking.begin();
    world->to = to_simulator(policy::follow(t, body));
    thinking.end();
    moving.begin();
    const auto wrong = physics::advance_interval<T>(world->model, {world->from, world->to, substeps},
                                                    world->state, world->scratch);
    moving.end();
    if (physics::any(wrong)) {
      std::printf("frame %d: the simulation went wrong\n", t + 1);
      return 1;
    }
    world->from = world->to;
    body = from_simulator(world->state);
    hash.add(body);
    const double d = distance(body, policy::reference(t + 1));
    worst = d > worst ? d : worst;
    if ((t + 1) % 15 == 0)
      std::printf("frame %3d: hash %08lx\n", t + 1, static_cast<unsigned long>(hash.value()));
  }
  std::printf("self test: %g\n", double(policy::self_test()));
  std::printf("pelvis: at most %.3f mm from the motion over %d frames\n", worst, last);
  print_counts(thinking, moving, substeps);
  return policy::self_test() == 0.0F && worst < 500.0 ? 0 : 1;
}

// One line per part of the numerical core: its name, and a hash of all bits of its results. In portable
// arithmetic (docs/porting.md) every machine and every compiler prints the same lines; tools/check_portable
// compares them. It needs only core, character, physics, control, nn and skin, so it is the first program to
// build on a new machine.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string_view>

#include "control/gains.h"
#include "control/linearisation.h"
#include "control/plan.h"
#include "core/bits.h"
#include "core/elementary.h"
#include "core/npz/npz_archive.h"
#include "core/random.h"
#include "nn/checkpoint.h"
#include "nn/mlp.h"
#include "physics/lanes.h"
#include "physics/step.h"
#include "skin/mannequin.h"

#ifndef __cpp_exceptions
void mimicx::stop(const char* message) {
  std::fprintf(stderr, "portable_hash: %s\n", message);
  std::exit(1);
}
#endif

namespace mimicx::tools {
namespace {

/// Source: Fowler, Noll and Vo's FNV-1a, over words of 64 bits.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 1099511628211u; }
  void add(double x) { add(mimicx::bit_cast<std::uint64_t>(x)); }
  void add(const Vector3d& v) {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const physics::Quat<double>& q) {
    for (const double x : {q.w, q.x, q.y, q.z}) add(x);
  }
  void add(const physics::State<double>& s) {
    add(physics::to_eigen(s.p_root));
    add(physics::to_eigen(s.v_root));
    for (int i = 0; i < kBodies; ++i) {
      add(s.q[i]);
      add(physics::to_eigen(s.omega[i]));
    }
  }
  void add(std::string_view bytes) {
    for (const char c : bytes) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

void print(const char* part, const Hash& hash) {
  const auto half = [&](int shift) {
    return static_cast<unsigned long>(hash.value() >> shift & 0xffffffffu);
  };
  std::printf("%-22s %08lx%08lx\n", part, half(32), half(0));  // small C libraries print no 64 bits
  std::fflush(stdout);
}

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "portable_hash: %s\n", what);
  std::exit(1);
}

Vector3d random_vector(Random& random, double size) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return size * Vector3d(x, y, z);
}

Hash elementary_functions() {
  Random random(1, {});
  Hash hash;
  for (int i = 0; i < 20'000; ++i) {
    const double x = random.uniform(-10.0, 10.0), y = random.normal(), far = x * pow(10.0, i % 300);
    const auto [sine, cosine] = sin_cos(far);
    for (const double value :
         {y, exp(x), log(std::abs(far)), log10(std::abs(x)), log1p(std::abs(x)), sine, cosine, tan(x),
          asin(0.1 * x), acos(0.1 * x), atan2(x, y), hypot(x, y), pow(std::abs(x), y)})
      hash.add(value);
  }
  return hash;
}

/// Thrown at the floor with limbs across each other.
physics::State<double> thrown(std::uint64_t lane) {
  Random random(2, {lane});
  physics::State<double> x;
  x.p_root = {0.0, 0.0, 1.0};
  x.v_root = physics::from_eigen(random_vector(random, 2.0));
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d turn = random_vector(random, 0.5), spin = random_vector(random, 3.0);
    const Vector3d axis = is_hinge(i) ? hinge_axis(i) : Vector3d::Ones();
    x.q[i] = physics::from_eigen(exp_map(turn.cwiseProduct(axis)));
    x.omega[i] = physics::from_eigen(spin.cwiseProduct(axis));
  }
  return x;
}

/// 1,000 steps, towards other poses twelve times a second.
template <class T>
Hash violent_fall(bool& met_itself) {
  using Traits = physics::ScalarTraits<T>;
  const auto model = physics::make_model<physics::RealOf<T>>(make_character());
  const auto data = std::make_unique<physics::Data<T>>();
  physics::State<T> state;
  physics::Target<T> target;
  for (int lane = 0; lane < Traits::kSize; ++lane)
    physics::set_lane(state, lane, thrown(static_cast<std::uint64_t>(lane)));
  Hash hash;
  for (int k = 0; k < 1000; ++k) {
    if (k % 20 == 0)
      for (int lane = 0; lane < Traits::kSize; ++lane) {
        const physics::State<double> goal = thrown(static_cast<std::uint64_t>(1000 + 50 * lane + k / 20));
        for (int i = 0; i < kBodies; ++i) {
          physics::set_lane(target.q[i], lane, physics::to_eigen(goal.q[i]));
          physics::set_lane(target.omega[i], lane, Vector3d::Zero());
        }
      }
    if (physics::any(physics::step(model, target, state, *data))) fail("a character ran away");
    for (int lane = 0; lane < Traits::kSize; ++lane) hash.add(physics::lane_of(state, lane));
    for (int i = 0; i < kBodies; ++i)
      met_itself = met_itself || physics::lane_of(data->self_wrench[i].f, 0).norm() > 0.0;
  }
  return hash;
}

nn::Matrix<float> random_rows(int rows, int columns) {
  Random random(3, {});
  nn::Matrix<float> x(rows, columns);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = static_cast<float>(random.normal());
  return x;
}

nn::Mlp<float> policy() {
  Random random(4, {});
  return nn::make_mlp<float>({570, 128, 128, kDofs}, 0.1f, random);
}

Hash forward_pass() {
  const nn::Mlp<float> mlp = policy();
  nn::Workspace<float> workspace;
  nn::Matrix<float> y;
  Hash hash;
  for (const int rows : {1, 37}) {
    nn::evaluate(mlp, random_rows(rows, mlp.inputs()), workspace, y);
    for (Eigen::Index i = 0; i < y.size(); ++i) hash.add(double{y.data()[i]});
  }
  return hash;
}

/// Upright with slightly bent knees, arms swinging.
physics::State<double> swaying(int frame) {
  physics::State<double> x;
  const double knee = 0.3, phase = 0.2 * frame;
  x.q.fill({1.0, 0.0, 0.0, 0.0});
  x.omega.fill(physics::zero3<double>());
  x.v_root = physics::zero3<double>();
  x.p_root = {0.0, 0.0, 0.951 - 0.784 * (1.0 - cos(0.5 * knee))};
  const auto turn = [&](int body, const Vector3d& r) { x.q[body] = physics::from_eigen(exp_map(r)); };
  turn(kPelvis, {std::numbers::pi / 2, 0, 0});
  for (int side = 0; side < 2; ++side) {
    turn(kLeftHip + side, {-0.5 * knee, 0, 0});
    turn(kLeftKnee + side, {knee, 0, 0});
    turn(kLeftAnkle + side, {-0.5 * knee, 0, 0});
  }
  turn(kLeftShoulder, {0, 0, -1.2 + 0.4 * sin(phase)});
  turn(kRightShoulder, {0, 0, 1.2 - 0.4 * sin(phase)});
  return x;
}

control::System system_of(int frames) {
  List<physics::State<double>> reference;
  for (int t = 0; t < frames; ++t) reference.push_back(swaying(t));
  return control::make_system(make_character(), {}, std::move(reference), 30.0);
}

Hash linearisation() {
  const control::System system = system_of(2);
  const auto scratch = std::make_unique<control::LinearisationScratch>();
  control::FramePoint point{0, control::as_floats(system.at(0)), {}, {}};
  Hash hash;
  for (const control::FrameMatrix& F :
       {control::linearise(system, point, *scratch), control::linearise_smoothed(system, point, {})})
    for (Eigen::Index i = 0; i < F.size(); ++i) hash.add(double{F.data()[i]});
  return hash;
}

control::Plan plan_of(const control::System& system) {
  control::Plan plan = control::make_plan(system, {});
  if (plan.ending != control::Ending::kFollowed) fail("the plan lost its reference");
  return plan;
}

/// The plan and its feedback gains.
Hash hash_of(const control::System& system, const control::Plan& plan) {
  Hash hash;
  for (const auto& x : plan.states) hash.add(x);
  for (const auto& u : plan.residuals)
    for (const float value : u) hash.add(double{value});
  const control::Cost cost = control::make_cost(system, {});
  for (const Eigen::MatrixXf& K : control::feedback_gains(system, cost, control::trajectory_of(plan), {}, {}))
    for (Eigen::Index i = 0; i < K.size(); ++i) hash.add(double{K.data()[i]});
  hash.add(plan.cost);
  return hash;
}

Hash archive(const control::Plan& plan) {
  Npz archive;
  nn::save(archive, "policy.", policy());
  std::vector<double> heights;
  for (const auto& x : plan.states) heights.push_back(x.p_root.z);
  archive.set("heights", NpyArray::from_double({heights.size()}, heights.data()));
  archive.set("names", NpyArray::from_text({"pelvis", "Ärmel"}));
  Hash hash;
  hash.add(std::string_view(format_npz(archive)));
  return hash;
}

Hash skin_of_a_body() {
  const skin::Mesh mesh = skin::mannequin(make_character(), 3000, 0.03);
  Hash hash;
  for (const Vector3d& vertex : mesh.vertices) hash.add(vertex);
  for (const skin::Triangle& triangle : mesh.triangles)
    for (const int vertex : triangle) hash.add(static_cast<std::uint64_t>(vertex));
  for (const auto& weights : mesh.weights)
    for (const double weight : weights) hash.add(weight);
  return hash;
}

int run() {
  std::printf("%-22s %s\n", "arithmetic", kArithmetic);
  print("elementary functions", elementary_functions());
  bool met_itself = false;
  print("fall, double", violent_fall<double>(met_itself));
  print("fall, pack", violent_fall<physics::Pack<physics::kLanes>>(met_itself));
  if (!met_itself) fail("no fall had self contact");
  print("forward pass", forward_pass());
  print("linearisation", linearisation());
  const control::System system = system_of(30);
  const control::Plan plan = plan_of(system);
  print("plan of 30 frames", hash_of(system, plan));
  print("archive", archive(plan));
  print("skin", skin_of_a_body());
  return 0;
}

}  // namespace
}  // namespace mimicx::tools

int main() { return mimicx::tools::run(); }

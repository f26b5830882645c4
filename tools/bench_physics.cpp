// Speed of the simulator on one core: character-steps per second for double and for the training pack, self
// contact on and off, one to three passes; beside MuJoCo's mj_step of the same character where that library
// is installed. 240 Hz; every roll-out starts standing, with small random joint velocities, and is started
// again after two seconds, in which it has sunk, fallen and come to lie. The PD target is the pose of the
// start. Best of the repetitions, by processor time. Ends with the ratios to MuJoCo.
//   bench_physics [any option of Google Benchmark]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "core/random.h"
#include "physics/lanes.h"
#include "physics/step.h"
#ifdef MIMICX_HAVE_MUJOCO
#include "oracles/mujoco_character.h"
#endif

namespace mimicx::tools {
namespace {

constexpr int kStepsPerRollout = 480;

/// Where a roll-out starts: arms down, joint velocities of 0.3 rad/s.
struct Start {
  Vector3d p_root{0, 0, 0.951};
  PerBody<Quaterniond> q;
  PerBody<Vector3d> omega;

  explicit Start(std::uint64_t number) {
    Random random(1, {number});
    for (int i = 0; i < kBodies; ++i) {
      q[i] = Quaterniond::Identity();
      const double x = 0.3 * random.normal(), y = 0.3 * random.normal(), z = 0.3 * random.normal();
      omega[i] = is_hinge(i) ? Vector3d(x * hinge_axis(i)) : Vector3d(x, y, z);
    }
    q[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0, 0));
    q[kLeftShoulder] = exp_map(Vector3d(0, 0, -1.2));
    q[kRightShoulder] = exp_map(Vector3d(0, 0, 1.2));
  }
};

template <class T>
void simulate(benchmark::State& timer, bool self_contact, int passes) {
  physics::SimulationConfig config;
  config.self_contact = self_contact;
  config.passes = passes;
  const auto model = physics::make_model<physics::RealOf<T>>(make_character(), config);
  const auto start = std::make_unique<physics::State<T>>(), state = std::make_unique<physics::State<T>>();
  const auto target = std::make_unique<physics::Target<T>>();
  const auto data = std::make_unique<physics::Data<T>>();
  for (int lane = 0; lane < physics::ScalarTraits<T>::kSize; ++lane) {
    const Start s(static_cast<std::uint64_t>(lane));
    physics::set_lane(start->p_root, lane, s.p_root);
    physics::set_lane(start->v_root, lane, Vector3d::Zero());
    for (int i = 0; i < kBodies; ++i) {
      physics::set_lane(start->q[i], lane, s.q[i]);
      physics::set_lane(start->omega[i], lane, s.omega[i]);
      physics::set_lane(target->q[i], lane, s.q[i]);
      physics::set_lane(target->omega[i], lane, Vector3d::Zero());
    }
  }
  int k = 0;
  for (auto _ : timer) {
    if (k++ % kStepsPerRollout == 0) *state = *start;
    benchmark::DoNotOptimize(physics::step(model, *target, *state, *data));
  }
  timer.SetItemsProcessed(timer.iterations() * physics::ScalarTraits<T>::kSize);
}

#ifdef MIMICX_HAVE_MUJOCO
void simulate_mujoco(benchmark::State& timer) {
  test::MujocoCharacter mujoco(make_character(), {}, {.springs = true, .shapes = false});
  const Start start(0);
  for (int i = 1; i < kBodies; ++i) mujoco.set_target(i, start.q[i]);
  int k = 0;
  for (auto _ : timer) {
    if (k++ % kStepsPerRollout == 0) {
      mj_resetData(&mujoco.model(), &mujoco.data());
      mujoco.set_root(start.p_root, start.q[0], Vector3d::Zero(), start.omega[0]);
      for (int i = 1; i < kBodies; ++i) mujoco.set_joint(i, start.q[i], start.omega[i]);
    }
    mj_step(&mujoco.model(), &mujoco.data());
  }
  timer.SetItemsProcessed(timer.iterations());
}
#endif

/// Prints as usual and keeps the best rate of every benchmark.
class BestReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
        double& best = best_[run.run_name.function_name];
        best = std::max(best, run.counters.at("items_per_second").value);
      }
  }
  const std::map<std::string, double>& best() const { return best_; }

 private:
  std::map<std::string, double> best_;
};

void register_all() {
  const auto add = [](const std::string& name, auto function) {
    benchmark::RegisterBenchmark(name.c_str(), function)->MinTime(0.25)->Repetitions(5);
  };
  using P = physics::Pack<physics::kLanes>;
  for (bool self_contact : {false, true})
    for (int passes : {1, 2, 3}) {
      const std::string suffix =
          std::string(self_contact ? " self contact" : "") + ", passes " + std::to_string(passes);
      add("double" + suffix, [=](benchmark::State& s) { simulate<double>(s, self_contact, passes); });
      add("pack" + suffix, [=](benchmark::State& s) { simulate<P>(s, self_contact, passes); });
    }
#ifdef MIMICX_HAVE_MUJOCO
  add("mujoco", simulate_mujoco);
#endif
}

void print_summary(const std::map<std::string, double>& best) {
  const auto mujoco = best.find("mujoco");
  std::printf("\ncharacter-steps per second, best of the repetitions (%s, packs of %d)\n", MIMICX_TARGET,
              physics::kLanes);
  for (const auto& [name, rate] : best) {
    std::printf("  %-34s %10.0f", name.c_str(), rate);
    if (mujoco != best.end()) std::printf("  %7.1f x mj_step", rate / mujoco->second);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  mimicx::tools::register_all();
  mimicx::tools::BestReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  mimicx::tools::print_summary(reporter.best());
  return 0;
}

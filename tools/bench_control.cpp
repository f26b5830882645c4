// Time of planning per control frame (1/30 s) on one core: derivatives of every kind, the cost's quadratic
// model, the Riccati sweep, the line search; compared with MuJoCo's finite-difference derivatives of the same
// character if that library is installed. The character stands and sways on both feet; best of the
// repetitions, by processor time. Ends with the share of an iteration and the ratio to MuJoCo. bench_control
// [any option of Google Benchmark]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "control/receding_horizon.h"
#include "core/elementary.h"
#ifdef MIMICX_HAVE_MUJOCO
#include "oracles/mujoco_character.h"
#endif

namespace mimicx::tools {
namespace {

using namespace control;

constexpr int kFrames = 20;

/// Upright with slightly bent knees, arms moving.
physics::State<double> swaying(int frame) {
  physics::State<double> x;
  const double knee = 0.3, phase = 0.1 * frame;
  x.q.fill({1.0, 0.0, 0.0, 0.0});
  x.omega.fill(physics::zero3<double>());
  x.v_root = physics::zero3<double>();
  x.p_root = {0.0, 0.0, 0.951 - 0.784 * (1.0 - cos(0.5 * knee))};
  const auto turn = [&](int body, const Vector3d& r) {
    x.q[body] = physics::from_eigen(Quaterniond(exp_map(r)));
  };
  turn(kPelvis, {std::numbers::pi / 2, 0, 0});
  for (int side = 0; side < 2; ++side) {
    turn(kLeftHip + side, {-0.5 * knee, 0, 0});
    turn(kLeftKnee + side, {knee, 0, 0});
    turn(kLeftAnkle + side, {-0.5 * knee, 0, 0});
  }
  turn(kLeftShoulder, {0, 0, -1.2 + 0.3 * sin(phase)});
  turn(kRightShoulder, {0, 0, 1.2 - 0.3 * sin(phase)});
  return x;
}

struct Problem {
  control::System system;
  control::Cost cost;
  control::Trajectory plan;
  control::IterationState iterations;

  explicit Problem(bool assisted) : system(make(assisted)), cost(control::make_cost(system, {})) {
    plan.x.assign(kFrames + 1, physics::lane_of(physics::in_all_lanes<control::P>(system.at(0)), 0));
    plan.u.resize(kFrames);
    control::replay_controls(system, cost, plan);
    for (int i = 0; i < 3; ++i) control::improve({system, cost}, 0.2, 1, iterations, plan);
    control::build_models({system, cost}, plan, 1, iterations.models);
  }
  static control::System make(bool assisted) {
    std::vector<physics::State<double>> reference;
    for (int t = 0; t <= kFrames; ++t) reference.push_back(swaying(t));
    control::System system = control::make_system(make_character(), {}, std::move(reference), 30.0);
    system.assisted = assisted;
    return system;
  }
};

template <class F>
void per_frame(benchmark::State& timer, const F& frame) {
  int t = 0;
  for (auto _ : timer) frame(t++ % kFrames);
  timer.SetItemsProcessed(timer.iterations());
}

#ifdef MIMICX_HAVE_MUJOCO
/// A control frame is eight physics steps: eight matrices A of one step each, whose product is not counted.
void mujoco_derivatives(benchmark::State& timer) {
  test::MujocoCharacter mujoco(make_character(), {}, {.springs = true, .shapes = false});
  const physics::State<double> x = swaying(0);
  mujoco.set_root(physics::to_eigen(x.p_root), physics::to_eigen(x.q[0]), Vector3d::Zero(), Vector3d::Zero());
  for (int i = 1; i < kBodies; ++i) {
    const Quaterniond q = physics::to_eigen(x.q[i]);
    mujoco.set_target(i, q);
    mujoco.set_joint(i, q, Vector3d::Zero());
  }
  for (int i = 0; i < 100; ++i) mj_step(&mujoco.model(), &mujoco.data());  // onto the floor
  const int columns = 2 * mujoco.model().nv + mujoco.model().na;
  std::vector<mjtNum> A(static_cast<std::size_t>(columns * columns));
  for (auto _ : timer)
    for (int step = 0; step < 8; ++step)
      mjd_transitionFD(&mujoco.model(), &mujoco.data(), 1e-6, 1, A.data(), nullptr, nullptr, nullptr);
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
  /// Milliseconds per frame by name.
  double ms(const std::string& name) const {
    const auto found = best_.find(name);
    return found == best_.end() ? 0.0 : 1e3 / found->second;
  }

 private:
  std::map<std::string, double> best_;
};

void register_all(Problem& unassisted, Problem& assisted) {
  const auto add = [](const std::string& name, auto function) {
    benchmark::RegisterBenchmark(name.c_str(), function)->MinTime(0.2)->Repetitions(5);
  };
  const auto analytic = [&](const std::string& name, Problem& p) {
    add(name, [&p](benchmark::State& s) {
      const auto scratch = std::make_unique<control::LinearisationScratch>();
      per_frame(s, [&](int t) {
        benchmark::DoNotOptimize(control::linearise(p.system, p.plan.point(t), *scratch));
      });
    });
  };
  analytic("analytic", unassisted);
  analytic("analytic, assisted", assisted);
  add("smoothed", [&](benchmark::State& s) {
    per_frame(s, [&](int t) {
      benchmark::DoNotOptimize(control::linearise_smoothed(unassisted.system, unassisted.plan.point(t), {}));
    });
  });
  add("cost", [&](benchmark::State& s) {
    per_frame(s, [&](int t) {
      const physics::State<double>& x = unassisted.plan.x[t];
      benchmark::DoNotOptimize(control::state_quadratic(unassisted.system, unassisted.cost, t, x));
    });
  });
  add("sweep", [&](benchmark::State& s) {
    control::IterationState& state = unassisted.iterations;
    for (auto _ : s)
      control::sweep_back({unassisted.system, unassisted.cost, {}}, unassisted.plan, state.models, 0.0,
                          state.sweep);
    s.SetItemsProcessed(s.iterations() * kFrames);
  });
  add("line search", [&](benchmark::State& s) {
    for (auto _ : s)
      benchmark::DoNotOptimize(control::roll_out(unassisted.system, unassisted.cost, unassisted.plan,
                                                 unassisted.iterations.sweep.laws, control::step_lengths()));
    s.SetItemsProcessed(s.iterations() * kFrames);
  });
#ifdef MIMICX_HAVE_MUJOCO
  add("mujoco", mujoco_derivatives);
#endif
}

void print_summary(const BestReporter& r) {
  std::printf("\nms per control frame, best of the repetitions (%s, packs of %d), share of an iteration\n",
              MIMICX_TARGET, physics::kLanes);
  const double whole = r.ms("analytic") + r.ms("cost") + r.ms("sweep") + r.ms("line search");
  for (const char* name : {"analytic", "cost", "sweep", "line search"})
    std::printf("  %-16s %8.3f %6.1f %%\n", name, r.ms(name), 100.0 * r.ms(name) / whole);
  for (const char* name : {"analytic, assisted", "smoothed"})
    std::printf("  %-16s %8.3f\n", name, r.ms(name));
  if (r.ms("mujoco") > 0.0)
    std::printf("  %-16s %8.3f, mjd_transitionFD: %.0f x analytic\n", "mujoco", r.ms("mujoco"),
                r.ms("mujoco") / r.ms("analytic"));
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  mimicx::tools::Problem unassisted(false), assisted(true);
  mimicx::tools::register_all(unassisted, assisted);
  mimicx::tools::BestReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  mimicx::tools::print_summary(reporter);
  return 0;
}

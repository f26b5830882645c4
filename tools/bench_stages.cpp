// Where the time of a physics step goes, and what two cores give.
//
// Characters that are pushed over fall and come to lie (2 s, 240 Hz, two passes, self contact). A step is a
// function of its state, so every repetition does the same work: of every stage of every step the fastest of
// the repetitions counts, which keeps other programs of the machine out. Operations are counted on one
// character (counted.h); the peak is that of independent fused multiply-adds of the same type, measured here.
//   bench_stages
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "counted.h"
#include "physics/contact_scenes.h"
#include "physics/step_in_parts.h"

namespace mimicx::tools {
namespace {

constexpr int kSteps = 480, kRepetitions = 15;
constexpr const char* kStageNames[] = {"kinematics",   "self contact",      "floor",      "joints",
                                       "inertia pass", "acceleration pass", "integration"};

/// Calls `mark(stage)` at the end of every stretch of a stage.
template <class Mark>
struct Marked : physics::StepParts {
  Mark mark;
  explicit Marked(Mark m) : mark(m) {}
  void finished(physics::Stage stage) { mark(stage); }
};

template <class T>
std::unique_ptr<physics::Simulation<T>> falling() {
  const Character c = make_character();
  auto s = std::make_unique<physics::Simulation<T>>(c, physics::SimulationConfig{});
  for (int lane = 0; lane < physics::ScalarTraits<T>::kSize; ++lane)
    physics::set_lane(physics::snapshot_of(physics::Scene::kFall, c, static_cast<std::uint64_t>(lane)), lane,
                      s->state, s->target);
  return s;
}

using PerStage = Array<double, physics::kStages>;

/// Nanoseconds per step of T (all its lanes), mean over the scene.
template <class T>
PerStage measure_stages() {
  using Clock = std::chrono::steady_clock;
  std::vector<PerStage> best(kSteps);
  for (PerStage& b : best) b.fill(std::numeric_limits<double>::infinity());
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const auto s = falling<T>();
    for (PerStage& b : best) {
      PerStage spent{};
      auto last = Clock::now();
      Marked timed([&](physics::Stage stage) {
        const auto now = Clock::now();
        spent[stage] += std::chrono::duration<double, std::nano>(now - last).count();
        last = Clock::now();
      });
      physics::step_in_parts(s->model, s->target, s->state, s->data, timed);
      for (int i = 0; i < physics::kStages; ++i) b[i] = std::min(b[i], spent[i]);
    }
  }
  PerStage mean{};
  for (const PerStage& b : best)
    for (int i = 0; i < physics::kStages; ++i) mean[i] += b[i] / kSteps;
  return mean;
}

/// Operations of one character, mean over the scene.
PerStage count_stages() {
  const auto s = falling<Counted>();
  PerStage mean{};
  for (int k = 0; k < kSteps; ++k) {
    long last = Counted::operations;
    Marked counted([&](physics::Stage stage) {
      mean[stage] += static_cast<double>(Counted::operations - last) / kSteps;
      last = Counted::operations;
    });
    physics::step_in_parts(s->model, s->target, s->state, s->data, counted);
  }
  return mean;
}

/// Keeps the compiler from merging or skipping operations on x.
void keep(double& x) { asm volatile("" : "+x"(x)); }
void keep(physics::Pack<physics::kLanes>& x) { asm volatile("" : "+x"(x.v)); }

/// Operations per ns of chains of fused multiply-adds that do not wait for each other.
template <class T>
double fma_peak() {
  using Clock = std::chrono::steady_clock;
  using physics::fma;
  constexpr int kRounds = 20000, kChains = 10;  // more than latency times operations per cycle
  double best = 0;
  for (int repetition = 0; repetition < 200; ++repetition) {
    const T factor(0.999), term(0.001);
    T a(0.0), b(0.1), c(0.2), d(0.3), e(0.4), f(0.5), g(0.6), h(0.7), i(0.8), j(0.9);
    const auto advance = [&](T& x) {
      x = fma(x, factor, term);
      keep(x);
    };
    const auto start = Clock::now();
    for (int n = 0; n < kRounds; ++n) {
      advance(a), advance(b), advance(c), advance(d), advance(e);
      advance(f), advance(g), advance(h), advance(i), advance(j);
    }
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    best = std::max(best, 2.0 * kChains * kRounds * physics::ScalarTraits<T>::kSize / ns);
  }
  return best;
}

template <class T>
void print_stages(const char* name, const PerStage& operations) {
  const PerStage ns = measure_stages<T>();
  const double peak = fma_peak<T>();
  double total = 0, flops = 0;
  for (int i = 0; i < physics::kStages; ++i) total += ns[i], flops += operations[i];
  std::printf("\n%s (%s): fused multiply-adds alone reach %.1f Gflop/s\n", name, MIMICX_TARGET, peak);
  std::printf("%-18s %14s %8s %12s %10s %8s\n", "stage", "ns/character", "share", "operations", "Gflop/s",
              "of peak");
  const auto line = [&](const char* stage, double time, double count) {
    const double rate = count * physics::ScalarTraits<T>::kSize / time;
    std::printf("%-18s %14.0f %6.1f %% %12.0f %10.1f %6.1f %%\n", stage,
                time / physics::ScalarTraits<T>::kSize, 100 * time / total, count, rate, 100 * rate / peak);
  };
  for (int i = 0; i < physics::kStages; ++i) line(kStageNames[i], ns[i], operations[i]);
  line("step", total, flops);
}

/// Processor seconds of the calling thread.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Processor seconds per roll-out of a pack while `threads` of them run, best of the repetitions.
double seconds_per_rollout(int threads) {
  using P = physics::Pack<physics::kLanes>;
  double best = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 2 * kRepetitions; ++repetition) {
    List<double> spent(threads);
    parallel_for(threads, threads, [&](int chunk) {
      const auto s = falling<P>();
      const double start = thread_seconds();
      for (int k = 0; k < kSteps; ++k) physics::step(s->model, s->target, s->state, s->data);
      spent[chunk] = thread_seconds() - start;
    });
    double sum = 0;
    for (double seconds : spent) sum += seconds / threads;
    best = std::min(best, sum);
  }
  return best;
}

}  // namespace
}  // namespace mimicx::tools

int main() {
  const mimicx::tools::PerStage operations = mimicx::tools::count_stages();
  mimicx::tools::print_stages<double>("double", operations);
  mimicx::tools::print_stages<mimicx::physics::Pack<mimicx::physics::kLanes>>("pack", operations);
  const double one = mimicx::tools::seconds_per_rollout(1), two = mimicx::tools::seconds_per_rollout(2);
  std::printf("\ntwo cores: %.2f x one core (by processor time: %.2f and %.2f us per step of a pack)\n",
              2 * one / two, 1e6 * one / mimicx::tools::kSteps, 1e6 * two / mimicx::tools::kSteps);
  return 0;
}

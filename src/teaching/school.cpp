#include "teaching/school.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "nn/checkpoint.h"
#include "rl/ppo.h"
#include "rl/tracking/mirror.h"

namespace mimicx::teaching {
namespace {

enum SchoolStream : std::uint64_t { kVisitOrder = 0x5c00, kLessonRows };

/// Index of β in the state (rl/tracking/state.h) of policies without an encoder.
constexpr int kShapeBegin = rl::tracking::kPoseFeatures;

/// Index of a teacher, and whether its mirror image is used.
struct Visit {
  int teacher = 0;
  Side side = Side::kAsIs;
};

List<Visit> visits(const SchoolConfig& config, int count, int round) {
  List<int> order;
  List<Visit> out;
  std::int64_t shuffled = -1;
  for (int k = 0; k < config.packs; ++k) {
    const std::int64_t place = std::int64_t{round} * config.packs + k;
    if (place / count != shuffled) {
      shuffled = place / count;
      order.resize(static_cast<std::size_t>(count));
      std::iota(order.begin(), order.end(), 0);
      Random random(config.seed, {kVisitOrder, static_cast<std::uint64_t>(shuffled)});
      shuffle(order, random);
    }
    const int teacher = order[static_cast<int>(place % count)];
    const bool mirrored = config.mirror && (shuffled + teacher) % 2 != 0;
    out.push_back({teacher, mirrored ? Side::kMirrored : Side::kAsIs});
  }
  return out;
}

/// W of the mirrored motion. @param weights  [55][55]
Eigen::MatrixXf mirrored(const Eigen::MatrixXf& weights) {
  const rl::tracking::MirrorMap map = rl::tracking::mirror_of_action();
  Eigen::MatrixXf image(kDofs, kDofs);
  for (int i = 0; i < kDofs; ++i)
    for (int j = 0; j < kDofs; ++j)
      image(i, j) = map.sign[i] * map.sign[j] * weights(map.from[i], map.from[j]);
  return image;
}

/// The lessons of a round, and the cost of an action error in each.
struct Material {
  Lessons lessons;
  List<Eigen::MatrixXf> importance;  ///< [pack]
};

Material gather_material(const Teachers& teachers, int count, const rl::tracking::TrackingConfig& task,
                         const SchoolConfig& config, int threads, const Pupil& pupil) {
  const List<Visit> round = visits(config, count, pupil.rounds);
  Material material;
  material.importance = List<Eigen::MatrixXf>(config.packs);
  List<Lessons> taken(config.packs);
  parallel_for(config.packs, threads, [&](int pack) {
    const Teacher teacher = teachers(round[pack].teacher);
    const Side side = round[pack].side;
    Eigen::MatrixXf& importance = material.importance[pack];
    importance = config.weigh ? teacher.importance.front() : Eigen::MatrixXf::Identity(kDofs, kDofs);
    if (side == Side::kMirrored) importance = mirrored(importance);
    const auto before = static_cast<std::uint64_t>(pupil.rounds) * static_cast<std::uint64_t>(config.packs);
    const LessonKey key = {config.seed, before + static_cast<std::uint64_t>(pack)};
    taken[pack] =
        take_lessons(teacher, task, config.lessons, pupil.rounds > 0 ? &pupil.agent : nullptr, key, side);
    std::fill(taken[pack].weighed_by.begin(), taken[pack].weighed_by.end(), pack);
  });
  int rows = 0;
  for (const Lessons& lessons : taken) rows += lessons.rows();
  material.lessons.states.reserve(static_cast<std::size_t>(rows) *
                                  static_cast<std::size_t>(pupil.agent.actor.inputs()));
  for (Lessons& lessons : taken) append_lessons(std::exchange(lessons, {}), material.lessons);
  return material;
}

/// Gives β a huge variance: the normaliser maps it to zero, so that no weight on it has an effect.
void hide_shape(rl::Agent& agent) {
  constexpr double kBoundless = 1e60;
  agent.observations.moments.squares.segment(kShapeBegin, kBetas).setConstant(kBoundless);
  nn::refresh(agent.observations);
}

}  // namespace

Pupil untrained_pupil(const SchoolConfig& config, int state_size) {
  return {untrained_policy(state_size, config.hidden, config.seed)};
}

std::optional<SchoolRound> teach_round(const Teachers& teachers, int count,
                                       const rl::tracking::TrackingConfig& task, const SchoolConfig& config,
                                       const control::PlanControl& control, Pupil& pupil) {
  const Material material = gather_material(teachers, count, task, config, control.threads, pupil);
  Pupil next = pupil;
  if (next.rounds == 0) {
    scale_inputs(material.lessons, next.agent);
    if (!config.see_shape) hide_shape(next.agent);
  }
  SchoolRound stats;
  stats.round = next.rounds;
  stats.lessons = material.lessons.rows();
  stats.put_back = 1000.0 * material.lessons.put_back / stats.lessons;
  const int steps =
      std::max(1, static_cast<int>(std::lround(config.passes * stats.lessons / config.regression.minibatch)));
  Random random(config.seed, {kLessonRows, static_cast<std::uint64_t>(next.rounds)});
  const RegressionRound round = {next.rounds, config.rounds, steps, config.step_size, config.last_step_size};
  const auto loss = regression_round({material.lessons, material.importance}, round, config.regression,
                                     control, random, next);
  if (!loss) return {};
  stats.loss = *loss;
  ++next.rounds;
  next.taken += stats.lessons;
  pupil = std::move(next);
  return stats;
}

void save(Npz& archive, const std::string& prefix, const Pupil& pupil) {
  rl::save(archive, prefix + "agent.", pupil.agent);
  nn::save(archive, prefix + "adam.", pupil.adam);
  const auto number = [&](const char* name, double value) {
    archive.set(prefix + name, NpyArray::from_double({1}, &value));
  };
  number("rounds", pupil.rounds);
  number("taken", static_cast<double>(pupil.taken));
}

Pupil load_pupil(const Npz& archive, const std::string& prefix) {
  Pupil pupil;
  pupil.agent = rl::load_agent(archive, prefix + "agent.");
  pupil.adam = rl::load_moments(archive, prefix + "adam.", pupil.agent.actor);
  pupil.rounds = static_cast<int>(whole_number_at(archive, prefix + "rounds"));
  pupil.taken = whole_number_at(archive, prefix + "taken");
  return pupil;
}

}  // namespace mimicx::teaching

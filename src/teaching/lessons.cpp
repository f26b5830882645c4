#include "teaching/lessons.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/random.h"
#include "rl/tracking/mirror.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::teaching {
namespace {

using physics::kLanes;
using rl::tracking::TrackingPack;

enum LessonStream : std::uint64_t { kNoise = 0x7eac0, kPushes };

/// The mean actions of an agent for the lanes of a pack.
class Player {
 public:
  explicit Player(const rl::Agent& agent) : agent_(agent) {}

  LaneActions act(const nn::Matrix<float>& states) {
    LaneActions out;
    nn::normalise(agent_.observations, states, normalised_);
    nn::evaluate(agent_.actor, normalised_, workspace_, means_);
    for (int lane = 0; lane < kLanes; ++lane) std::copy_n(means_.row(lane).data(), kDofs, out[lane].begin());
    return out;
  }

 private:
  const rl::Agent& agent_;
  nn::Matrix<float> normalised_, means_;
  nn::Workspace<float> workspace_;
};

nn::Matrix<float> observed(const TrackingPack& pack) {
  nn::Matrix<float> states(kLanes, pack.clip().state_size());
  for (int lane = 0; lane < kLanes; ++lane) pack.observe(lane, states.row(lane).data());
  return states;
}

void write_down(const nn::Matrix<float>& states, const LaneActions& teacher, int frame, Lessons& out) {
  out.states.insert(out.states.end(), states.data(), states.data() + states.size());
  for (int lane = 0; lane < kLanes; ++lane) {
    out.actions.insert(out.actions.end(), teacher[lane].begin(), teacher[lane].end());
    out.weighed_by.push_back(frame);
  }
}

void reflect_rows(const rl::tracking::MirrorMap& map, nn::Matrix<float>& rows) {
  Eigen::RowVectorXf in(rows.cols());
  for (int k = 0; k < rows.rows(); ++k) {
    in = rows.row(k);
    rl::tracking::reflect(map, in.data(), rows.row(k).data());
  }
}

LaneActions reflected(const rl::tracking::MirrorMap& map, const LaneActions& actions) {
  LaneActions out;
  for (int lane = 0; lane < kLanes; ++lane)
    rl::tracking::reflect(map, actions[lane].data(), out[lane].data());
  return out;
}

/// Largest distance of a lane's body from that of the teacher in lane 0, m; infinite if the simulation
/// failed.
double distance_from_teacher(const TrackingPack& pack, int lane) {
  double worst = pack.worst_distance(lane);
  if (!std::isfinite(worst)) return worst;
  worst = 0.0;
  for (int body = 0; body < kBodies; ++body)
    worst = std::max(worst, (pack.pose(lane).p_WB[body] - pack.pose(0).p_WB[body]).norm());
  return worst;
}

}  // namespace

void append_lessons(const Lessons& more, Lessons& lessons) {
  lessons.states.insert(lessons.states.end(), more.states.begin(), more.states.end());
  lessons.actions.insert(lessons.actions.end(), more.actions.begin(), more.actions.end());
  lessons.weighed_by.insert(lessons.weighed_by.end(), more.weighed_by.begin(), more.weighed_by.end());
  lessons.put_back += more.put_back;
}

void scale_inputs(const Lessons& lessons, rl::Agent& agent) {
  const nn::Matrix<float> states =
      Eigen::Map<const nn::Matrix<float>>(lessons.states.data(), lessons.rows(), agent.actor.inputs());
  const nn::Moments moments = nn::moments_of(states);
  nn::update(agent.observations, std::span<const nn::Moments>(&moments, 1));
}

Lessons take_lessons(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                     const LessonConfig& config, const rl::Agent* student, const LessonKey& key, Side side) {
  const bool mirrored = side == Side::kMirrored;
  const rl::tracking::MirrorMap of_state = rl::tracking::mirror_of_state();
  const rl::tracking::MirrorMap of_action = rl::tracking::mirror_of_action();
  TrackingPack pack(teacher.clip, task);
  const auto scratch = std::make_unique<physics::Data<TrackingPack::P>>();
  std::optional<Player> player;
  if (student) player.emplace(*student);
  Random noise(key.seed, {kNoise, key.pack}), pushes(key.seed, {kPushes, key.pack});
  Lessons lessons;
  LaneActions before{}, own{};
  for (int t = 0; t < teacher.size(); ++t) {
    for (int lane = 1; lane < kLanes && t % config.push_every == config.push_every / 2; ++lane) {
      const double x = pushes.normal(), y = pushes.normal();
      pack.push(lane, config.push * Vector3d(x, y, 0.0));
    }
    nn::Matrix<float> states = observed(pack);
    if (mirrored) reflect_rows(of_state, states);
    const LaneActions advice = ask(teacher, t, pack.state(), before);
    write_down(states, mirrored ? reflected(of_action, advice) : advice, t, lessons);
    if (player) own = mirrored ? reflected(of_action, player->act(states)) : player->act(states);
    for (int lane = 0; lane < kLanes; ++lane) {
      Array<float, kDofs>& action = before[lane];
      action = player && lane >= config.teacher_lanes ? own[lane] : advice[lane];
      for (int k = 0; k < kDofs && lane > 0; ++k)
        action[k] += static_cast<float>(config.action_noise * noise.normal());
      pack.act(lane, action.data());
    }
    pack.advance(*scratch);
    for (int lane = 1; lane < kLanes; ++lane) {
      if (distance_from_teacher(pack, lane) < config.off_path) continue;
      pack.copy_lane(lane, pack, 0);
      before[lane] = before[0];
      ++lessons.put_back;
    }
  }
  return lessons;
}

control::PushResult test_pushes(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                const rl::tracking::TrackingConfig& task, const rl::Agent& agent,
                                const control::PushTest& test) {
  const auto scratch = std::make_unique<physics::Data<TrackingPack::P>>();
  const int n = clip->size() - 1;
  control::PushResult result;
  for (int done = 0; done < test.trials; done += kLanes) {
    TrackingPack pack(clip, task);
    Player player(agent);
    List<Random> random;
    for (int lane = 0; lane < kLanes; ++lane)
      random.emplace_back(test.seed,
                          std::initializer_list<std::uint64_t>{static_cast<std::uint64_t>(done + lane)});
    Array<int, kLanes> kept{};
    kept.fill(n);
    for (int t = 0; t < n; ++t) {
      for (int lane = 0; lane < kLanes && t % test.every == test.every / 2; ++lane) {
        const double angle = random[lane].uniform(0.0, 2.0 * std::numbers::pi);
        pack.push(lane, test.speed * Vector3d(cos(angle), sin(angle), 0.0));
      }
      const LaneActions actions = player.act(observed(pack));
      for (int lane = 0; lane < kLanes; ++lane) pack.act(lane, actions[lane].data());
      pack.advance(*scratch);
      for (int lane = 0; lane < kLanes; ++lane)
        if (!(pack.worst_distance(lane) <= test.failure_distance)) kept[lane] = std::min(kept[lane], t);
    }
    for (int lane = 0; lane < std::min(kLanes, test.trials - done); ++lane) {
      result.followed += kept[lane] == n ? 1 : 0;
      result.frames_kept += static_cast<double>(kept[lane]) / test.trials;
    }
  }
  return result;
}

}  // namespace mimicx::teaching

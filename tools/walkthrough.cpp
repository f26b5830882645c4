// One motion's way through the rooms, with its shapes and some of its numbers, for docs/architecture.md:
//   mimicx adapt --method options --options trained data/synthetic/test/noisy/walk_1.npz
//     --budget-samples 1200000 --out out/walk
//   walkthrough data/synthetic/test/noisy/walk_1.npz data/options out/walk
// Reads, fits and prepares the motion, lets the options of the folder act on it, follows one frame through
// state, action and reward, makes one iteration of joint fine-tuning, and lists the files that the run left.
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "files/archive_members.h"
#include "pipeline/options/arrangement.h"
#include "pipeline/options/option_rewards.h"
#include "pipeline/training_loop.h"
#include "program/configurations.h"
#include "record/run_folder.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/tracking/tracking_rollout.h"
#include "rl/trainer.h"
#include "run/preparation.h"

namespace mimicx::tools {
namespace {

constexpr int kFrame = 30;  ///< the frame that is followed, a second into the motion; headings name it

void heading(const char* room, const char* what) { std::printf("\n%s: %s\n", room, what); }

/// "  name  1.234 -0.567 …": the first numbers of a row.
template <class T>
void row(const char* name, std::span<const T> values, std::size_t first = 4) {
  std::printf("  %-38s", name);
  for (std::size_t k = 0; k < std::min(values.size(), first); ++k)
    std::printf(" %.3f", static_cast<double>(values[k]));
  std::printf("%s\n", values.size() > first ? " ..." : "");
}

std::string shape_of(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t k = 0; k < shape.size(); ++k) text += (k > 0 ? ", " : "") + std::to_string(shape[k]);
  return text + ")";
}

/// The parts behind each other, in lines of at most 100 characters.
void list(const std::vector<std::string>& parts) {
  std::string line = "   ";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::string part = " " + parts[k] + (k + 1 < parts.size() ? "," : "");
    if (line.size() + part.size() > 100) {
      std::printf("%s\n", line.c_str());
      line = "   ";
    }
    line += part;
  }
  std::printf("%s\n", line.c_str());
}

void list_file(const std::filesystem::path& path) {
  std::printf("  %-36s %ju bytes\n", path.c_str(), std::uintmax_t{std::filesystem::file_size(path)});
}

void list_members(const std::filesystem::path& path) {
  list_file(path);
  std::vector<std::string> parts;
  const Npz npz = read_npz(path);
  for (const auto& [name, array] : npz.members()) parts.push_back(name + " " + shape_of(array.shape));
  list(parts);
}

void list_values(const NamedValues& values) {
  std::vector<std::string> parts;
  char number[32];
  for (const auto& [name, value] : values) {
    std::snprintf(number, sizeof number, " %.3g", value);
    parts.push_back(name + number);
  }
  list(parts);
}

void tell_reference(const motion::Reference& reference) {
  heading("motion", "prepare_reference, 61 positions and 61 velocities per frame");
  std::printf("  %d frames at %.0f fps; frame %d:\n", reference.size(), reference.fps, kFrame);
  const motion::ReferenceFrame& frame = reference.frames.at(kFrame);
  std::vector<double> turns;
  for (int body = 1; body < kBodies; ++body) {
    const Vector3d turn = log_map(frame.q[body]);
    if (is_hinge(body))
      turns.push_back(turn.dot(hinge_axis(body)));
    else
      turns.insert(turns.end(), turn.data(), turn.data() + 3);
  }
  const Vector3d root = log_map(frame.q[kPelvis]);
  row<double>("pelvis [3], m", {frame.p_root.data(), 3});
  row<double>("its rotation [3], rad", {root.data(), 3});
  row<double>("joint rotations [55], rad", turns);
  const std::vector<double> velocities =
      files::velocities_member({frame}, files::Precision::kFloat64).to_double();
  const std::span<const double> all(velocities);
  row<double>("velocity of the pelvis [3], m/s", all.first(3));
  row<double>("its angular velocity [3], rad/s", all.subspan(3, 3));
  row<double>("joint velocities [55], rad/s", all.subspan(6));
}

/// What every option of the set earns on the clip, and the clip as those see it that are chosen.
pipeline::options::ArrangedClip tell_arrangement(
    const std::shared_ptr<const rl::tracking::TrackingClip>& clip, const pipeline::options::OptionSet& set,
    const rl::tracking::TrackingConfig& tracking, const pipeline::options::ArrangementConfig& config) {
  std::vector<const pipeline::options::Option*> all;
  for (const pipeline::options::TrainedOption& trained : set.options) all.push_back(&trained.option);
  const pipeline::options::SideBySide beside = pipeline::options::roll_out_side_by_side(
      pipeline::options::encoded_for(clip, all), tracking, all, config.rescue);
  heading("pipeline/options", "rewards r[t][c] of the options side by side, and the arrangement");
  std::printf("  %zu frames x %zu options\n", beside.rewards.size(), all.size());
  row<double>("rewards at frame 30 [options]", beside.rewards.at(kFrame), all.size());
  const pipeline::options::ArrangedClip arranged = pipeline::options::arrange(clip, tracking, set, config);
  for (const auto& [first, option] : pipeline::options::stretches_of(arranged.options))
    std::printf("  option %d from frame %d on\n", option, first);
  std::printf("  frames at which no option could follow: %zu\n", arranged.breaks.size());
  return arranged;
}

void tell_state(const rl::tracking::TrackingClip& clip, const rl::tracking::TrackingPack& pack,
                const std::vector<float>& seen) {
  heading("rl/tracking", "the state at frame 30, one frame after a start on the reference");
  std::vector<float> state(rl::tracking::kStateSize);
  const std::size_t next = kFrame + 1;
  rl::tracking::tracking_state(clip.poses[next], clip.joints[next], clip.reference.character.betas,
                               pack.pose(0), state.data());
  const std::span<const float> s(state);
  std::printf("  s_t [%d]:\n", rl::tracking::kStateSize);
  row("0    P_31: root height, m", s.subspan(0, 1));
  row("1    root rotation [6]", s.subspan(1, 6), 6);
  row("7    root velocity [3], m/s", s.subspan(7, 3));
  row("10   its angular velocity [3], rad/s", s.subspan(10, 3));
  row("13   joint rotations [106]", s.subspan(13, 106), 6);
  row("119  joint velocities [55], rad/s", s.subspan(119, 55), 6);
  row("174  wrists, balls of the feet [12], m", s.subspan(174, 12), 6);
  row("186  betas [10]", s.subspan(186, 10), 6);
  row("196  the simulated pose [186]", s.subspan(196, 186), 6);
  row("382  P_31 minus it [186]", s.subspan(382, 186), 6);
  row("568  root offset [2], m", s.subspan(568, 2));
  const int code = clip.encoded.front().code_size;
  std::printf("  as the option with its encoder sees it [%d]:\n", clip.state_size());
  row<float>(("0    z [" + std::to_string(code) + "]").c_str(), {seen.begin(), seen.begin() + code}, 6);
}

/// One frame: reset on the reference a frame before, state, mean action, one control step, reward.
void tell_frame(const pipeline::options::ArrangedClip& arranged,
                const rl::tracking::TrackingConfig& tracking) {
  const rl::tracking::TrackingClip& clip = *arranged.clip;
  const rl::tracking::MeanAction policy = rl::tracking::mean_action(arranged.agents);
  rl::tracking::TrackingPack pack(arranged.clip, tracking);
  const auto scratch = std::make_unique<physics::Data<rl::tracking::TrackingPack::P>>();
  std::vector<float> state(static_cast<std::size_t>(clip.state_size())), action(kDofs);
  for (int lane = 0; lane < physics::kLanes; ++lane) pack.reset(lane, kFrame - 1);
  const auto decide = [&] {
    pack.observe(0, state.data());
    policy(clip.option_at(pack.frame(0)), state.data(), action.data());
    for (int lane = 0; lane < physics::kLanes; ++lane) pack.act(lane, action.data());
  };
  decide();
  pack.advance(*scratch);
  decide();
  tell_state(clip, pack, state);

  heading("nn", "the mean action of the option that acts");
  row<float>("a_t [55], rad: left hip, right hip", action, 6);
  const int knee = first_dof(kLeftKnee);
  const double angle = log_map(clip.poses[kFrame + 1].frame.q[kLeftKnee]).dot(hinge_axis(kLeftKnee));
  const double residual = action[knee];
  std::printf("  target of the left knee: reference %.3f + action[%d] %.3f = %.3f rad\n", angle, knee,
              residual, angle + residual);

  heading("physics", "one control step");
  pack.advance(*scratch);
  std::printf("  %.0f physics steps of 1/%.0f s, %d passes each, %d characters in a pack\n",
              tracking.simulation.rate / clip.reference.fps, tracking.simulation.rate,
              tracking.simulation.passes, physics::kLanes);
  std::printf("  farthest body from its reference: %.1f mm\n", 1e3 * pack.worst_distance(0));

  heading("rl/tracking", "the reward of frame 31, factor by factor");
  const rl::tracking::Reward reward = pack.reward(0);
  for (std::size_t k = 0; k < reward.term.size(); ++k)
    std::printf("  %-38s %.3f\n", rl::tracking::kRewardTermNames[k].data(), reward.term[k]);
  std::printf("  %-38s %.3f\n", "their product", reward.total);
}

void tell_matrix(const char* name, Eigen::Index rows, Eigen::Index columns) {
  std::printf("    %-20s [%td x %td]\n", name, rows, columns);
}

void tell_training(const pipeline::options::ArrangedClip& arranged, const pipeline::TrainingConfig& config) {
  rl::tracking::TrackingEnvironment environment({arranged.clip}, config.tracking, config.characters,
                                                config.group_size, config.seed);
  rl::PpoTrainer trainer(config.ppo, pipeline::course_of(config), arranged.agents, environment);
  const rl::IterationStats stats = trainer.iterate(1);
  const rl::RolloutBuffer& buffer = trainer.buffer();
  const rl::GroupRollout& group = buffer.groups.front();
  heading("rl", "one iteration: the roll-out");
  std::printf("  %zu groups x %d steps x %d characters = %d rows; of each group:\n", buffer.groups.size(),
              buffer.horizon, buffer.group_size, buffer.rows());
  tell_matrix("observations", group.observations.rows(), group.observations.cols());
  tell_matrix("actions, means", group.actions.rows(), group.actions.cols());
  tell_matrix("rewards, values", group.rewards.rows(), group.rewards.cols());
  tell_matrix("advantages", group.advantages.rows(), group.advantages.cols());
  heading("rl", "advantages of character 0, its first steps");
  const auto of_first = [](const nn::Matrix<float>& all) {
    return std::vector<float>{all(0, 0), all(1, 0), all(2, 0), all(3, 0)};
  };
  row<float>("r_t", of_first(group.rewards));
  row<float>("V(s_t)", of_first(group.values));
  row<float>("A_t", of_first(group.advantages));
  heading("rl", "the update of the iteration");
  list_values({{"minibatches", static_cast<double>(stats.minibatches)},
               {"norm of the actor's gradient", stats.actor_gradient},
               {"of the critic's", stats.critic_gradient},
               {"share of clipped ratios", stats.clip_fraction},
               {"KL(old || new)", stats.kl},
               {"step size of the actor", stats.step_size},
               {"sigma", stats.sigma},
               {"mean softened reward of a step", stats.mean_reward}});
}

void tell_files(const record::RunFolder& folder, const std::string& name) {
  heading("run", "what the run wrote");
  const std::filesystem::path motion = folder.root / record::RunFolder::motion_name(name, true);
  list_members(std::filesystem::exists(motion) ? motion
                                               : folder.root / record::RunFolder::motion_name(name, false));
  for (const std::filesystem::path& path : {folder.fit(name), folder.reference(name), folder.log(name),
                                            folder.falls(name), folder.checkpoint(name), folder.manifest()})
    list_file(path);
}

void walk(const std::filesystem::path& file, const std::filesystem::path& options,
          const record::RunFolder& folder) {
  heading("the file", "what is in it");
  list_members(file);
  const run::PreparedMotion motion = run::prepare_motion(file, {}, {.fit = true});
  heading("import", "read_motion");
  std::printf("  %d frames at %.0f fps, body model %s\n", motion.input.frames(), motion.input.fps,
              motion.input.body_model.c_str());
  heading("fit", "fit_keypoints");
  list_values(motion.fit_values);
  tell_reference(motion.reference);
  list_values(motion.preparation_values);
  const program::AdaptConfig adapt = program::adapt_configuration();
  const pipeline::TrainingConfig& config = adapt.training;
  const auto clip = rl::tracking::make_tracking_clip(motion.reference, config.tracking);
  const pipeline::options::ArrangedClip arranged =
      tell_arrangement(clip, *pipeline::options::read_options(options), config.tracking, adapt.arrangement);
  tell_frame(arranged, config.tracking);
  tell_training(arranged, config);
  tell_files(folder, motion.reference.name);
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: walkthrough MOTION.npz OPTIONS_FOLDER RUN_FOLDER\n");
    return 2;
  }
  try {
    mimicx::tools::walk(argv[1], argv[2], mimicx::record::RunFolder{argv[3]});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "walkthrough: %s\n", error.what());
    return 1;
  }
}

// Target: archives other than plain motions: body models, options, policies, plans, gains, feasibility, and
// motions with the forces that `audit` and `convert` read.
#include "audit/audit_file.h"
#include "audit/load_sharing/load_sharing.h"
#include "audit/thrown.h"
#include "core/file.h"
#include "core/temporary_folder.h"
#include "files/motion_output.h"
#include "files/plan_file.h"
#include "files/policy_file.h"
#include "files/recorded_forces.h"
#include "fuzz/driver.h"
#include "fuzz/members.h"
#include "import/body_model.h"
#include "import/opensim/measured_forces.h"
#include "import/small_body_model.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"
#include "pipeline/options/constant_option.h"
#include "pipeline/options/option_set.h"
#include "record/feasibility_file.h"

namespace mimicx::fuzz::archives {
namespace {

/// The bytes that `write(path)` writes.
template <class Write>
Npz written(const Write& write) {
  const TemporaryFolder folder;
  write(folder.path / "sound.npz");
  return read_npz(folder.path / "sound.npz");
}

Npz options_file() {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(3), {});
  nn::AutoEncoderConfig encoder;
  encoder.hidden = encoder.code = encoder.steps = 2;
  pipeline::options::OptionSet set;
  pipeline::options::Option encoded =
      pipeline::options::constant_option(rl::tracking::kEncodedRest + encoder.code, 0.1f);
  encoded.encoder = nn::train_autoencoder(pipeline::options::encoder_inputs(*clip), encoder, 1);
  set.options.push_back({encoded, "walks", {}, 2, 1000});
  set.options.push_back({encoded, "stands", {}, 1, 500});
  return written([&](const auto& path) { pipeline::options::write_options(path, set); });
}

Npz policy_file() {
  files::StoredPolicy policy;
  const motion::Reference reference = rl::tracking::swaying_reference(3);
  policy.motion = reference;
  policy.states = rl::tracking::simulator_states(reference);
  policy.agent = rl::tracking::agent_that_does(0.1f, rl::tracking::kStateSize);
  return written([&](const auto& path) { files::write_policy(path, test::standing_clip(3, 0.9), policy); });
}

Npz plan_file() {
  files::StoredPlan plan;
  plan.reference = rl::tracking::simulator_states(rl::tracking::swaying_reference(3));
  plan.plan.states = plan.reference;
  plan.plan.residuals.resize(2);
  plan.plan.stage_assistance.resize(2);
  plan.plan.ending = control::Ending::kLost;
  plan.plan.failure = control::Failure{1, kLeftFoot, 0.41};
  return written([&](const auto& path) { files::write_plan(path, plan); });
}

Npz gains_file() {
  files::StoredGains gains;
  gains.gains.assign(1, Eigen::MatrixXf::Constant(kDofs, control::kMemory, 0.5f));
  gains.curvature = Eigen::MatrixXf::Identity(kDofs, kDofs);
  return written([&](const auto& path) { files::write_gains(path, gains); });
}

Npz feasibility_file() {
  record::FrameFeasibility all;
  all.mass = 70.0;
  all.need.assign(2, Vector6d::Constant(0.25));
  all.assistance.assign(1, Vector6d::Constant(0.5));
  all.wrong = PerFrame<std::string>(std::vector<std::string>{"feasible", "floats"});
  return written([&](const auto& path) { record::write_feasibility(path, all); });
}

const audit::Thrown& thrown() {
  static const audit::Thrown motion;
  return motion;
}

Npz substeps_file() {
  audit::SubstepMotion motion = thrown().steps();
  motion.last = motion.steps[2].state;
  motion.steps.resize(2);
  return written([&](const auto& path) { audit::write_substeps(path, motion); });
}

Npz forces_file() {
  constexpr std::size_t kFrames = 4;
  motion::Reference reference = thrown().reference;
  rl::tracking::TrackingRollout rollout = thrown().rollout;
  reference.frames.resize(kFrames), rollout.poses.resize(kFrames), rollout.forces.resize(kFrames);
  rollout.rewards.resize(kFrames);
  return written([&](const auto& path) {
    files::write_simulated(path, test::standing_clip(kFrames, 0.9), reference, rollout,
                           audit::sharing_members({kFrames, audit::LoadSharing::none()}));
  });
}

Npz plates_file() {
  const std::vector<double> rows(12, 1.0), joints(2 * kBodies * 3, 0.5);
  Npz npz;
  npz.path = "fuzz.npz";
  for (const char* name : {"grf_left", "grf_right", "cop_left", "cop_right"})
    npz.set(name, NpyArray::from_double({4, 3}, rows.data()));
  npz.set("valid", NpyArray::from_double({4, 2}, rows.data()));
  npz.set("joints", NpyArray::from_double({2, kBodies, 3}, joints.data()));
  for (const char* name : {"grf_fps", "fps", "mass"}) npz.set(name, NpyArray::scalar(60.0));
  return npz;
}

void audit_archive(const Npz& npz) { audit::audit_bytes(format_npz(npz), "fuzz.npz", false); }

const std::vector<Archive>& archives() {
  static const std::vector<Archive> all = {
      {test::SmallModel().file(), [](const Npz& npz) { import::body_model_from(npz).joints({1.0}); }},
      {options_file(), [](const Npz& npz) { pipeline::options::options_from(npz); }},
      {policy_file(), [](const Npz& npz) { files::policy_from(npz); }},
      {plan_file(), [](const Npz& npz) { files::plan_from(npz); }},
      {gains_file(), [](const Npz& npz) { files::gains_from(npz); }},
      {feasibility_file(), [](const Npz& npz) { record::feasibility_from(npz); }},
      {substeps_file(), audit_archive},
      {forces_file(), audit_archive},
      {plates_file(), [](const Npz& npz) { import::measured_forces_from(format_npz(npz), "fuzz.npz"); }},
      {forces_file(), [](const Npz& npz) { audit::read_sharing(npz, 4); }},
      {forces_file(), [](const Npz& npz) { files::recorded_forces(motion::clip_from(npz, "fuzz")); }}};
  return all;
}

}  // namespace

std::vector<std::string> seeds() { return seeds_of(archives()); }

void feed(const std::string& bytes) { feed_member(archives(), bytes); }

const Target target("archives", seeds, feed);

}  // namespace mimicx::fuzz::archives

// Target: checkpoints of training and teaching.
#include "fuzz/driver.h"
#include "fuzz/members.h"
#include "rl/ppo_fixture.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/trainer.h"
#include "teaching/school.h"

namespace mimicx::fuzz::checkpoints {
namespace {

using rl::tracking::TrackingEnvironment;

/// One pack of characters on a clip of three frames.
struct SmallTraining {
  TrackingEnvironment world{{rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(3), {})},
                            {},
                            physics::kLanes,
                            physics::kLanes,
                            1};
  rl::PpoTrainer<TrackingEnvironment> trainer{
      rl::ppo_for_tests(), {1, 1000}, {rl::tracking::agent_that_does(0.1f, rl::tracking::kStateSize)}, world};
};

Npz training_checkpoint() {
  Npz npz;
  SmallTraining().trainer.save(npz, "trainer.");
  return npz;
}

Npz teaching_checkpoint() {
  teaching::SchoolConfig school;
  school.hidden = {1, 1};
  Npz npz;
  teaching::save(npz, "", teaching::untrained_pupil(school));
  return npz;
}

const std::vector<Archive>& archives() {
  static const std::vector<Archive> all = {
      {training_checkpoint(), [](const Npz& npz) { SmallTraining().trainer.load(npz, "trainer."); }},
      {teaching_checkpoint(), [](const Npz& npz) { teaching::load_pupil(npz, ""); }}};
  return all;
}

}  // namespace

std::vector<std::string> seeds() { return seeds_of(archives()); }

void feed(const std::string& bytes) { feed_member(archives(), bytes); }

const Target target("checkpoints", seeds, feed);

}  // namespace mimicx::fuzz::checkpoints

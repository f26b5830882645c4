// A plan on disk: complete, exact, repeatable, and refused where it is damaged.
#include "files/plan_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <numbers>

#include "core/npz/npz.h"
#include "core/temporary_folder.h"

namespace mimicx::files {
namespace {

bool same_bits(const std::vector<physics::State<double>>& a, const std::vector<physics::State<double>>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// Upright, arms down, the head turned by an angle that no float is.
physics::State<double> standing() {
  physics::State<double> x{};
  x.p_root = physics::from_eigen(Vector3d(0.1, -0.2, 0.95));
  x.q.fill(physics::from_eigen(Quaterniond::Identity()));
  x.q[kPelvis] = physics::from_eigen(exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.0)));
  x.q[kHead] = physics::from_eigen(exp_map(Vector3d(0.0, 1.0 / 3.0, 0.0)));
  return x;
}

StoredPlan planned(int frames) {
  StoredPlan stored;
  stored.input_checksum = "0123456789abcdef";
  stored.simulation.friction = 0.7;
  stored.reference.assign(static_cast<std::size_t>(frames), standing());
  const control::System system =
      control::make_system(make_character(), stored.simulation, stored.reference, stored.fps);
  stored.plan = control::make_plan(system, {});
  return stored;
}

struct PlanFile : testing::Test {
  StoredPlan written(const StoredPlan& stored) {
    write_plan(file, stored);
    return read_plan(file);
  }
  TemporaryFolder folder;
  std::filesystem::path file = folder.path / "plan.npz";
};

TEST_F(PlanFile, RoundTripIsExact) {
  StoredPlan plan = planned(8);
  plan.plan.ending = control::Ending::kLost;
  plan.plan.failure = control::Failure{5, kLeftFoot, 0.41};
  plan.plan.stage_assistance = {{{0.5f, 1.0f / 3.0f, 0.0f, -2.0f, 0.0f, 0.0f}},
                                {{0.0f, 0.0f, 9.5f, 0.0f, 0.1f, 0.0f}}};
  plan.plan.by_assisted_stages = true;
  const StoredPlan back = written(plan);
  EXPECT_EQ(back.input_checksum, plan.input_checksum);
  EXPECT_EQ(back.fps, plan.fps);
  EXPECT_EQ(back.simulation.friction, 0.7);
  EXPECT_TRUE(same_bits(back.reference, plan.reference));
  EXPECT_TRUE(same_bits(back.plan.states, plan.plan.states));
  EXPECT_EQ(back.plan.residuals, plan.plan.residuals);
  EXPECT_EQ(back.plan.ending, plan.plan.ending);
  EXPECT_EQ(back.plan.cost, plan.plan.cost);
  EXPECT_EQ(back.plan.worst_distance, plan.plan.worst_distance);
  EXPECT_EQ(back.plan.iterations, plan.plan.iterations);
  EXPECT_EQ(back.plan.linearised, plan.plan.linearised);
  EXPECT_EQ(back.plan.backtracks, plan.plan.backtracks);
  ASSERT_TRUE(back.plan.failure);
  EXPECT_EQ(back.plan.failure->frame, 5);
  EXPECT_EQ(back.plan.failure->body, kLeftFoot);
  EXPECT_EQ(back.plan.failure->distance, 0.41);
  EXPECT_EQ(back.plan.stage_assistance, plan.plan.stage_assistance);
  EXPECT_TRUE(back.plan.by_assisted_stages);
}

TEST_F(PlanFile, RepeatsThePlanWithOnlyTheBodyAdded) {
  const StoredPlan stored = written(planned(8));
  EXPECT_FALSE(stored.plan.failure);
  EXPECT_TRUE(stored.plan.stage_assistance.empty());
  const control::System system =
      control::make_system(make_character(), stored.simulation, stored.reference, stored.fps);
  const auto scratch = std::make_unique<physics::Data<control::P>>();
  physics::State<control::P> x = physics::in_all_lanes<control::P>(stored.plan.states.at(0));
  physics::Target<control::P> from = control::target_of(system, 0, {});
  std::vector<physics::State<double>> states = {stored.plan.states[0]};
  for (std::size_t t = 0; t < stored.plan.residuals.size(); ++t) {
    control::Control u{};
    std::copy(stored.plan.residuals[t].begin(), stored.plan.residuals[t].end(), u.begin());
    const physics::Target<control::P> to = control::target_of(system, static_cast<int>(t) + 1, u);
    control::advance(system, from, to, control::assistance_of(system, {}), x, *scratch);
    states.push_back(physics::lane_of(x, 0));
    from = to;
  }
  EXPECT_TRUE(same_bits(states, stored.plan.states));
}

// Numbers that the field cannot hold, that are no body's, or that no simulation can have.
TEST_F(PlanFile, RejectsImpossibleNumbers) {
  StoredPlan plan = planned(4);
  plan.plan.failure = control::Failure{2, kLeftFoot, 0.41};
  written(plan);
  const Npz sound = read_npz(file);
  const auto refusal = [&](const std::string& name, double value) -> std::string {
    Npz damaged = sound;
    damaged.set(name, NpyArray::from_double({1}, &value));
    try {
      plan_from(damaged);
    } catch (const DataError& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{
           {"iterations", 0.5}, {"iterations", 1e12}, {"lost_body", 22}, {"lost_body", -2}})
    EXPECT_NE(refusal(name, value).find(name), std::string::npos) << name << ' ' << value;
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{{"physics_passes", 0},
                                                                               {"physics_passes", 2e9},
                                                                               {"physics_rate", -240},
                                                                               {"ground_stiffness", 0},
                                                                               {"slip_speed", -0.002}})
    EXPECT_NE(refusal(name, value).find("the settings of a simulation"), std::string::npos)
        << name << ' ' << value << ": " << refusal(name, value);
  EXPECT_NO_THROW(plan_from(sound));
}

TEST_F(PlanFile, GainsRoundTripExactlyAndRejectOtherShapes) {
  StoredGains stored;
  for (int t = 0; t < 3; ++t) stored.gains.push_back(Eigen::MatrixXf::Random(kDofs, control::kMemory));
  stored.curvature = Eigen::MatrixXf::Random(kDofs, kDofs);
  write_gains(file, stored);
  EXPECT_EQ(read_gains(file).gains, stored.gains);
  EXPECT_EQ(read_gains(file).curvature, stored.curvature);
  EXPECT_EQ(read_npz(file).at("gains").to_double()[control::kMemory],
            static_cast<double>(stored.gains[0](1, 0)));
  Npz npz;
  npz.set("gains", NpyArray::scalar(1.0));
  write_npz(file, npz);
  EXPECT_THROW(read_gains(file), DataError);
}

TEST_F(PlanFile, DamagedFileNamesTheMember) {
  StoredPlan plan = planned(4);
  plan.plan.stage_assistance.resize(3);
  const double one = 1.0;
  for (const char* member : {"residuals", "q", "v", "reference_q", "reference_v", "ending", "cost", "fps",
                             "soft_help", "physics_rate", "input_checksum"}) {
    write_plan(file, plan);
    Npz npz = read_npz(file);
    npz.set(member, NpyArray::from_double({3, 1}, std::vector<double>(3, one).data()));
    write_npz(file, npz);
    try {
      read_plan(file);
      ADD_FAILURE() << member;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find(member), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace mimicx::files

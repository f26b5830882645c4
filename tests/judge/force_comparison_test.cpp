#include "judge/forces/force_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/npz/npz.h"
#include "core/number_text.h"
#include "core/random.h"
#include "core/temporary_folder.h"
#include "core/units.h"
#include "files/archive_members.h"
#include "files/exchange/opensim.h"
#include "judge/forces/moment_comparison.h"
#include "judge/forces/paired_series.h"
#include "judge/forces/planar_moments.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"

namespace mimicx::judge {
namespace {

/// A standing body whose feet carry what a measurement says, pressed at points in front of the ankles.
struct Pressed {
  audit::SimulatedFrames motion;
  import::MeasuredForces measured;

  explicit Pressed(int frames, double forward = 0.08) {
    const motion::Clip clip = motion::standing_clip(frames);
    motion.character = motion::character_of(clip);
    measured.mass = motion.character.total_mass();
    measured.joints_fps = 30.0;
    const PerFrame<BodyPoses> poses = motion::poses_of(clip);
    for (int t = 0; t < frames; ++t) {
      motion::ReferenceFrame frame;
      frame.p_root = poses[t].p_WB[kPelvis];
      for (int b = 0; b < kBodies; ++b)
        frame.q[b] = b == 0 ? poses[t].q_WB[0] : exp_map(clip.rotations[t][b]);
      motion.frames.push_back(frame);
      rl::tracking::ActingForces acting;
      for (int b = 0; b < kBodies; ++b) {
        acting.joint_torque[b] = acting.range_torque[b] = Vector3d::Zero();
        acting.ground[b] = acting.self_contact[b] = Vector6d::Zero();
      }
      const auto moved = forward_kinematics(motion.character, frame.p_root, frame.q).p_WB;
      measured.joints.push_back(moved);
      for (int foot = 0; foot < 2; ++foot) {
        const Vector3d force = force_at(t, foot);
        Vector3d arm = forward * Vector3d::UnitY();  // the body looks along −y
        arm = -arm;
        arm.z() = -moved[kLeftAnkle + foot].z();
        acting.ground[kLeftAnkle + foot] << arm.cross(force), force;
      }
      motion.forces.push_back(acting);
    }
    for (int i = 0; i <= 10 * (frames - 1); ++i) {
      import::ForceSample sample;
      sample.time = i / 300.0;
      for (int foot = 0; foot < 2; ++foot) {
        sample.force[foot] = force_at((i + 9) / 10, foot);
        sample.pressure[foot] = measured.joints[0][kLeftAnkle + foot] - forward * Vector3d::UnitY();
        sample.pressure[foot].z() = 0.0;
      }
      measured.samples.push_back(sample);
    }
  }
  Vector3d force_at(int t, int foot) const {
    const double weight = kGravity * motion.character.total_mass();
    const double share = 0.5 + 0.2 * std::sin(0.4 * t) * (foot == 0 ? 1 : -1);
    return {0.01 * weight * (foot == 0 ? 1 : -1), 0.0, share * weight};
  }
};

ComparedMotion compared(const Pressed& pressed, double mass) {
  return compare_forces(pressed.motion, audit::load_sharing(pressed.motion), pressed.measured, mass);
}

std::map<std::string, double> values_of(const Pressed& pressed, double mass = NAN) {
  const std::vector<double> values = compared(pressed, mass).values;
  std::map<std::string, double> named;
  for (std::size_t k = 0; k < values.size(); ++k) named[force_columns()[k].name] = values[k];
  return named;
}

TEST(ForceComparison, EqualForcesHaveNoErrors) {
  const auto v = values_of(Pressed(30));
  EXPECT_EQ(v.at("n"), 27) << "without frames 0, 1 and the last";
  for (const char* name : {"totV", "totAP", "totML", "N/kg", "ftV", "ftAP", "ftML", "imp%", "copA", "copM",
                           "shr", "b", "wand", "mm"})
    EXPECT_NEAR(v.at(name), 0.0, 1e-3) << name;
  EXPECT_NEAR(v.at("ftV r"), 1.0, 1e-9);
  EXPECT_NEAR(v.at("intM"), 1.0, 1e-6);
  EXPECT_NEAR(v.at("intS"), 1.0, 1e-6);
  EXPECT_EQ(v.at("in%"), 100.0);
}

// Our own files have a row in the middle of each interval; those of laboratories begin at any time.
TEST(ForceComparison, TimesBeginAtFrameZero) {
  Pressed middles(30), later(30);
  std::vector<import::ForceSample> rows;
  for (int t = 1; t < 30; ++t) {
    rows.push_back(middles.measured.samples[10 * static_cast<std::size_t>(t) - 5]);
    rows.back().time = (t - 0.5) / 30.0;
  }
  middles.measured.samples = {rows.begin(), rows.end()};
  for (auto& sample : later.measured.samples) sample.time += 100.0;
  for (const Pressed& pressed : {middles, later}) {
    const auto v = values_of(pressed);
    EXPECT_NEAR(v.at("totV"), 0.0, 1e-3);
    EXPECT_NEAR(v.at("ftV"), 0.0, 1e-3);
    EXPECT_NEAR(v.at("ftV r"), 1.0, 1e-9);
  }
}

TEST(ForceComparison, ErrorsHaveTheirSizeAndSign) {
  Pressed pressed(30);
  const double weight = kGravity * pressed.measured.mass;
  for (auto& sample : pressed.measured.samples) {
    sample.force[0].z() -= 0.1 * weight;
    sample.pressure[1] -= Vector3d(0.0, 0.03, 0.0);  // measured 3 cm farther forward
  }
  const auto v = values_of(pressed);
  EXPECT_NEAR(v.at("totV"), 10.0, 1e-6);
  EXPECT_NEAR(v.at("N/kg"), 0.981, 1e-6);
  EXPECT_NEAR(v.at("ftV"), 10.0 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(v.at("imp%"), 100.0 / 9.0, 1e-6);
  EXPECT_NEAR(v.at("bias"), -15.0, 0.5) << "the mean of both feet, which point a little outwards";
  EXPECT_NEAR(v.at("copA"), 30.0 / std::sqrt(2.0), 0.5);
  EXPECT_NEAR(values_of(pressed, 2.0 * pressed.measured.mass).at("imp%"), 100.0 * (2.0 / 0.9 - 1.0), 1e-6);
}

// The filter leaves 1/(1 + (tan(π f/fps)/r)⁴) of a sine of f, 3 % at 10 Hz.
TEST(ForceComparison, ChatterIsWhatTheFilterTakesAway) {
  Pressed pressed(240);
  const double weight = kGravity * pressed.measured.mass, r = std::tan(std::numbers::pi * 6.0 / 30.0);
  for (std::size_t i = 0; i < pressed.measured.samples.size(); ++i)
    pressed.measured.samples[i].force[0].z() +=
        0.1 * weight * std::sin(2.0 * std::numbers::pi * 10.0 / 30.0 * static_cast<double>((i + 9) / 10));
  const auto v = values_of(pressed);
  const double passed = 1.0 / (1.0 + std::pow(std::tan(std::numbers::pi * 10.0 / 30.0) / r, 4));
  EXPECT_NEAR(v.at("chaM"), 10.0 / std::sqrt(2.0) * (1.0 - passed), 0.1);
  EXPECT_NEAR(v.at("chaS"), 0.0, 1e-6);
}

TEST(ForceComparison, SlipIsTheWayOfTheFootUnderThePressure) {
  Pressed sliding(30), turning(30), lifted(30), on_toes(30);
  for (int t = 0; t < 30; ++t) {
    const Vector3d pressed = turning.measured.samples[0].pressure[0];
    const Matrix3d turn = exp_map(0.05 * t * Vector3d(0.0, 0.6, 0.8)).toRotationMatrix();
    for (const int b : {kLeftKnee, kLeftAnkle, kLeftFoot}) {
      sliding.measured.joints[t][b] += 0.002 * t * Vector3d(0.6, 0.8, 0.0);
      turning.measured.joints[t][b] = pressed + turn * (turning.measured.joints[t][b] - pressed);
    }
    const Vector3d ball = on_toes.measured.joints[t][kLeftFoot], up(0.0, 0.0, 0.004 * t);
    for (const int b : {kLeftKnee, kLeftAnkle}) on_toes.measured.joints[t][b] += up;
    EXPECT_EQ(on_toes.measured.joints[t][kLeftFoot], ball);
  }
  for (auto& sample : on_toes.measured.samples) sample.pressure[0].y() -= 0.1;
  for (auto& sample : lifted.measured.samples) sample.force[0].setZero();
  double left = 0.0, all = 0.0;  // of the load, over the frames that count
  for (int t = 2; t < 29; ++t) {
    left += sliding.force_at(t, 0).z();
    all += sliding.force_at(t, 0).z() + sliding.force_at(t, 1).z();
  }
  EXPECT_NEAR(values_of(sliding).at("slipM"), 2.0 * left / all, 1e-6);
  EXPECT_NEAR(values_of(sliding).at("slipS"), 0.0, 1e-6);
  EXPECT_NEAR(values_of(turning).at("slipM"), 0.0, 1e-6) << "a foot that rolls does not slide";
  EXPECT_NEAR(values_of(on_toes).at("slipM"), 0.0, 1e-6) << "the heel rises, the toes stay";
  EXPECT_NEAR(values_of(lifted).at("slipM"), 0.0, 1e-6) << "a foot in the air carries nothing";
  lifted.measured.joints.clear();
  EXPECT_TRUE(std::isnan(values_of(lifted).at("slipM"))) << "nothing measured says where the feet were";
}

TEST(ForceComparison, PlatesThatDoNotSeeAFootDoNotCount) {
  Pressed pressed(30);
  for (auto& sample : pressed.measured.samples)
    if (sample.time > 0.5) {
      sample.valid[0] = false;
      sample.force[0].setZero();
    }
  const auto v = values_of(pressed);
  EXPECT_EQ(v.at("n"), 14) << "frames 2 to 15";
  EXPECT_NEAR(v.at("ftV"), 0.0, 1e-6);
}

TEST(ForceComparison, MassIsThatOfTheFramesThatCount) {
  Pressed pressed(30);
  const double mass = pressed.measured.mass;
  pressed.measured.mass = NAN;
  for (auto& sample : pressed.measured.samples)
    if (sample.time > 0.5) {
      sample.valid[0] = false;
      sample.force[0].setZero();
    }
  // A hand carries a tenth of the load.
  const double hand = 0.1 * kGravity * mass;
  for (auto& sample : pressed.measured.samples) sample.rest.z() = hand;
  for (auto& acting : pressed.motion.forces) acting.ground[kLeftWrist][5] = hand;
  // The body moves down at first and up at last: more than its weight presses.
  for (auto& sample : pressed.measured.samples)
    for (Vector3d* force : {&sample.force[0], &sample.force[1], &sample.rest}) *force *= 1.3;
  for (auto& acting : pressed.motion.forces)
    for (Vector6d& wrench : acting.ground) wrench *= 1.3;
  const std::vector<std::string> told = compared(pressed, NAN).told;
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find(formatted("mass %.1f kg", mass)), std::string::npos) << told[0];
  EXPECT_NEAR(values_of(pressed).at("totV"), 0.0, 1e-6);
  EXPECT_TRUE(compared(pressed, mass).told.empty());
  for (auto& sample : pressed.measured.samples) sample.valid[0] = false;
  EXPECT_THROW(compared(pressed, NAN), DataError);
  EXPECT_EQ(values_of(pressed, mass).at("n"), 0.0);
}

/// The same trial from the laboratory's file, which does not say where the plates are missed.
TEST(ForceComparison, FramesBesideThePlatesDoNotCount) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "needs ../shared";
  const auto plates = import::read_measured_forces(shared / "raw/walk_raj_grf.mot");
  const auto study = import::read_measured_forces(shared / "data/walk_raj.npz");
  // A body that stands in place and carries what was measured, also where the study says that plates miss a
  // foot: there it carries the rest of the weight.
  const int frames = static_cast<int>((study.samples.size() - 1) / 10) + 1;
  Pressed pressed(frames);
  const double weight = kGravity * pressed.motion.character.total_mass();
  for (int t = 1; t < frames; ++t)
    for (int foot = 0; foot < 2; ++foot) {
      const import::ForceSample& sample = study.samples[static_cast<std::size_t>(10 * t - 5)];
      Vector6d& ground = pressed.motion.forces[static_cast<std::size_t>(t)].ground[kLeftAnkle + foot];
      ground.setZero();
      ground.tail<3>() = weight / (kGravity * study.mass) * sample.force[foot];
      if (!sample.valid[foot]) ground[5] = std::max(0.0, weight - sample.force[1 - foot].z());
    }
  pressed.measured = plates;
  const auto v = values_of(pressed, study.mass);
  EXPECT_GT(v.at("n"), 20);
  EXPECT_LT(v.at("totV"), 6.0) << "but for the filter of the study";
  EXPECT_NEAR(values_of(pressed).at("imp%"), 0.0, 1e-6);
  EXPECT_NE(compared(pressed, NAN).told.at(1).find("mass 8"), std::string::npos);
}

/// Moments that grow with time, and a table of them with 60 rows a second.
struct Turned {
  audit::SimulatedFrames motion = Pressed(30).motion;
  import::StorageTable table;

  Turned() {
    const auto at = [](double time) { return 20.0 + 40.0 * time; };
    table.columns = {"time"};
    table.rows.resize(59);
    for (std::size_t i = 0; i < table.rows.size(); ++i) table.rows[i] = {3.0 + static_cast<double>(i) / 60.0};
    const PerBody<Vector3d> unit = [] {
      PerBody<Vector3d> torque;
      for (int b = 0; b < kBodies; ++b)
        torque[b] = is_hinge(b) ? hinge_axis(b) : Vector3d(1.0, 0.1 * b, -0.2);
      return torque;
    }();
    for (int t = 0; t < 30; ++t)
      for (int b = 0; b < kBodies; ++b)
        motion.forces[static_cast<std::size_t>(t)].joint_torque[b] = at((t - 0.5) / 30.0) * unit[b];
    const auto& frame = motion.frames[0];  // all frames have this pose
    const BodyPoses poses = forward_kinematics(motion.character, frame.p_root, frame.q);
    for (const bool right : {true, false})
      for (int k = 0; k < files::kGaitMoments; ++k) {
        table.columns.push_back(files::gait_moment_name(k, right));
        for (auto& row : table.rows)
          row.push_back(at(row[0] - 3.0) * files::gait_moments(poses, unit, right)[k]);
      }
  }
  std::map<std::string, double> values(double mass = NAN) const {
    const std::vector<double> values = compare_inverse_dynamics(motion, table, mass, "walk.sto");
    std::map<std::string, double> named;
    for (std::size_t k = 0; k < values.size(); ++k) named[moment_columns()[k].name] = values[k];
    return named;
  }
};

TEST(InverseDynamics, EqualMomentsHaveNoErrorsAndOthersTheirSize) {
  Turned turned;
  const double mass = turned.motion.character.total_mass();
  EXPECT_EQ(turned.values().size(), moment_columns().size());
  EXPECT_EQ(turned.values().at("n"), 27) << "without frames 0, 1 and the last";
  for (const auto& [name, value] : turned.values()) {
    if (name == "n" || name == "kg") continue;
    EXPECT_NEAR(value, name.ends_with(" r") ? 1.0 : 0.0, 1e-9) << name;
  }
  for (auto& row : turned.table.rows) row[*turned.table.find("knee_angle_r_moment")] += 0.2 * mass;
  EXPECT_NEAR(turned.values().at("kneeR"), 0.2, 1e-9);
  EXPECT_NEAR(turned.values().at("kneeL"), 0.0, 1e-9);
  EXPECT_NEAR(turned.values().at("knee"), 0.2 / std::sqrt(2.0), 1e-9);
  EXPECT_GT(turned.values(0.5 * mass).at("ankleL"), 0.1) << "the person's mass counts";
  turned.table.rows.resize(10);
  EXPECT_THROW(turned.values(), DataError) << "too few frames in common";
  turned.table.columns[1] = "hip_flexion_r";
  EXPECT_THROW(turned.values(), DataError);
}

TEST(PlanarMoments, OfAStillLegAreForceTimesLeverMinusTheSegmentsWeights) {
  const Pressed pressed(10);
  PerFrame<Matrix3d> axes(10, audit::heading_axes(pressed.measured.joints[0]));
  PerFrame<PerBody<Vector3d>> joints(10, pressed.measured.joints[0]);
  PerFrame<Array<Vector3d, 2>> force(10), pressure(10);
  const Vector3d forward = axes[0].col(0);
  for (int t = 0; t < 10; ++t)
    for (int foot = 0; foot < 2; ++foot) {
      force[t][foot] = {0.0, 0.0, 350.0};
      pressure[t][foot] = joints[t][kLeftAnkle + foot] + 0.1 * forward;
    }
  const auto moments = planar_moments({joints, force, pressure, axes, 70.0, 30.0});
  const double foot_lever = 0.5 * (joints[0][kLeftFoot] - joints[0][kLeftAnkle]).dot(forward);
  EXPECT_NEAR(moments[5][0][0], 350.0 * 0.1 / 70.0 - 0.0137 * kGravity * foot_lever, 1e-9);
  const double knee = (joints[0][kLeftAnkle] - joints[0][kLeftKnee]).dot(forward);
  EXPECT_NEAR(
      moments[5][0][1],
      350.0 * (0.1 + knee) / 70.0 - 0.0137 * kGravity * (knee + foot_lever) - 0.0433 * kGravity * 0.44 * knee,
      1e-9);
}

// A step's force has the lever of the step's height, not of the floor's.
TEST(PlanarMoments, PressureOnAStepIsAtItsHeight) {
  const Pressed pressed(10);
  const PerFrame<Matrix3d> axes(10, audit::heading_axes(pressed.measured.joints[0]));
  const PerFrame<PerBody<Vector3d>> joints(10, pressed.measured.joints[0]);
  PerFrame<Array<Vector3d, 2>> force(10), pressure(10);
  for (int t = 0; t < 10; ++t)
    for (int foot = 0; foot < 2; ++foot) {
      force[t][foot] = -50.0 * axes[0].col(0) + 350.0 * Vector3d::UnitZ();
      pressure[t][foot] = joints[t][kLeftAnkle + foot];
      pressure[t][foot].z() = 0.0;
    }
  const auto moment = [&] { return planar_moments({joints, force, pressure, axes, 70.0, 30.0})[5][0][1]; };
  const double on_floor = moment();
  for (auto& feet : pressure)
    for (Vector3d& p : feet) p.z() = 0.3;
  EXPECT_NEAR(std::abs(moment() - on_floor), 50.0 * 0.3 / 70.0, 1e-9);
  for (auto& feet : pressure)
    for (Vector3d& p : feet) p.z() = NAN;
  EXPECT_EQ(moment(), on_floor);
}

TEST(PlanarMoments, AccelerationsOfACubicAreExactAtTheEndsToo) {
  PerFrame<Vector3d> points;
  for (int t = 0; t < 12; ++t) points.emplace_back(t * t, t * t * t, 5.0 - t);
  const auto a = smooth_accelerations(points, 10.0);
  for (int t = 0; t < 12; ++t) EXPECT_NEAR((a[t] - Vector3d(200.0, 600.0 * t, 0.0)).norm(), 0.0, 1e-6) << t;
}

/// Of the same trial, at the 151 times of OpenSim's file: a walk, moments of up to 1.8 N·m/kg.
TEST(PlanarMoments, OfAWalkAreNearThoseOfOpenSim) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "needs ../shared";
  const auto measured = import::read_measured_forces(shared / "data/walk_g10.npz");
  const auto table = import::parse_storage(read_file(shared / "raw/walk_ID.sto"), "walk_ID.sto");
  PerFrame<PerBody<Vector3d>> joints;
  PerFrame<Array<Vector3d, 2>> force, pressure;
  PerFrame<Matrix3d> axes;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    joints.push_back(measured.joints[2 * i]);  // 120 per second, forces 300, the table 60
    force.push_back(measured.samples[5 * i].force);
    pressure.push_back(measured.samples[5 * i].pressure);
    axes.push_back(audit::heading_axes(joints.back()));
  }
  const auto moments = planar_moments({joints, force, pressure, axes, measured.mass, 60.0});
  for (int k = 0; k < files::kGaitMoments; ++k) {
    PairedSeries both;
    for (const int side : {0, 1})
      for (int i = 3; i + 3 < moments.count(); ++i)
        both.add(-moments[i][side][files::kGaitMoments - 1 - k],
                 table.rows[static_cast<std::size_t>(i)][*table.find(files::gait_moment_name(k, side == 1))] /
                     measured.mass);
    RecordProperty(files::gait_moment_name(k, true) + "_rmse", std::to_string(both.rms()));
    RecordProperty(files::gait_moment_name(k, true) + "_r", std::to_string(both.correlation()));
    EXPECT_LT(both.rms(), 0.25) << k;
    EXPECT_GT(both.correlation(), 0.85) << k;
  }
}

TEST(ForceComparison, MomentsOfAMovingPersonAreThoseOfAStandingOne) {
  Pressed pressed(30);
  const auto still = values_of(pressed);
  const Vector3d velocity(0.3, -1.2, 0.0);
  for (int t = 0; t < 30; ++t) {
    for (Vector3d& joint : pressed.measured.joints[t]) joint += t / 30.0 * velocity;
    pressed.motion.frames[static_cast<std::size_t>(t)].p_root += t / 30.0 * velocity;
  }
  for (auto& sample : pressed.measured.samples)
    for (Vector3d& pressure : sample.pressure)
      pressure += (sample.time - 0.5 / 300.0) * velocity;  // the mean of an interval's ten is at its middle
  for (const char* name : {"ank", "kne", "hip"})
    EXPECT_NEAR(values_of(pressed).at(name), still.at(name), 1e-6);
}

/// The table of ../shared/forces/compare.py for the same files: every value as printed but the moments, for
/// which that program takes the joints at the end of the interval over which it averages the forces.
TEST(ForceComparison, PrintsTheTableOfTheStudyInPython) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces";
  if (!std::filesystem::exists(shared / "compare.py")) GTEST_SKIP() << "needs ../shared";
  if (std::system("/usr/bin/python3 -c 'import numpy, scipy' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs Python with NumPy and SciPy";
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path / "motions");
  std::filesystem::create_directories(folder.path / "data");
  std::ofstream weights(folder.path / "weights.json");
  weights << "{";
  for (const char* name : {"walk_oc4", "walk_raj"}) {
    const auto measured = import::read_measured_forces(shared / "data" / (std::string(name) + ".npz"));
    std::filesystem::copy(shared / "data" / (std::string(name) + ".npz"), folder.path / "data");
    // A body that stands in place and whose feet carry about what was measured, with noise.
    const int frames = static_cast<int>((measured.samples.size() - 1) / 10) + 1;
    motion::Clip clip = motion::standing_clip(frames);
    const Character character = motion::character_of(clip);
    weights << (name == std::string("walk_oc4") ? "\"" : ", \"") << name << "\": " << character.total_mass();
    Random random(501, {7});
    files::WrenchRows ground(static_cast<std::size_t>(frames)), self = ground;
    files::VectorRows torques(static_cast<std::size_t>(frames)), ranges = torques;
    for (std::size_t t = 0; t < ground.size(); ++t) {
      ground[t].fill(Vector6d::Zero());
      self[t].fill(Vector6d::Zero());
      ranges[t].fill(Vector3d::Zero());
      for (int b = 0; b < kBodies; ++b)
        torques[t][b] = is_hinge(b)
                            ? Vector3d(random.uniform(-50.0, 50.0) * hinge_axis(b))
                            : Vector3d(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), 20.0);
      torques[t][0].setZero();
      for (int foot = 0; foot < 2 && t > 0; ++foot) {
        const Vector3d force =
            0.9 * measured.samples[10 * t - 5].force[foot] +
            Vector3d(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), random.uniform(0.0, 60.0));
        const Vector3d arm(random.uniform(-0.03, 0.03), random.uniform(-0.1, 0.05), -0.07);
        ground[t][kLeftAnkle + foot] << arm.cross(force), force;
      }
    }
    using files::Precision;
    std::vector<motion::ReferenceFrame> still;
    for (int t = 0; t < frames; ++t) {
      motion::ReferenceFrame frame;
      for (Vector3d& w : frame.omega) w.setZero();
      still.push_back(frame);
    }
    motion::write_clip(folder.path / "motions" / (std::string(name) + ".npz"), clip,
                       {{"joints", motion::joint_positions_member(clip)},
                        {"velocities", files::velocities_member(still, Precision::kFloat64)},
                        {"joint_torques", files::joints_member(torques, Precision::kFloat64)},
                        {"range_torques", files::joints_member(ranges, Precision::kFloat64)},
                        {"ground_wrenches", files::wrenches_member(ground, Precision::kFloat64)},
                        {"self_contact_wrenches", files::wrenches_member(self, Precision::kFloat64)}});
  }
  weights << "}";
  weights.close();
  const std::filesystem::path printed = folder.path / "table.txt";
  ASSERT_EQ(
      std::system(("FORCES=" + (folder.path / "data").string() + " /usr/bin/python3 " +
                   (shared / "compare.py").string() + " " + folder.path.string() + " > " + printed.string())
                      .c_str()),
      0);
  std::ifstream file(printed);
  std::istringstream ours(format_forces(evaluate_forces(folder.path / "data", folder.path / "motions", NAN)));
  const auto& columns = force_columns();
  const auto first = std::find_if(columns.begin(), columns.end(),
                                  [](const ForceColumn& c) { return c.name == std::string("ank"); });
  const auto without_moments = [&](std::string line) {
    return line.erase(15 + 7 * static_cast<std::size_t>(first - columns.begin()), 7 * 6);
  };
  int lines = 0;
  for (std::string theirs, mine; std::getline(file, theirs) && std::getline(ours, mine); ++lines)
    EXPECT_EQ(without_moments(mine.substr(0, theirs.size())), without_moments(theirs));
  EXPECT_EQ(lines, 4) << "head, two trials, means";
}

TEST(ForceFiles, SharingIsThatOfTheMotionsFile) {
  const TemporaryFolder folder;
  Pressed pressed(30);
  for (motion::ReferenceFrame& frame : pressed.motion.frames)
    for (Vector3d& w : frame.omega) w.setZero();
  const std::size_t frames = pressed.motion.frames.size();
  Npz plates;
  for (const int foot : {0, 1}) {
    std::vector<double> force, pressure;
    for (const import::ForceSample& sample : pressed.measured.samples) {
      files::append(sample.force[foot], force);
      files::append(sample.pressure[foot], pressure);
    }
    const std::vector<std::size_t> shape = {pressed.measured.samples.size(), 3};
    plates.set(foot == 0 ? "grf_left" : "grf_right", NpyArray::from_double(shape, force.data()));
    plates.set(foot == 0 ? "cop_left" : "cop_right", NpyArray::from_double(shape, pressure.data()));
  }
  plates.set("grf_fps", NpyArray::scalar(300.0));
  write_npz(folder.path / "plates.npz", plates);
  files::WrenchRows ground(frames), self(frames);
  files::VectorRows torques(frames), ranges(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    const rl::tracking::ActingForces& acting = pressed.motion.forces[t];
    ground[t] = acting.ground;
    self[t] = acting.self_contact;
    torques[t] = acting.joint_torque;
    ranges[t] = acting.range_torque;
  }
  // As narrow as of a floor without friction: all on the left foot.
  audit::LoadSharing left = audit::LoadSharing::none();
  const double weight = kGravity * pressed.motion.character.total_mass();
  left.least[0].z() = left.most[0].z() = left.least_effort[0].z() = weight;
  const motion::Clip clip = motion::standing_clip(30);
  const auto wide_of = [&](const PerFrame<audit::LoadSharing>& sharing) {
    using files::Precision;
    files::Members members = {
        {"joints", motion::joint_positions_member(clip)},
        {"velocities", files::velocities_member(pressed.motion.frames, Precision::kFloat64)},
        {"joint_torques", files::joints_member(torques, Precision::kFloat64)},
        {"range_torques", files::joints_member(ranges, Precision::kFloat64)},
        {"ground_wrenches", files::wrenches_member(ground, Precision::kFloat64)},
        {"self_contact_wrenches", files::wrenches_member(self, Precision::kFloat64)}};
    if (!sharing.empty())
      for (const auto& member : audit::sharing_members(sharing)) members.push_back(member);
    motion::write_clip(folder.path / "plates_motion.npz", clip, members);
    const ForceTable table =
        evaluate_forces(folder.path / "plates.npz", folder.path / "plates_motion.npz", NAN);
    EXPECT_EQ(table.rows.at(0).reason, "");
    EXPECT_FALSE(table.rows.at(0).told.empty()) << "where the mass is from";
    for (std::size_t k = 0; k < table.columns->size(); ++k)
      if ((*table.columns)[k].name == std::string("wide") && table.rows[0].reason.empty())
        return table.rows[0].values[k];
    return std::nan("");
  };
  EXPECT_GT(wide_of({}), 10.0) << "computed where the file has none";
  EXPECT_NEAR(wide_of(PerFrame<audit::LoadSharing>(frames, left)), 0.0, 1e-9);
}

TEST(ForceFiles, OfOneNameThatOfTheGroundForcesCounts) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path / "data");
  std::filesystem::create_directories(folder.path / "motions");
  motion::write_clip(folder.path / "motions" / "other.npz", motion::standing_clip(10));
  for (const char* name : {"sit", "walk"})
    for (const char* end : {".mot", "_grf.mot"})
      std::ofstream(folder.path / "data" / (std::string(name) + end)) << "nothing";
  const ForceTable table = evaluate_forces(folder.path / "data", folder.path / "motions", NAN);
  ASSERT_EQ(table.rows.size(), 2u);
  for (const ForceRow& row : table.rows)
    EXPECT_NE(row.reason.find(row.name + "_grf.mot"), std::string::npos) << row.reason;
  std::ofstream(folder.path / "data" / "walk_grf.npz") << "nothing";
  try {
    evaluate_forces(folder.path / "data", folder.path / "motions", NAN);
    FAIL() << "two measurements of one name";
  } catch (const DataError& error) {
    const std::string said = error.what();
    EXPECT_TRUE(said.find("walk_grf.mot") != std::string::npos &&
                said.find("walk_grf.npz") != std::string::npos)
        << said;
  }
}

}  // namespace
}  // namespace mimicx::judge

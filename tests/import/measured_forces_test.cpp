#include "import/opensim/measured_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "core/npz/npz.h"

namespace mimicx::import {
namespace {

const std::string kOldMot =
    "walk\nversion=1\nnRows=2\nnColumns=13\ninDegrees=yes\nendheader\n"
    "time\tground_force_vx\tground_force_vy\tground_force_vz\tground_force_px\tground_force_py\tground_force_"
    "pz"
    "\t1_ground_force_vx\t1_ground_force_vy\t1_ground_force_vz\t1_ground_force_px\t1_ground_force_py\t"
    "1_ground_force_pz\n"
    "0\t1\t700\t3\t0.1\t0\t0.2\t4\t50\t6\t0.3\t0\t-0.2\n"
    "0.01\t1\t710\t3\t0.1\t0\t0.2\t4\t40\t6\t0.3\t0\t-0.2\n";

TEST(MeasuredForces, MotIsTurnedToOurWorldAndTheFirstPlateIsTheRightFoots) {
  const MeasuredForces measured = measured_forces_from(kOldMot, "walk.mot");
  ASSERT_EQ(measured.samples.size(), 2U);
  EXPECT_EQ(measured.samples[1].time, 0.01);
  EXPECT_EQ(measured.samples[0].force[1], Vector3d(1, -3, 700));
  EXPECT_EQ(measured.samples[1].force[0], Vector3d(4, -6, 40));
  EXPECT_EQ(measured.samples[0].pressure[0], Vector3d(0.3, 0.2, 0));
  EXPECT_TRUE(std::isnan(measured.mass));
}

TEST(MeasuredForces, ReadsTheColumnNamesOfNewerFiles) {
  std::string text = kOldMot;
  for (std::size_t at; (at = text.find("1_ground_force_")) != std::string::npos;)
    text.replace(at, 15, "ground_XX_l_");
  for (std::size_t at; (at = text.find("ground_force_")) != std::string::npos;)
    text.replace(at, 13, "ground_XX_r_");
  for (std::size_t at; (at = text.find("XX")) != std::string::npos;) text.replace(at, 2, "force");
  EXPECT_EQ(measured_forces_from(text, "x.mot").samples[0].force[1].z(), 700.0);
}

/// The text with another number in its header.
std::string with_said(std::string text, const std::string& key, int number) {
  const std::size_t at = text.find(key + '=') + key.size() + 1;
  return text.replace(at, text.find('\n', at) - at, std::to_string(number));
}

/// The text with a further column behind each of its rows.
std::string with_column(const std::string& text, const std::string& name, const std::string& value) {
  std::istringstream lines(text);
  std::string out;
  bool in_table = false, heads = false;
  int columns = 0;
  for (std::string line; std::getline(lines, line);) {
    heads = !in_table && line.starts_with("time\t");
    in_table = in_table || heads;
    if (heads) columns = 2 + static_cast<int>(std::count(line.begin(), line.end(), '\t'));
    out += line + (heads ? '\t' + name : in_table ? '\t' + value : "") + '\n';
  }
  return with_said(out, "nColumns", columns);
}

TEST(MeasuredForces, FurtherPlateUnderLoadIsRefused) {
  const auto read = [](const std::string& name, const std::string& value) {
    return measured_forces_from(with_column(kOldMot, name, value), "x.mot");
  };
  EXPECT_EQ(read("2_ground_force_vy", "0").samples.size(), 2U) << "nobody stands on it";
  EXPECT_EQ(read("ground_torque_y", "13").samples.size(), 2U);
  try {
    read("2_ground_force_vy", "350");
    FAIL() << "a plate that no foot takes";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("2_ground_force_vy"), std::string::npos) << error.what();
  }
}

TEST(MeasuredForces, RestOfTheBodyIsReadAndThenAllForcesAreKnown) {
  std::string text = kOldMot;
  EXPECT_THROW(measured_forces_from(with_column(text, "ground_force_o_vx", "0"), "x.mot"), DataError);
  for (const auto& [axis, value] : {std::pair("x", "1"), {"y", "200"}, {"z", "3"}})
    text = with_column(text, std::string("ground_force_o_v") + axis, value);
  for (std::size_t at; (at = text.find("\t50\t")) != std::string::npos;) text.replace(at, 4, "\t0\t");
  const MeasuredForces measured = measured_forces_from(text, "x.mot");
  EXPECT_EQ(measured.samples[1].rest, Vector3d(1, -3, 200));
  EXPECT_TRUE(measured.samples[0].valid[0]) << "the left foot is on nothing";
}

/// A .mot of 2 s with 100 rows a second. @param load  (time, whether of the right foot) → N
template <class Load>
MeasuredForces forces_under(const Load& load) {
  std::string text = with_said(kOldMot.substr(0, kOldMot.find("0\t1\t700")), "nRows", 201);
  for (int i = 0; i <= 200; ++i) {
    text += std::to_string(i / 100.0);
    for (const bool right : {true, false})
      text += "\t0\t" + std::to_string(load(i / 100.0, right)) + "\t0\t0.1\t0\t0.2";
    text += '\n';
  }
  return measured_forces_from(text, "x.mot");
}

/// Times of the first and the last valid sample of a foot, between which all are.
std::pair<double, double> valid_times(const MeasuredForces& measured, int foot) {
  std::pair<double, double> times = {NAN, NAN};
  int count = 0;
  for (const ForceSample& sample : measured.samples) {
    if (!sample.valid[foot]) continue;
    if (count++ == 0) times.first = sample.time;
    times.second = sample.time;
  }
  EXPECT_EQ(count, count == 0 ? 0 : std::lround(100.0 * (times.second - times.first)) + 1);
  return times;
}

TEST(MeasuredForces, BeforeAndAfterThePlatesAFootIsNotSeen) {
  const MeasuredForces walk = forces_under([](double t, bool right) {
    return right ? (t > 0.295 && t < 0.905) || (t > 1.195 && t < 1.805) ? 700.0 : 5.0  // the noise of a plate
                 : (t > 0.795 && t < 1.305 ? 700.0 : 0.0);
  });
  EXPECT_NEAR(valid_times(walk, 1).first, 0.2, 0.011) << "0.1 s before it lands";
  EXPECT_NEAR(valid_times(walk, 1).second, 1.9, 0.011);
  EXPECT_NEAR(valid_times(walk, 0).first, 0.7, 0.011);
  EXPECT_NEAR(valid_times(walk, 0).second, 1.4, 0.011);
  EXPECT_NE(walk.told.find("the left foot counts from 0.70 to 1.40 s"), std::string::npos) << walk.told;
  const MeasuredForces one_plate = forces_under([](double, bool right) { return right ? 700.0 : 0.0; });
  EXPECT_TRUE(std::isnan(valid_times(one_plate, 0).first));
  EXPECT_EQ(valid_times(one_plate, 1), std::pair(0.0, 2.0));
  EXPECT_NE(one_plate.told.find("the left foot presses no plate"), std::string::npos) << one_plate.told;
}

TEST(MeasuredForces, FlightOfAJumpIsSeen) {
  const MeasuredForces jump = forces_under([](double t, bool) { return t < 0.8 || t > 1.2 ? 350.0 : 0.0; });
  for (const int foot : {0, 1}) EXPECT_EQ(valid_times(jump, foot), std::pair(0.0, 2.0));
  EXPECT_EQ(jump.told, "");
}

/// What is wrong with a file; empty: nothing.
std::string error_of(const std::string& text) {
  try {
    measured_forces_from(text, "walk.mot");
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(MeasuredForces, ErrorsSayWhatWasExpected) {
  EXPECT_NE(error_of("HIERARCHY\n").find("endheader"), std::string::npos);
  std::string text = kOldMot;
  EXPECT_NE(error_of(text.replace(text.find("1_ground_force_vz"), 17, "1_ground_force_vq"))
                .find("1_ground_force_vz"),
            std::string::npos);
  text = kOldMot;
  EXPECT_NE(error_of(text + "0.005\t1\n").find("a number per column"), std::string::npos);
  EXPECT_NE(error_of(text.replace(text.find("0.01\t"), 5, "0\t")).find("times that increase"),
            std::string::npos);
  EXPECT_NE(error_of(with_said(kOldMot.substr(0, kOldMot.find("0\t1\t700")), "nRows", 0))
                .find("at least one sample"),
            std::string::npos);
}

TEST(MeasuredForces, RowsAndColumnsMustBeAsManyAsTheHeaderSays) {
  EXPECT_EQ(error_of(kOldMot.substr(0, kOldMot.find("0.01\t1"))),
            "walk.mot: line 8: expected 2 rows, as the header says, found 1")
      << "cut off behind a row";
  EXPECT_EQ(error_of(with_said(kOldMot, "nColumns", 19)),
            "walk.mot: line 7: expected 19 columns, as the header says, found 13");
  const auto with_rows = [](const std::string& line) {
    std::string text = kOldMot;
    return text.replace(text.find("nRows=2"), 7, line);
  };
  for (const std::string key : {"nRows = ", "nRows= ", "datarows ", "NROWS ="}) {
    EXPECT_EQ(error_of(with_rows(key + "2\t\t")), "") << key;
    EXPECT_NE(error_of(with_rows(key + "3\t\t")).find("expected 3 rows"), std::string::npos) << key;
  }
  EXPECT_EQ(error_of(with_rows("")), "");
}

TEST(MeasuredForces, ReadsTheForcesOfAnNpz) {
  Npz npz;
  const std::vector<double> left = {0, 0, 1, 0, 0, 2}, right = {0, 0, 3, 0, 0, 4}, nothing(6, NAN);
  npz.path = "x.npz";
  npz.set("grf_left", NpyArray::from_double({2, 3}, left.data()));
  npz.set("grf_right", NpyArray::from_double({2, 3}, right.data()));
  npz.set("cop_left", NpyArray::from_double({2, 3}, nothing.data()));
  npz.set("cop_right", NpyArray::from_double({2, 3}, left.data()));
  npz.set("grf_fps", NpyArray::scalar(300.0));
  npz.set("mass", NpyArray::scalar(61.5));
  const MeasuredForces measured = measured_forces_from(format_npz(npz), "x.npz");
  EXPECT_EQ(measured.samples[1].force[1].z(), 4.0);
  EXPECT_EQ(measured.samples[1].time, 1.0 / 300.0);
  EXPECT_TRUE(std::isnan(measured.samples[1].pressure[0].x()));
  EXPECT_EQ(measured.mass, 61.5);
  npz.set("cop_right", NpyArray::from_double({1, 3}, left.data()));
  EXPECT_THROW(measured_forces_from(format_npz(npz), "x.npz"), DataError);
}

TEST(MeasuredForces, RealFilesAreRead) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces/raw";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "needs ../shared";
  const MeasuredForces walk = read_measured_forces(shared / "walk_g10_grf.mot");
  EXPECT_EQ(walk.samples.size(), 1501U);
  EXPECT_NEAR(walk.samples[0].force[1].z(), 745.466, 1e-3);
  EXPECT_EQ(walk.told, "") << "both feet press the treadmill from beginning to end";
  const MeasuredForces overground = read_measured_forces(shared / "walk_raj_grf.mot");
  EXPECT_FALSE(overground.samples.front().valid[1]);
  EXPECT_FALSE(overground.samples[1000].valid[0]) << "at 0.5 s the right foot alone is on a plate";
  EXPECT_TRUE(overground.samples[2000].valid[0]);
}

}  // namespace
}  // namespace mimicx::import

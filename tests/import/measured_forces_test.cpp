#include "import/opensim/measured_forces.h"

#include <gtest/gtest.h>

#include <filesystem>

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

TEST(MeasuredForces, ErrorsSayWhatWasExpected) {
  const auto message = [](const std::string& text) {
    try {
      measured_forces_from(text, "walk.mot");
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("HIERARCHY\n").find("endheader"), std::string::npos);
  std::string text = kOldMot;
  EXPECT_NE(message(text.replace(text.find("1_ground_force_vz"), 17, "1_ground_force_vq"))
                .find("1_ground_force_vz"),
            std::string::npos);
  text = kOldMot;
  EXPECT_NE(message(text + "0.005\t1\n").find("a number per column"), std::string::npos);
  EXPECT_NE(message(text.replace(text.find("0.01\t"), 5, "0\t")).find("times that increase"),
            std::string::npos);
  EXPECT_NE(message(kOldMot.substr(0, kOldMot.find("0\t1\t700"))).find("at least one sample"),
            std::string::npos);
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
}

}  // namespace
}  // namespace mimicx::import

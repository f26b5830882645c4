#include "import/body_mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "import/motion_file.h"
#include "import/opensim/measured_forces.h"
#include "motion/standing_clip.h"

namespace mimicx::import {
namespace {

double mass_of(const std::array<double, kBetas>& betas) { return make_character(betas).total_mass(); }

TEST(BodyMass, UsualMassIsThatOfTheReferenceAdults) {
  EXPECT_NEAR(usual_mass(1.76), 73.0, 1.6);
  EXPECT_NEAR(usual_mass(1.63), 60.0, 1.4);
  EXPECT_NEAR(usual_stature(lengths_of(joint_offsets({}))), 1.718, 1e-12);
  EXPECT_NEAR(usual_stature(lengths_of(joint_offsets({2.0}))), 1.06 * 1.718, 1e-9) << "a larger body";
  BodyLengths legs{};
  legs[kThigh] = 1.1 * lengths_of(joint_offsets({}))[kThigh];
  EXPECT_NEAR(usual_stature(legs), 1.1 * 1.718, 1e-9) << "what is not known does not count";
}

TEST(BodyMass, GirthBringsAnyShapeToItsMass) {
  for (const std::array<double, kBetas>& betas :
       {std::array<double, kBetas>{}, {3.0, 0.0, -2.0, -4.0, 1.0}}) {
    const auto made = with_mass(betas, 75.0);
    EXPECT_NEAR(mass_of(made), 75.0, 1e-9);
    for (int k : {0, 2, 3, 4})
      EXPECT_EQ(made[static_cast<std::size_t>(k)], betas[static_cast<std::size_t>(k)]);
  }
  EXPECT_NEAR(with_mass({}, 300.0)[1], kMaxBeta, 1e-9);
}

TEST(BodyMass, GivenMassOverridesGivenStatureOverridesTheMean) {
  std::array<double, kBetas> betas = {1.0};
  EXPECT_NE(settle_mass({}, betas).find("usual one of adults"), std::string::npos);
  EXPECT_NEAR(mass_of(betas), usual_mass(1.03 * 1.718), 1e-6);
  EXPECT_NE(settle_mass({.height = 1.9}, betas).find("stature that was given"), std::string::npos);
  EXPECT_NEAR(mass_of(betas), usual_mass(1.9), 1e-6);
  EXPECT_NE(settle_mass({.mass = 55.0, .height = 1.9}, betas).find("as asked for"), std::string::npos);
  EXPECT_NEAR(mass_of(betas), 55.0, 1e-6);
  EXPECT_EQ(betas[0], 1.0) << "joints keep their places";
  EXPECT_NE(settle_mass({.mass = 500.0}, betas).find("cannot have 500.0 kg"), std::string::npos);
  EXPECT_NE(mass_warning({.mass = 500.0}, betas).find("cannot have the 500.0 kg of --mass"),
            std::string::npos);
  EXPECT_EQ(mass_warning({.height = 1.9}, betas), "") << "a mass that nobody asked for";
  settle_mass({.mass = 80.0}, betas);
  EXPECT_EQ(mass_warning({.mass = 80.0}, betas), "");
  betas = {};
  settle_body({.height = 1.9}, betas);
  EXPECT_NEAR(usual_stature(lengths_of(joint_offsets(betas))), 1.9, 1e-9);
  EXPECT_NEAR(mass_of(betas), usual_mass(1.9), 1e-6);
  EXPECT_EQ(height_warning({.height = 1.9}, betas), "");
  EXPECT_EQ(height_warning({.mass = 80.0}, betas), "");
  settle_body({.height = 2.2}, betas);
  EXPECT_EQ(height_warning({.height = 2.2}, betas),
            "height: 1.98 m, because our body cannot have the 2.20 m of --height");
}

TEST(BodyMass, MassSettingChangesFilesOfOurBody) {
  const motion::Clip clip = motion::standing_clip(4);
  const std::string bytes = format_npz(motion::to_npz(clip));
  ReadConfig config;
  config.mass = 62.0;
  EXPECT_NEAR(mass_of(motion_from(bytes, "x.npz", config).betas), 62.0, 1e-6);
  EXPECT_EQ(config.text(), "mass=62");
  config.mass = -1.0;
  EXPECT_THROW(motion_from(bytes, "x.npz", config), std::invalid_argument);
}

/// People of known mass by their joints alone: five of seven within the bar of ± 12 %. The other two have the
/// least mass for their stature.
TEST(BodyMass, PeopleOnPlatesWeighAboutWhatTheirJointsSay) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "needs ../shared";
  ReadConfig config;
  config.up = 'z';
  config.fps = 120.0;
  for (const auto& [name, most] : {std::pair{"walk_oc4", 0.12},
                                   {"dropjump_oc4", 0.12},
                                   {"squats_oc4", 0.12},
                                   {"run_ham2", 0.17},
                                   {"squat_kul", 0.21},
                                   {"walk_g10", 0.12},
                                   {"walk_raj", 0.12}}) {
    const motion::Clip clip = read_motion(shared / "in" / (std::string(name) + ".npy"), config);
    const double known = read_measured_forces(shared / "data" / (std::string(name) + ".npz")).mass;
    EXPECT_NEAR(mass_of(clip.betas) / known, 1.0, most) << name;
  }
}

}  // namespace
}  // namespace mimicx::import

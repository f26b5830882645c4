#include "import/motion_file.h"
#include "motion/clip_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "import/bvh.h"
#include "import/deepmimic.h"
#include "import/motionx.h"
#include "import/plausibility.h"
#include "import/text_input.h"
#include "import/world_transform.h"
#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"
#include "motion/raised_clip.h"
#include "motion/synthetic_clip.h"

#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

namespace fs = std::filesystem;

TEST(ReadMotion, TakesTheSceneOfTheFileOrTheOneAskedFor) {
  const motion::Clip own = test::raised(test::synthetic_clip("walk", 3, 30));
  const fs::path path = scratch("on_a_plate.npz");
  motion::write_clip(path, own);
  EXPECT_EQ(read_motion(path).scene, own.scene);
  ReadConfig config;
  config.scene = Scene{{{{1.0, 2.0}, 0.1, {0.3, 0.4}, 0.5}}};
  const motion::Clip asked = read_motion(path, config);
  EXPECT_EQ(asked.scene, *config.scene);
  EXPECT_EQ(asked.trans, own.trans);
  EXPECT_TRUE(std::any_of(asked.decisions.begin(), asked.decisions.end(),
                          [](const std::string& line) { return line == "scene: 1 plate up to 0.5 m"; }));
  EXPECT_EQ(config.text(), "scene=1,2,0.1,0.3,0.4,0.5,4e+05,4000");
}

TEST(ReadMotion, PutsAForeignMotionOntoItsScene) {
  motion::Clip clip = test::synthetic_clip("walk", 3, 60);
  clip.body_model = "smplx";
  clip.betas = {};
  clip.keypoints.reset();
  for (Vector3d& trans : clip.trans) trans.z() -= 0.7;
  const fs::path path = scratch("sunk.npz");
  motion::write_clip(path, clip);
  ReadConfig config;
  config.scene = test::wide_plate();
  const motion::Clip read = read_motion(path, config);
  EXPECT_NEAR(detect_floor(read), test::kRaised, 0.05);
  config.floor = -0.7;  // the file's floor, on which the plate stands
  EXPECT_NEAR(detect_floor(read_motion(path, config)), 0.0, 0.05);
}

TEST(ReadMotion, DoubtsASceneWhereTheFloorThatWasAskedForPutsTheMotion) {
  ReadConfig config;
  config.floor = 3.0;
  config.scene = test::wide_plate();
  const auto doubts = [&](double height) {
    motion::Clip clip = test::raised(test::synthetic_clip("walk", 3, 30));
    for (Vector3d& trans : clip.trans) trans.z() += height;
    motion::write_clip(scratch("high.npz"), clip);
    const std::vector<std::string> warnings = read_motion(scratch("high.npz"), config).warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& line) {
      return line.starts_with("nothing comes near the scene");
    });
  };
  EXPECT_FALSE(doubts(3.0)) << "it stands on the plate once the floor is at 0";
  EXPECT_TRUE(doubts(0.0)) << "it stands on the plate only before that";
}

/// A synthetic motion as a foreign file: body model smplx, so that the reader trusts nothing in it.
motion::Clip foreign(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  motion::Clip clip = synth::synthesize(config);
  clip.betas = {};
  clip.body_model = "smplx";
  clip.keypoints.reset();
  clip.name = kind;
  return clip;
}

motion::Clip written_and_read(const motion::Clip& clip, const ReadConfig& config = {}) {
  const fs::path path = scratch(clip.name + ".npz");
  motion::write_clip(path, clip);
  return read_motion(path, config);
}

bool decided(const motion::Clip& clip, const std::string& words) {
  return std::any_of(clip.decisions.begin(), clip.decisions.end(),
                     [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

/// Largest distance of the joints of two motions, m.
double largest_joint_distance(const motion::Clip& a, const motion::Clip& b) {
  const auto p = motion::poses_of(a), q = motion::poses_of(b);
  double most = p.size() == q.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < p.size() && t < q.size(); ++t)
    for (std::size_t j = 0; j < kBodies; ++j) most = std::max(most, (p[t].p_WB[j] - q[t].p_WB[j]).norm());
  return most;
}

TEST(ReadMotion, KeepsAValidFileUnchanged) {
  for (const std::string& kind : synth::basic_kinds()) {
    const motion::Clip clip = foreign(kind), back = written_and_read(clip);
    EXPECT_EQ(back.rotations, clip.rotations) << kind;
    EXPECT_EQ(back.trans, clip.trans) << kind;
    EXPECT_EQ(back.fps, 30.0) << kind;
    EXPECT_TRUE(decided(back, "format: ")) << kind;
    EXPECT_TRUE(decided(back, "up axis: z")) << kind;
    EXPECT_TRUE(back.warnings.empty()) << kind;
  }
}

TEST(ReadMotion, TurnsEveryUpAxisToZAndReportsIt) {
  const motion::Clip clip = foreign("walk");
  for (const char axis : std::string("xyXYZ")) {
    motion::Clip turned = clip;
    rotate_world(rotation_to_z_up(axis).conjugate(), turned);
    EXPECT_GT(largest_joint_distance(turned, clip), 0.5);
    const motion::Clip back = written_and_read(turned);
    EXPECT_LT(largest_joint_distance(back, clip), 1e-9) << axis;
    EXPECT_TRUE(decided(back, axis == 'Z' ? "upside down" : "up axis: " + axis_name(axis))) << axis;
    ReadConfig asked;
    asked.up = axis;
    EXPECT_LT(largest_joint_distance(written_and_read(turned, asked), clip), 1e-9);
    asked.up = 'z';
    EXPECT_LT(largest_joint_distance(written_and_read(turned, asked), turned), 1e-9)
        << "the user's setting counts";
  }
}

TEST(ReadMotion, CrawlingDoesNotChangeTheUpAxis) {
  // Flat on the belly, sliding forward: the body stands along x, but the floor is under it.
  motion::Clip clip = test::random_clip(5, 90, 0.05);
  const Quaterniond lie(Eigen::AngleAxisd(-test::kPi / 2, Vector3d::UnitX()));
  rotate_world(lie, clip);
  for (std::size_t t = 0; t < clip.trans.size(); ++t) clip.trans[t].y() += 0.01 * static_cast<double>(t);
  clip.body_model = "smplx";
  clip.name = "crawl";
  const motion::Clip back = written_and_read(clip);
  EXPECT_EQ(back.trans, clip.trans);
  EXPECT_TRUE(decided(back, "lies")) << back.decisions[2];
}

TEST(ReadMotion, FindsCentimetresAndMillimetres) {
  const motion::Clip clip = foreign("walk");
  for (const double scale : {100.0, 1000.0}) {
    motion::Clip large = clip;
    scale_world(scale, large);
    const motion::Clip back = written_and_read(large);
    EXPECT_LT(largest_joint_distance(back, clip), 1e-9) << scale;
    EXPECT_TRUE(decided(back, scale == 100.0 ? "centimetres" : "millimetres"));
    ReadConfig asked;
    asked.scale = 1.0 / scale;
    EXPECT_LT(largest_joint_distance(written_and_read(large, asked), clip), 1e-9);
  }
}

/// Jumps, two seconds each: half a metre up and down between two pauses, √(8 h / g) = 0.64 s in the air.
/// @param rates  at which each was recorded; the file says `label`
motion::Clip jumping(const std::vector<double>& rates, double label) {
  const double half = std::sqrt(2 * 0.5 / 9.81);
  motion::Clip clip = test::standing_clip(0, test::standing_height(), label);
  clip.body_model = "smplx";
  clip.name = "jumps";
  for (const double rate : rates) {
    motion::Clip jump = test::standing_clip(static_cast<int>(2 * rate), test::standing_height(), label);
    for (std::size_t t = 0; t < jump.trans.size(); ++t) {
      const double s = static_cast<double>(t) / rate - 1.0;
      if (std::abs(s) < half) jump.trans[t].z() += 0.5 - 0.5 * 9.81 * s * s;
    }
    clip.rotations.insert(clip.rotations.end(), jump.rotations.begin(), jump.rotations.end());
    clip.trans.insert(clip.trans.end(), jump.trans.begin(), jump.trans.end());
  }
  return clip;
}

TEST(ReadMotion, ThreeAgreeingFallsSetTheFrameRate) {
  for (const auto& [label, rate] : {std::pair{60.0, 120.0}, {30.0, 20.0}, {120.0, 60.0}, {30.0, 120.0}}) {
    const motion::Clip wrong = jumping({rate, rate, rate}, label);
    const motion::Clip back = written_and_read(wrong);
    EXPECT_EQ(back.fps, rate) << label;
    EXPECT_TRUE(decided(back, "frame rate: " + short_number(rate) + " fps, not " + short_number(label)));
    ReadConfig asked;
    asked.fps = label;
    EXPECT_EQ(written_and_read(wrong, asked).fps, label) << "the user's setting counts";
  }
}

TEST(ReadMotion, FewOrDisagreeingFallsOnlySuggestAFrameRate) {
  const std::vector<std::vector<double>> jumps = {{60.0}, {60.0, 60.0}, {60.0, 60.0, 45.0}};
  for (const std::vector<double>& rates : jumps) {
    const motion::Clip back = written_and_read(jumping(rates, 30.0));
    EXPECT_EQ(back.fps, 30.0) << rates.size();
    EXPECT_TRUE(decided(back, "frame rate: 30 fps, as given"));
    ASSERT_EQ(back.warnings.size(), 1u) << rates.size();
    EXPECT_NE(back.warnings[0].find("--fps 60"), std::string::npos) << back.warnings[0];
  }
}

TEST(ReadMotion, ATimeStepIsNoFrameRate) {
  motion::Clip clip = foreign("walk");
  for (const double rate : {24.0, 30.0, 120.0}) {
    clip.fps = 1.0 / rate;
    try {
      written_and_read(clip);
      FAIL() << rate;
    } catch (const DataError& error) {
      const std::string want = "expected a frame rate, found " + short_number(clip.fps) +
                               ", which is a time step: --fps " + short_number(rate);
      EXPECT_NE(std::string(error.what()).find(want), std::string::npos) << error.what();
    }
    ReadConfig asked;
    asked.fps = rate;
    EXPECT_EQ(written_and_read(clip, asked).fps, rate);
  }
}

TEST(ReadMotion, WarnsOfElbowsThatBendBackwards) {
  const auto warned = [](const motion::Clip& clip) {
    const auto& all = written_and_read(clip).warnings;
    return std::any_of(all.begin(), all.end(), [](const std::string& line) {
      return line.find("are left and right exchanged, or the world left-handed?") != std::string::npos;
    });
  };
  for (const char* kind : {"punch", "dance", "wave"}) {
    const motion::Clip clip = foreign(kind);
    motion::Clip exchanged = clip, left_handed = clip;
    for (auto& rotations : exchanged.rotations)
      for (const int left :
           {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot, kLeftCollar, kLeftShoulder, kLeftElbow, kLeftWrist})
        std::swap(rotations[left], rotations[left + 1]);
    for (int t = 0; t < clip.frames(); ++t) {
      for (Vector3d& r : left_handed.rotations[t]) r = Vector3d(r.x(), -r.y(), -r.z());
      left_handed.trans[t].x() *= -1.0;
    }
    EXPECT_FALSE(warned(clip)) << kind;
    EXPECT_TRUE(warned(exchanged)) << kind;
    EXPECT_TRUE(warned(left_handed)) << kind;
  }
}

TEST(ReadMotion, WarnsOfInhumanSpeeds) {
  motion::Clip clip = foreign("walk");
  clip.fps = 300.0;
  const motion::Clip back = written_and_read(clip);
  ASSERT_FALSE(back.warnings.empty());
  EXPECT_NE(back.warnings[0].find("m/s"), std::string::npos);
}

TEST(ReadMotion, TheFloorGivenByTheUserBecomesZeroAndStays) {
  motion::Clip clip = foreign("walk");
  shift_world({0, 0, 0.4}, clip);
  EXPECT_TRUE(decided(written_and_read(clip), "floor: at 0.4"));
  ReadConfig asked;
  asked.floor = 0.3;  // the motion hovers 0.1 m over the floor that the user names
  const motion::Clip back = written_and_read(clip, asked);
  motion::PreparationReport report;
  motion::prepare_reference(back, {}, &report);
  EXPECT_EQ(report.floor_shift_mm, 0.0);
  EXPECT_NEAR(detect_floor(back), 0.1, 0.01);
}

TEST(ReadMotion, MovesMotionsFarFromTheOriginThereByHundredsOfMetres) {
  const motion::Clip near = foreign("walk");
  const Vector3d away(22000.0, -300.0, 0.0);
  motion::Clip far = near;
  shift_world(away, far);
  const motion::Clip back = written_and_read(far);
  EXPECT_TRUE(decided(back, "place: moved by (-22000, 300) m to the origin"));
  EXPECT_FALSE(decided(written_and_read(near), "place"));
  for (int t = 0; t < near.frames(); ++t) EXPECT_LT((back.trans[t] - near.trans[t]).norm(), 1e-9) << t;
  ReadConfig on_boxes;  // at places of the file
  on_boxes.scene = Scene{{{{22000.5, -299.0}, 0.0, {3.0, 3.0}, 0.01}}};
  const motion::Clip boxes = written_and_read(far, on_boxes);
  EXPECT_TRUE(decided(boxes, "place"));
  EXPECT_EQ(boxes.place, -away);
  EXPECT_EQ(boxes.scene.plates[0].centre, Eigen::Vector2d(0.5, 1.0)) << "plates move with the motion";
}

TEST(ReadMotion, CamerasAreLiftedOntoASceneWithTheMotion) {
  motion::Clip clip = foreign("walk");
  motion::Keypoints k;
  k.names = {"pelvis"};
  k.uvc = PerFrame<std::vector<Vector3d>>(clip.frames(), {Vector3d(500.0, 500.0, 1.0)});
  k.intrinsics << 1000.0, 0.0, 500.0, 0.0, 1000.0, 500.0, 0.0, 0.0, 1.0;
  Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
  camera.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // looks along y
  camera(2, 3) = 6.0;
  k.extrinsics = {camera};
  clip.keypoints = k;
  shift_world({0.0, 0.0, -1.5}, clip);
  ReadConfig on_boxes;
  on_boxes.scene = Scene{{{{0.0, 0.0}, 0.0, {30.0, 30.0}, 0.3}}};
  const motion::Clip lifted = written_and_read(clip, on_boxes);
  ASSERT_TRUE(decided(lifted, "scene: 1 plate up to 0.3 m; the motion is moved"));
  const Vector3d before = motion::poses_of(clip)[0].p_WB[0], after = motion::poses_of(lifted)[0].p_WB[0];
  EXPECT_GT(after.z() - before.z(), 1.0);
  EXPECT_LT((lifted.keypoints->extrinsics[0] * after.homogeneous() -
             clip.keypoints->extrinsics[0] * before.homogeneous())
                .norm(),
            1e-6);
}

TEST(ReadMotion, TrustsOurOwnFiles) {
  motion::Clip clip = foreign("walk");
  rotate_world(rotation_to_z_up('y'), clip);
  clip.body_model = "mimicx";
  EXPECT_EQ(written_and_read(clip).trans, clip.trans);
}

// A person who lies is turned upright where the axes are detected.
TEST(ReadMotion, BelievesTheWorldOfFilesThatItWrote) {
  const motion::Clip clip = foreign("walk");
  motion::Clip lying = clip;
  rotate_world(rotation_to_z_up('y').conjugate(), lying);
  scale_world(4.0, lying);
  EXPECT_NE(written_and_read(lying).rotations, lying.rotations) << "of another program it is turned";
  write_motion(scratch("lying.npz"), lying);
  const motion::Clip back = read_motion(scratch("lying.npz"));
  EXPECT_EQ(back.rotations, lying.rotations);
  EXPECT_EQ(back.trans, lying.trans);
  EXPECT_TRUE(decided(back, "world: z up, metres, as this program wrote it"));
  EXPECT_FALSE(decided(back, "up axis: "));
  EXPECT_EQ(written_and_read(back).trans, lying.trans) << "copies say so, too";

  ReadConfig asked;
  asked.up = 'y';
  asked.scale = 0.25;
  asked.fps = 25.0;
  const motion::Clip told = read_motion(scratch("lying.npz"), asked);
  EXPECT_LT(largest_joint_distance(told, clip), 1e-9) << "the user's settings count";
  EXPECT_EQ(told.fps, 25.0);
}

TEST(ReadMotion, BelievesTheFrameRateOfFilesThatItWrote) {
  const motion::Clip slow = jumping({60.0, 60.0, 60.0}, 30.0);
  EXPECT_EQ(written_and_read(slow).fps, 60.0);
  write_motion(scratch("slow.npz"), slow);
  EXPECT_EQ(read_motion(scratch("slow.npz")).fps, 30.0);
}

TEST(WriteMotion, ArchivesOfOtherBodiesSayThatTheirWorldIsOurs) {
  motion::Clip clip = foreign("wave");
  write_motion(scratch("foreign.npz"), clip);
  EXPECT_EQ(read_npz(scratch("foreign.npz")).at("mimicx_world").text, (std::vector<std::string>{"z up, m"}));
  clip.body_model = "mimicx";
  write_motion(scratch("own.npz"), clip);
  EXPECT_FALSE(read_npz(scratch("own.npz")).has("mimicx_world")) << "the body says it";
}

// `evaluate --truth joints.npy --fps 120` once scored a result as if it had that rate, too.
TEST(ReadMotion, SimulatedMotionsKeepRateAxesUnitAndFloor) {
  motion::Clip clip = test::standing_clip(12, test::standing_height());
  const std::vector<double> none(12 * kBodies * 6, 0.0);
  clip.passthrough.emplace_back("ground_wrenches", NpyArray::from_double({12, kBodies, 6}, none.data()));
  ReadConfig config;
  config.fps = 120.0;
  config.up = 'y';
  config.scale = 0.01;
  config.floor = 0.5;
  const motion::Clip kept = written_and_read(clip), asked = written_and_read(clip, config);
  EXPECT_EQ(asked.fps, kept.fps);
  EXPECT_EQ(asked.trans, kept.trans);
  EXPECT_EQ(asked.rotations, kept.rotations);
  EXPECT_FALSE(asked.on_floor);
  motion::Clip of_another = clip;
  of_another.body_model = "smpl";
  EXPECT_EQ(written_and_read(of_another, config).fps, 120.0) << "another program's member of this name";
  clip.passthrough.clear();
  EXPECT_EQ(written_and_read(clip, config).fps, 120.0) << "without forces the settings count";
}

TEST(ReadMotion, ForcesStayWithAMotionThatSettingsOfReadingLeaveAsItWas) {
  motion::Clip clip = test::raised(test::standing_clip(12, test::standing_height()));
  const std::vector<double> none(12 * kBodies * 6, 0.0);
  clip.passthrough.emplace_back("ground_wrenches", NpyArray::from_double({12, kBodies, 6}, none.data()));
  clip.trans[0].x() += 300.0;  // read 300 m from there
  EXPECT_TRUE(written_and_read(clip).as_recorded);
  ReadConfig same;
  same.fps = 60.0, same.up = 'y', same.scale = 0.01, same.floor = 0.5, same.person = 1;
  same.standard_body = true;
  same.scene = test::wide_plate();
  EXPECT_TRUE(written_and_read(clip, same).as_recorded);
  ReadConfig heavier, on_the_floor;
  heavier.mass = 120.0;
  on_the_floor.scene.emplace();
  EXPECT_FALSE(written_and_read(clip, heavier).as_recorded);
  EXPECT_FALSE(written_and_read(clip, on_the_floor).as_recorded);
  clip.betas[0] = 1.0;
  EXPECT_FALSE(written_and_read(clip, same).as_recorded) << "another body than the standard one";
}

TEST(WriteMotion, EveryArchiveHasTheJointsOfItsBody) {
  const motion::Clip clip = foreign("wave");
  write_motion(scratch("joints.npz"), clip);
  EXPECT_EQ(read_npz(scratch("joints.npz")).at("joints").to_double(),
            motion::joint_positions_member(clip).to_double());
}

TEST(ReadMotion, TheSecondPersonOfAFileOfOneIsRefused) {
  const motion::Clip clip = foreign("wave");
  for (const char* name : {"one.npz", "one.npy", "one.bvh"}) {
    write_motion(scratch(name), clip);
    ReadConfig config;
    config.person = 1;
    EXPECT_EQ(read_motion(scratch(name), config).frames(), clip.frames()) << name;
    config.person = 2;
    try {
      read_motion(scratch(name), config);
      ADD_FAILURE() << name;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find(": expected people 1 to 2, found one person"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(ReadMotion, RejectsInvalidOptions) {
  const motion::Clip clip = foreign("wave");
  ReadConfig up, scale, fps;
  up.up = 'w';
  scale.scale = -1.0;
  fps.fps = 0.0;
  for (const ReadConfig& bad : {up, scale, fps})
    EXPECT_THROW(written_and_read(clip, bad), std::invalid_argument);
}

TEST(World, EveryAxisCanBeUp) {
  const Array<char, 6> axes = {'x', 'y', 'z', 'X', 'Y', 'Z'};
  for (int i = 0; i < 6; ++i) {
    const char axis = axes[i];
    const Vector3d up = (i < 3 ? 1.0 : -1.0) * Vector3d::Unit(i % 3);
    EXPECT_LT((rotation_to_z_up(axis) * up - Vector3d::UnitZ()).norm(), 1e-12) << axis;
  }
  EXPECT_LT((rotation_to_z_up('y') * Vector3d(1, 2, 3) - Vector3d(1, -3, 2)).norm(), 1e-12);
  EXPECT_THROW(rotation_to_z_up('q'), std::invalid_argument);
}

TEST(World, RotationTurnsEveryJointAndEveryCamera) {
  motion::Clip clip = test::random_clip(7, 6, 0.6);
  motion::Keypoints k;
  k.extrinsics = {Eigen::Matrix4d::Identity()};
  k.extrinsics[0].topRightCorner<3, 1>() = Vector3d(1, 2, 3);
  clip.keypoints = k;
  for (const char* model : {"mimicx", "smplh"}) {
    clip.body_model = model;
    const Quaterniond R(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()));
    motion::Clip turned = clip;
    rotate_world(R, turned);
    shift_world({0.3, -0.2, 5}, turned);
    const auto before = motion::poses_of(clip), after = motion::poses_of(turned);
    for (std::size_t t = 0; t < before.size(); ++t)
      for (std::size_t j = 0; j < kBodies; ++j) {
        const Vector3d expected = R * before[t].p_WB[j] + Vector3d(0.3, -0.2, 5);
        EXPECT_LT((after[t].p_WB[j] - expected).norm(), 1e-12);
        const Eigen::Vector4d seen = turned.keypoints->extrinsics[0] * after[t].p_WB[j].homogeneous();
        EXPECT_LT((seen - clip.keypoints->extrinsics[0] * before[t].p_WB[j].homogeneous()).norm(), 1e-12);
      }
  }
}

motion::Clip in_another_world(motion::Clip clip) {
  rotate_world(Quaterniond(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized())), clip);
  scale_world(0.5, clip);
  shift_world({0.3, -0.2, 5}, clip);
  return clip;
}

TEST(World, CamerasWithoutKeypointsMoveAsThoseWithKeypoints) {
  Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
  camera.topLeftCorner<3, 3>() = exp_map(Vector3d(0.3, -0.4, 0.2)).toRotationMatrix();
  camera.topRightCorner<3, 1>() = Vector3d(1, 2, 3);
  motion::Clip clip = test::random_clip(7, 6, 0.6), seen = clip;
  seen.keypoints.emplace().extrinsics = {camera};
  const Eigen::Matrix4d moved = in_another_world(seen).keypoints->extrinsics[0];
  for (const int rows : {3, 4}) {
    const NpyArray one = from_matrix(camera.topRows(rows)), want = from_matrix(moved.topRows(rows));
    const std::vector<double> once = one.to_double();
    std::vector<double> twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    const NpyArray two = NpyArray::from_double({2, one.shape[0], 4}, twice.data());
    for (const NpyArray& member : {one, two}) {
      clip.passthrough = {{"camera_extrinsics", member}};
      const motion::Clip back = in_another_world(clip);
      ASSERT_EQ(back.passthrough[0].second.shape, member.shape);
      const std::vector<double> values = back.passthrough[0].second.to_double();
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(values[i], want.to_double()[i % want.size()], 1e-12) << i;
      EXPECT_TRUE(back.warnings.empty());
    }
  }
}

TEST(World, CamerasThatCannotMoveAreLeftOutWithAWarning) {
  Eigen::Matrix4d transposed = Eigen::Matrix4d::Identity();
  transposed(3, 2) = 6.0;
  motion::Clip clip = test::random_clip(7, 6, 0.6);
  for (const NpyArray& bad : {from_matrix(transposed), from_matrix(Eigen::MatrixXd::Zero(6, 7)),
                              NpyArray::scalar(1.0), NpyArray::scalar_text("none")}) {
    clip.passthrough = {{"camera_intrinsics", from_matrix(Matrix3d::Identity())},
                        {"camera_extrinsics", bad},
                        {"labels", NpyArray::scalar_text("walk")}};
    const motion::Clip back = in_another_world(clip);
    ASSERT_EQ(back.passthrough.size(), 1u);
    EXPECT_EQ(back.passthrough[0].first, "labels");
    EXPECT_EQ(back.warnings.size(), 1u) << "one, however often the world changes";
  }
}

TEST(Motionx, NumbersThatNothingUsesNeedNotBeFinite) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(5, 322);
  values(2, 200) = NAN;  // the face
  EXPECT_EQ(motionx_from(from_matrix(values), "m", "m.npy").frames(), 5);
  for (const auto& [column, part] :
       {std::pair<Eigen::Index, std::string>{60, "pose"}, {310, "trans"}, {313, "betas"}}) {
    Eigen::MatrixXd bad = Eigen::MatrixXd::Zero(5, 322);
    bad(3, column) = NAN;
    try {
      motionx_from(from_matrix(bad), "m", "m.npy");
      FAIL() << part;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find("frame 3: expected finite numbers of " + part),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Motionx, KeepsJawAndHandsOfPosesInOneArray) {
  motion::Clip clip = test::random_clip(7, 6, 0.6);
  for (const Eigen::Index columns : {99, 90}) {  // SMPL-X: jaw, eyes, hands; SMPL-H: hands
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Random(clip.frames(), columns);
    clip.passthrough = {{"poses_rest", from_matrix(rest)}};
    const Eigen::MatrixXd values = to_matrix(to_motionx(clip));
    EXPECT_EQ(values.middleCols(66, 90), rest.rightCols(90));
    Eigen::MatrixXd jaw = Eigen::MatrixXd::Zero(clip.frames(), 3);
    if (columns == 99) jaw = rest.leftCols(3);
    EXPECT_EQ(values.middleCols(156, 3), jaw);
  }
}

TEST(Motionx, RoundTripIsExactAndKeepsUnusedColumns) {
  Eigen::MatrixXd values(5, 322);
  Random random(3, {1});
  for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = 0.3 * random.normal();
  values.rightCols(10).rowwise() = values.row(0).tail(10).eval();
  const motion::Clip clip = motionx_from(from_matrix(values), "m", "m.npy");
  const Eigen::MatrixXd back = to_matrix(to_motionx(clip));
  EXPECT_LT((back - values).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(back.middleCols(66, 243), values.middleCols(66, 243)) << "hands, jaw and face to the bit";
  // y up in the file: the pelvis of frame 0, turned by hand.
  const Vector3d pelvis = values.row(0).segment<3>(309).transpose() + mimicx::rest_pelvis("smplx");
  EXPECT_LT((motion::poses_of(clip)[0].p_WB[0] - Vector3d(pelvis.x(), -pelvis.z(), pelvis.y())).norm(),
            1e-12);
}

TEST(Motionx, UndoesTheAistScale) {
  const motion::Clip walk = foreign("walk");
  Eigen::MatrixXd values = to_matrix(to_motionx(walk));
  values.middleCols(309, 3) *= 94.0;
  values.col(311) *= -1.0;
  const motion::Clip clip = motionx_from(from_matrix(values), "walk", "walk.npy");
  EXPECT_LT(largest_joint_distance(clip, walk), 1e-9);
  EXPECT_TRUE(decided(clip, "AIST"));
  EXPECT_FALSE(decided(motionx_from(to_motionx(walk), "walk", "walk.npy"), "AIST")) << "not twice";
}

TEST(Motionx, UpOptionNamesAnAxisOfTheFile) {
  const motion::Clip walk = foreign("walk");
  const fs::path path = scratch("walk.npy");
  write_motion(path, walk);
  ReadConfig asked;
  asked.up = 'y';
  EXPECT_LT(largest_joint_distance(read_motion(path, asked), walk), 1e-9) << "y is up in the format already";
  EXPECT_TRUE(decided(read_motion(path), "up axis: y, turned to z"));

  motion::Clip turned = walk;  // written with its own axes, z up, against the custom of the format
  rotate_world(rotation_to_z_up('y'), turned);
  write_motion(path, turned);
  const motion::Clip found = read_motion(path);
  EXPECT_TRUE(decided(found, "up axis: z (")) << found.decisions[2];
  EXPECT_LT(largest_joint_distance(found, walk), 1e-9);
  asked.up = 'z';
  EXPECT_LT(largest_joint_distance(read_motion(path, asked), walk), 1e-9);
}

TEST(Motionx, TheFrameRateIsSaidToBeThatOfTheFormat) {
  const fs::path path = scratch("walk.npy");
  write_motion(path, foreign("walk"));
  const motion::Clip read = read_motion(path);
  EXPECT_TRUE(decided(read, "frame rate: 30 fps, that of Motion-X, assumed: the file tells none"));
  EXPECT_FALSE(decided(read, "as given"));
  ReadConfig asked;
  asked.fps = 60.0;
  EXPECT_TRUE(decided(read_motion(path, asked), "frame rate: 60 fps, as asked for"));
  EXPECT_FALSE(decided(read_motion(path, asked), "the file says"));
}

TEST(Motionx, RejectsOtherShapes) {
  for (const Eigen::MatrixXd& bad : {Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 321)), Eigen::MatrixXd(0, 322)})
    EXPECT_THROW(motionx_from(from_matrix(bad), "m", "m.npy"), DataError);
  Eigen::MatrixXd nan = Eigen::MatrixXd::Zero(3, 322);
  nan(1, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(motionx_from(from_matrix(nan), "m", "m.npy"), DataError);
  motion::Clip fast = foreign("wave");
  fast.fps = 60;
  EXPECT_THROW(to_motionx(fast), std::invalid_argument);
}

TEST(ReadMotion, RecognisesFormatsByContentNotBySuffix) {
  const motion::Clip clip = foreign("walk");
  const fs::path npz = scratch("a.npy"), npy = scratch("b.npz");
  write_file_atomically(npz, format_npz(motion::to_npz(clip)));
  write_file_atomically(npy, format_npy(to_motionx(clip)));
  EXPECT_LT(largest_joint_distance(read_motion(npz), clip), 1e-9);
  EXPECT_LT(largest_joint_distance(read_motion(npy), clip), 1e-9);
}

TEST(ReadMotion, SuffixesAreCaseInsensitive) {
  const motion::Clip clip = foreign("walk");
  for (const char* name : {"WALK.BVH", "walk.Npz", "walk.NPY"}) {
    write_motion(scratch(name), clip);
    EXPECT_TRUE(is_motion_file(scratch(name))) << name;
    EXPECT_LT(largest_joint_distance(read_motion(scratch(name)), clip), 1e-6) << name;
  }
}

TEST(ReadMotion, ReportsUnreadableFilesInOneLineNamingTheFile) {
  const fs::path folder = scratch("folder.npz"), empty = scratch("empty.npz"), text = scratch("text.npy"),
                 cut = scratch("cut.npz"), locked = scratch("locked.npz");
  fs::create_directories(folder);
  write_file_atomically(empty, "");
  write_file_atomically(text, "once upon a time");
  const std::string whole = format_npz(motion::to_npz(foreign("wave")));
  write_file_atomically(cut, whole.substr(0, whole.size() / 2));
  for (const fs::path& path : {folder, empty, text, cut, scratch("none.npz"), fs::path("/dev/zero")}) {
    try {
      read_motion(path);
      ADD_FAILURE() << path;
    } catch (const DataError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.rfind(path.string(), 0), 0u) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

TEST(ReadMotion, PrintsHugeNumbersInFewDigits) {
  motion::Clip own = foreign("wave");
  Npz rate = motion::to_npz(own);
  own.body_model = "mimicx";
  Npz betas = motion::to_npz(own);
  rate.set("mocap_framerate", NpyArray::scalar(1e308));
  const std::vector<double> shape(10, 1e308);
  betas.set("betas", NpyArray::from_double({10}, shape.data()));
  const std::string bvh = "HIERARCHY\nROOT a\n{\nOFFSET 1e308 0 0\n", deepmimic = "{\"Frames\": [[1e308";
  for (const std::string& bytes : {format_npz(rate), format_npz(betas), bvh, deepmimic}) try {
      motion_from(bytes, "a");
      ADD_FAILURE() << bytes.substr(0, 80);
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find("found 1e+308"), std::string::npos) << error.what();
    }
}

TEST(ReadMotion, DoesNotBlockOnAPipeInAFolder) {
  const fs::path pipe = scratch("pipe.txt");
  fs::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(is_motion_file(pipe));
  EXPECT_FALSE(holds_positions(pipe));
  EXPECT_THROW(read_motion(pipe), DataError);
}

TEST(SharedMotions, AmassAndMotionxFilesOfTheSameMotionAgree) {
  const fs::path root = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(root / "motionx")) GTEST_SKIP() << "no shared motions here";
  int compared = 0;
  for (const auto& file : fs::directory_iterator(root / "motionx")) {
    motion::Clip x = read_motion(file.path());
    const motion::Clip h = read_motion(root / "amass" / (file.path().stem().string() + "_poses.npz"));
    // J0 of both models is known to half a millimetre; without it, single precision is left.
    EXPECT_LT(largest_joint_distance(x, h), 1e-3) << file.path();
    shift_world(motion::poses_of(h)[0].p_WB[0] - motion::poses_of(x)[0].p_WB[0], x);
    EXPECT_LT(largest_joint_distance(x, h), 2e-6) << file.path();
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

TEST(SharedMotions, EveryNpzAndNpyRoundTrips) {
  const fs::path root = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(root)) GTEST_SKIP() << "no shared motions here";
  int files = 0;
  for (const char* folder : {"amass", "video", "motionx"})
    for (const auto& file : fs::directory_iterator(root / folder)) {
      const motion::Clip clip = read_motion(file.path());
      EXPECT_TRUE(decided(clip, std::string("up axis: ") + (folder == std::string("motionx") ? "y" : "z")))
          << file.path();
      EXPECT_EQ(clip.fps, 30.0) << file.path();
      for (const char* suffix : {"back.npz", "back.npy", "back.bvh"}) {
        write_motion(scratch(suffix), clip);
        EXPECT_LT(largest_joint_distance(read_motion(scratch(suffix)), clip), 1e-6)
            << file.path() << ' ' << suffix;
      }
      ++files;
    }
  EXPECT_EQ(files, 27);
}

TEST(SharedMotions, EverySkeletonFileRoundTripsInEachFormat) {
  const fs::path root = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(root)) GTEST_SKIP() << "no shared motions here";
  int files = 0;
  for (const char* folder : {"bvh", "deepmimic"})
    for (const auto& file : fs::directory_iterator(root / folder)) {
      const motion::Clip clip = read_motion(file.path());
      EXPECT_TRUE(is_motion_file(file.path())) << file.path();
      EXPECT_TRUE(decided(clip, "format: ")) << file.path();
      const bool bvh = folder == std::string("bvh");
      const std::string text = read_text(file.path());
      EXPECT_EQ(clip.fps, (bvh ? parse_bvh(text, file.path()) : parse_deepmimic(text, file.path())).fps)
          << file.path();
      for (const char* suffix : {"back.bvh", "back.npz"}) {
        write_motion(scratch(suffix), clip);
        EXPECT_LT(largest_joint_distance(read_motion(scratch(suffix)), clip), 1e-6)
            << file.path() << ' ' << suffix;
      }
      ++files;
    }
  EXPECT_EQ(files, 28);
  EXPECT_FALSE(is_motion_file(root / "README.md"));
}

TEST(ReadMotion, RecognisesSkeletonsAndAppliesOptionsToThem) {
  const motion::Clip clip = foreign("walk");
  const fs::path path = scratch("walk.npz");  // a BVH by another name
  write_motion(scratch("walk.bvh"), clip);
  fs::copy_file(scratch("walk.bvh"), path, fs::copy_options::overwrite_existing);
  EXPECT_LT(largest_joint_distance(read_motion(path), clip), 1e-6);
  ReadConfig asked;
  asked.fps = 25.0;
  EXPECT_EQ(read_motion(path, asked).fps, 25.0);
  EXPECT_EQ(recognise("\xEF\xBB\xBF\r\n hierarchy\n"), MotionFormat::kBvh);
  EXPECT_EQ(recognise(" {\"Loop\": 1}"), MotionFormat::kDeepMimic);
  EXPECT_EQ(recognise("HIERARCH"), MotionFormat::kUnknown);
  EXPECT_EQ(recognise(""), MotionFormat::kUnknown);
}

}  // namespace
}  // namespace mimicx::import

#include "import/bvh.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "import/text_input.h"
#include "motion/made_motions.h"

namespace mimicx::import {
namespace {

namespace fs = std::filesystem;
using test::random_clip;

const std::string kSmall =
    "HIERARCHY\n"
    "ROOT Hips\n"
    "{\n"
    "  OFFSET 1 2 3\n"
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "  JOINT Chest\n"
    "  {\n"
    "    OFFSET 0 10 0\n"
    "    CHANNELS 3 Yrotation Xrotation Zrotation\n"
    "    End Site\n"
    "    {\n"
    "      OFFSET 0 5 1\n"
    "    }\n"
    "  }\n"
    "}\n"
    "MOTION\n"
    "Frames: 2\n"
    "Frame Time: 0.00833333\n"
    "10 20 30 40 50 60 70 80 90\n"
    "11 21 31 41 51 61 71 81 91\n";

/// The message of the DataError that parsing gives; it always names the file.
std::string refusal(const std::string& text) {
  try {
    parse_bvh(text, "a/clip.bvh");
  } catch (const DataError& e) {
    EXPECT_NE(std::string(e.what()).find("a/clip.bvh"), std::string::npos) << e.what();
    return e.what();
  }
  return "nothing was refused";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refusal(const std::string& text, const std::string& line, const std::string& word) {
  const std::string message = refusal(text);
  EXPECT_NE(message.find(line), std::string::npos) << message;
  EXPECT_NE(message.find(word), std::string::npos) << message;
}

/// Rotation matrix about x, y or z by an angle in degrees, written out.
Matrix3d about(char axis, double degrees) {
  const double a = degrees * std::acos(-1.0) / 180.0, c = std::cos(a), s = std::sin(a);
  Matrix3d m;
  if (axis == 'X') m << 1, 0, 0, 0, c, -s, 0, s, c;
  if (axis == 'Y') m << c, 0, s, 0, 1, 0, -s, 0, c;
  if (axis == 'Z') m << c, -s, 0, s, c, 0, 0, 0, 1;
  return m;
}

/// A tree of ten joints with random channels, as text and as what it must evaluate to.
struct RandomFile {
  std::string text;
  std::vector<Vector3d> p;  ///< world positions of joints and end sites in the one frame
};

RandomFile random_file(std::uint64_t seed) {
  Random random(seed, {0x627668});
  RandomFile file;
  std::ostringstream hierarchy, frame;
  frame.precision(17);
  hierarchy.precision(17);
  // A chain: every joint holds the next one; the last an end site.
  std::string closing;
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
  for (int joint = 0; joint < 10; ++joint) {
    Vector3d offset = test::random_vector(random);
    hierarchy << (joint == 0 ? "HIERARCHY\nROOT j" : "JOINT j") << joint << "\n{\nOFFSET " << offset.x()
              << ' ' << offset.y() << ' ' << offset.z() << '\n';
    std::vector<std::string> channels = {"Xrotation", "Yrotation", "Zrotation"};
    if (random.below(2) == 0) channels.insert(channels.end(), {"Xposition", "Yposition", "Zposition"});
    for (std::size_t i = channels.size(); i > 1; --i)
      std::swap(channels[i - 1], channels[random.below(static_cast<std::uint32_t>(i))]);
    hierarchy << "CHANNELS " << channels.size();
    Matrix3d local = Matrix3d::Identity();
    for (const std::string& channel : channels) {
      hierarchy << ' ' << channel;
      const double value = random.uniform(-200.0, 200.0);
      frame << value << ' ';
      if (channel.ends_with("rotation"))
        local *= about(channel[0], value);
      else
        offset[channel[0] - 'X'] = value;
    }
    hierarchy << '\n';
    closing += "}\n";
    p += R * offset;
    R *= local;
    file.p.push_back(p);
  }
  hierarchy << "End Site\n{\nOFFSET 1 2 3\n}\n" << closing;
  file.p.push_back(p + R * Vector3d(1, 2, 3));
  file.text = hierarchy.str() + "MOTION\nFrames: 1\nFrame Time: 0.05\n" + frame.str() + "\n";
  return file;
}

TEST(Bvh, EveryChannelOrderIsMultipliedAsWritten) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const RandomFile file = random_file(seed);
    const SkeletonMotion motion = parse_bvh(file.text, "random.bvh");
    ASSERT_EQ(motion.joints.size(), file.p.size());
    const SkeletonPose pose = pose_of(motion, 0);
    for (std::size_t j = 0; j < file.p.size(); ++j) EXPECT_LT((pose.p[j] - file.p[j]).norm(), 1e-9) << seed;
    EXPECT_EQ(motion.fps, 20.0);
  }
}

TEST(Bvh, PositionChannelsReplaceTheOffset) {
  const SkeletonMotion motion = parse_bvh(kSmall, "small.bvh");
  EXPECT_EQ(motion.translation[0][0], Vector3d(10, 20, 30));
  EXPECT_EQ(motion.translation[1][1], Vector3d(0, 10, 0));
  EXPECT_EQ(rest_pose(motion).p[2], Vector3d(1, 17, 4));
}

TEST(Bvh, ReadsNamesEndSitesAndFrameRate) {
  const SkeletonMotion motion = parse_bvh(kSmall, "folder/small.bvh");
  EXPECT_EQ(motion.name, "small");
  ASSERT_EQ(motion.joints.size(), 3u);
  EXPECT_EQ(motion.joints[1].name, "Chest");
  EXPECT_EQ(motion.joints[2].name, "Chest_end");
  EXPECT_TRUE(motion.joints[2].end_site);
  EXPECT_EQ(motion.fps, 120.0);  // of a time printed with six digits
  ASSERT_EQ(motion.decisions.size(), 1u);
  EXPECT_NE(motion.decisions[0].find("120"), std::string::npos);
}

TEST(Bvh, AcceptsAnyWhitespaceAndCase) {
  std::string other;
  for (std::size_t i = 0; i < kSmall.size(); ++i) {  // mixed line ends, tabs, blank lines
    const char c = kSmall[i];
    if (c == ' ') other += i % 3 == 0 ? "\t" : "  ";
    if (c == '\n') other += i % 2 == 0 ? "\r\n" : i % 5 == 0 ? "\r" : "\n\n";
    if (c != ' ' && c != '\n') other += c;
  }
  other = "\xef\xbb\xbf" + replaced(replaced(other, "HIERARCHY", "hierarchy"), "Zrotation", "ZROTATION");
  const SkeletonMotion a = parse_bvh(kSmall, "a.bvh"), b = parse_bvh(other, "a.bvh");
  for (int t = 0; t < 2; ++t) EXPECT_EQ(pose_of(a, t).p, pose_of(b, t).p);
}

TEST(Bvh, LabelsTakeAnyCaseAndBlanksAroundTheirColon) {
  const SkeletonMotion whole = parse_bvh(kSmall, "a");
  for (const auto& [from, to] : {std::pair{"Frames: 2", "Frames:2"},
                                 {"Frames: 2", "frames :\t2"},
                                 {"Frame Time: 0", "FRAME TIME:0"},
                                 {"Frame Time: 0", "FrameTime:\t0"},
                                 {"End Site", "EndSite"},
                                 {"HIERARCHY", "# by hand\n// twice\nHIERARCHY"}}) {
    const SkeletonMotion motion = parse_bvh(replaced(kSmall, from, to), "a");
    EXPECT_EQ(motion.fps, whole.fps) << to;
    EXPECT_EQ(motion.translation, whole.translation) << to;
  }
}

TEST(Bvh, TheGivenRateStandsInForAFrameTime) {
  for (const std::string time : {"0", "0.000000", "nan", "30", "", "soon"}) {
    const std::string text = replaced(kSmall, "0.00833333", time);
    expect_refusal(text, "line 18", "frame time");
    const SkeletonMotion motion = parse_bvh(text, "a", {50.0, false});
    EXPECT_EQ(motion.fps, 50.0) << time;
    EXPECT_EQ(motion.frames(), 2) << time;
  }
}

TEST(Bvh, NumbersTooNearToZeroAreZero) {
  EXPECT_EQ(parse_bvh(replaced(kSmall, "OFFSET 1 2 3", "OFFSET 1e-400 -1e-400 3"), "a").joints[0].offset,
            Vector3d(0, 0, 3));
}

TEST(Bvh, BracesInsideCharactersOfShiftJisAreNone) {
  const std::string bones = "\x83{\x81[\x83\x93";  // ボーン, whose second byte is '{'
  const SkeletonMotion motion = parse_bvh(replaced(kSmall, "Chest", bones), "a");
  EXPECT_EQ(motion.joints[1].name, "\\x83{\\x81[\\x83\\x93");
  EXPECT_EQ(motion.joints.size(), 3u);
}

TEST(Bvh, LongNamesStayWhole) {
  const std::string name(300, 'n');
  EXPECT_EQ(parse_bvh(replaced(kSmall, "Chest", name), "a").joints[1].name, name);
}

TEST(Bvh, PositionsThatWouldCollapseTheSkeletonAreAddedToTheOffset) {
  std::string text = replaced(kSmall, "CHANNELS 3 Yrotation Xrotation Zrotation",
                              "CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation");
  text = replaced(text, "60 70 80 90", "60 0.01 0 0 70 80 90");
  text = replaced(text, "61 71 81 91", "61 0 0 0 71 81 91");
  const SkeletonMotion motion = parse_bvh(text, "a");
  EXPECT_EQ(motion.translation[0][1], Vector3d(0.01, 10, 0));
  ASSERT_FALSE(motion.decisions.empty());
  EXPECT_NE(motion.decisions.back().find("displacements"), std::string::npos);
}

TEST(Bvh, SaysThatNothingHasAPosition) {
  std::string text = replaced(kSmall, "CHANNELS 6 Xposition Yposition Zposition ", "CHANNELS 3 ");
  text = replaced(text, "10 20 30 ", "");
  text = replaced(text, "11 21 31 ", "");
  const SkeletonMotion motion = parse_bvh(text, "a");
  ASSERT_EQ(motion.warnings.size(), 1u);
  EXPECT_NE(motion.warnings[0].find("no joint has position channels"), std::string::npos);
}

TEST(Bvh, ReadsSeveralSkeletons) {
  const std::string second =
      "ROOT Ball\n{\n OFFSET 0 0 0\n CHANNELS 3 Xposition Yposition Zposition\n}\nMOTION";
  std::string text = replaced(kSmall, "MOTION", second);
  text = replaced(text, "80 90", "80 90 1 2 3");
  text = replaced(text, "81 91", "81 91 4 5 6");
  const SkeletonMotion motion = parse_bvh(text, "a");
  EXPECT_EQ(motion.joints.back().name, "Ball");
  EXPECT_EQ(motion.joints.back().parent, -1);
  EXPECT_EQ(pose_of(motion, 1).p.back(), Vector3d(4, 5, 6));
}

TEST(Bvh, AcceptsNamesWithBlanksAndInvalidText) {
  EXPECT_EQ(parse_bvh(replaced(kSmall, "JOINT Chest\n  {", "JOINT Bip01 L Thigh {"), "a").joints[1].name,
            "Bip01 L Thigh");
  EXPECT_EQ(parse_bvh(replaced(kSmall, "Chest", "Ch\xff\xc3st\x01"), "a").joints[1].name,
            "Ch\\xff\\xc3st\\x01");
  EXPECT_EQ(parse_bvh(replaced(kSmall, "Chest", "\xe8\x85\xb0"), "a").joints[1].name, "\xe8\x85\xb0");
}

TEST(Bvh, ReportsErrorsWithTheirLine) {
  expect_refusal("", "line 1", "the end of the file");
  expect_refusal("PK\x03\x04", "line 1", "'HIERARCHY'");
  expect_refusal(replaced(kSmall, "OFFSET 0 10 0", "OFFSET 0 ten 0"), "line 8", "'ten'");
  expect_refusal(replaced(kSmall, "OFFSET 0 10 0", "OFFSET 0 nan 0"), "line 8", "'nan'");
  expect_refusal(replaced(kSmall, "OFFSET 0 10 0", "OFFSET 0 1e300 0"), "line 8", "1e7");
  expect_refusal(replaced(kSmall, "Xrotation Yrotation\n", "Xrotation Wrotation\n"), "line 5", "'Wrotation'");
  expect_refusal(replaced(kSmall, "CHANNELS 3", "CHANNELS 99999999999999999999"), "line 9",
                 "99999999999999999999");
  expect_refusal(replaced(kSmall, "  }\n}\nMOTION", "  }\nMOTION"), "line 15", "'MOTION'");
  expect_refusal(replaced(kSmall, "    }\n  }\n}", "    }\n  }\n}\n}"), "line 16", "'}'");
  expect_refusal(replaced(kSmall, "End Site\n    {", "End Site\n    { JOINT x"), "line 11", "'JOINT'");
  expect_refusal(replaced(kSmall, "Frames: 2", "Frames: 0"), "line 17", "'0'");
  expect_refusal(replaced(kSmall, "Frames: 2", "Frames: -1"), "line 17", "'-1'");
  expect_refusal(replaced(kSmall, "0.00833333", "0"), "line 18", "'0'");
  expect_refusal(replaced(kSmall, "70 80 90", "70 80"), "line 19", "number 9 of the 9 of frame 0");
  expect_refusal(replaced(kSmall, "70 80 90", "70 80 90 95"), "line 19", "more");
  expect_refusal(replaced(kSmall, "51 61", "51 inf"), "line 20", "'inf'");
}

TEST(Bvh, ChecksTheClaimedSizeBeforeAllocating) {
  expect_refusal(replaced(kSmall, "Frames: 2", "Frames: 5000000"), "line 18", "5000000 frames");
  expect_refusal(replaced(kSmall, "Frames: 2", "Frames: 18446744073709551616"), "line 17",
                 "18446744073709551616");
  std::string deep = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\n";
  for (int i = 0; i < 100000; ++i) deep += "JOINT j\n{\n";
  expect_refusal(deep, "line", "256 levels");
  std::string wide = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\n";
  for (int i = 0; i < 10000; ++i) wide += "JOINT j\n{\n}\n";
  expect_refusal(wide, "line", "4096 joints");
}

TEST(Bvh, RejectsEveryTruncation) {
  const std::size_t last_number = kSmall.rfind(' ');
  for (std::size_t length = 0; length <= last_number; ++length)
    EXPECT_NE(refusal(kSmall.substr(0, length)).find("line"), std::string::npos) << length;
}

TEST(Bvh, WarnsOfFramesBeyondTheClaimedNumber) {
  const SkeletonMotion motion = parse_bvh(replaced(kSmall, "Frames: 2", "Frames: 1"), "a.bvh");
  EXPECT_EQ(motion.frames(), 1);
  ASSERT_EQ(motion.warnings.size(), 1u);
}

TEST(Bvh, RejectsFoldersAndMissingFiles) {
  EXPECT_THROW(read_motion(::testing::TempDir()), DataError);
  EXPECT_THROW(read_motion("/no/such/file.bvh"), DataError);
  const fs::path pipe = fs::path(::testing::TempDir()) / "mimicx_bvh_test_pipe";
  fs::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(read_motion(pipe), DataError);  // and does not wait for a writer
  fs::remove(pipe);
}

/// Largest distance between the joints of a clip and those of the skeleton written for it, m.
double round_trip_error(const motion::Clip& clip) {
  const fs::path path =
      fs::path(::testing::TempDir()) /
      (std::string("mimicx_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".bvh");
  write_bvh(path, clip);
  const SkeletonMotion motion = parse_bvh(read_text(path), path);
  EXPECT_EQ(motion.frames(), clip.frames());
  EXPECT_NEAR(motion.fps, clip.fps, 1e-6 * clip.fps);
  double worst = 0.0;
  const auto poses = motion::poses_of(clip);
  for (int t = 0; t < motion.frames(); ++t) {
    const SkeletonPose pose = pose_of(motion, t);
    for (std::size_t j = 0; j < motion.joints.size(); ++j)
      for (std::size_t b = 0; b < kBodies; ++b)
        if (motion.joints[j].name == kBodyNames[b]) {
          const Vector3d& p = pose.p[j];  // y up → z up
          worst = std::max(worst, (Vector3d(p.x(), -p.z(), p.y()) - poses[t].p_WB[b]).norm());
        }
  }
  return worst;
}

TEST(BvhWrite, RoundTripKeepsEveryPosition) {
  for (const double fps : {30.0, 29.97, 59.94, 120.0, 100.0 / 3.0}) {
    motion::Clip clip = test::random_clip(7, 40, 1.5, fps);
    clip.betas = {1.0, -0.5, 2.0, -1.0, 0.5, 0.3, -2.0, 1.5, 0.7, -0.4};
    EXPECT_LT(round_trip_error(clip), 1e-6) << fps;
  }
}

TEST(BvhWrite, RoundTripHoldsAtGimbalLock) {
  motion::Clip clip = test::random_clip(8, 30, 1.0);
  for (std::size_t t = 0; t < clip.rotations.size(); ++t)
    for (std::size_t j = 1; j < kBodies; ++j) {
      const double a = 0.1 * static_cast<double>(t * j), side = j % 2 == 0 ? 1.0 : -1.0;
      const double nearly = t % 3 == 0 ? 0.0 : t % 3 == 1 ? 1e-9 : 1e-5;
      clip.rotations[t][j] = log_map(exp_map(a * Vector3d::UnitZ()) *
                                     exp_map(side * (test::kPi / 2 - nearly) * Vector3d::UnitY()) *
                                     exp_map(0.3 * Vector3d::UnitX()));
    }
  EXPECT_LT(round_trip_error(clip), 1e-6);
}

TEST(BvhWrite, CurvesDoNotJump) {
  motion::Clip clip = test::random_clip(9, 90, 0.0);
  for (std::size_t t = 0; t < clip.rotations.size();
       ++t)  // 4° per frame about an oblique axis, more than a full turn
    for (std::size_t j = 0; j < kBodies; ++j)
      clip.rotations[t][j] =
          log_map(exp_map(0.07 * static_cast<double>(t) * Vector3d(0.8, 0.1, 0.59).normalized()));
  std::istringstream text(format_bvh(clip));
  std::string line;
  while (line.find("Frame Time") == std::string::npos) std::getline(text, line);
  std::vector<double> last;
  double largest = 0.0;
  while (std::getline(text, line)) {
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double value; numbers >> value;) row.push_back(value);
    for (std::size_t c = 0; c < last.size(); ++c) largest = std::max(largest, std::abs(row[c] - last[c]));
    last = row;
  }
  EXPECT_EQ(last.size(), 69u);
  EXPECT_LT(largest, 90.0);  // 360 or 180 where a curve jumps
}

TEST(BvhWrite, RestPoseIsTheTPoseInMetres) {
  motion::Clip clip = test::random_clip(10, 2, 1.0);
  clip.betas[0] = 2.0;
  const SkeletonMotion motion = parse_bvh(format_bvh(clip), "a.bvh");
  const SkeletonPose rest = rest_pose(motion);
  PerBody<Quaterniond> identity;
  identity.fill(Quaterniond::Identity());
  const BodyPoses expected = forward_kinematics(make_character(clip.betas), Vector3d::Zero(), identity);
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
    for (std::size_t b = 0; b < kBodies; ++b)
      if (motion.joints[j].name == kBodyNames[b]) {
        EXPECT_LT((rest.p[j] - expected.p_WB[b]).norm(), 1e-8);
      }
}

}  // namespace
}  // namespace mimicx::import

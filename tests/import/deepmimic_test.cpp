#include "import/deepmimic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/error.h"

namespace mimicx::import {
namespace {

/// A row with every rotation the identity and every hinge straight.
std::vector<double> rest_row(double duration = 0.02) {
  std::vector<double> row = {duration, 0, 0.9, 0};
  for (const int numbers : {4, 4, 4, 4, 1, 4, 4, 1, 4, 1, 4, 4, 1})  // root … left elbow
    for (int i = 0; i < numbers; ++i) row.push_back(numbers == 4 && i == 0 ? 1.0 : 0.0);
  return row;
}
constexpr std::size_t kRightKneeColumn = 20, kRightElbowColumn = 29, kLeftHipColumn = 30;

std::string json(const std::vector<std::vector<double>>& rows,
                 const std::string& before = "\"Loop\": \"wrap\",\n") {
  std::ostringstream text;
  text.precision(17);
  text << "{\n" << before << "\"Frames\":\n[\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text << (r ? ",\n[" : "[");
    for (std::size_t c = 0; c < rows[r].size(); ++c) text << (c ? ", " : "") << rows[r][c];
    text << ']';
  }
  return text.str() + "\n]\n}\n";
}

Vector3d place(const SkeletonMotion& motion, const std::string& name, int frame = 0) {
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
    if (motion.joints[j].name == name) return pose_of(motion, frame).p[j];
  throw std::logic_error(name);
}

void expect_refused_clip(const std::string& text, const std::string& place, const std::string& word) {
  try {
    parse_deepmimic(text, "clip.txt");
    FAIL() << "not refused: " << word;
  } catch (const DataError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("clip.txt: " + place), std::string::npos) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(DeepMimic, RestPoseHasHangingArmsAndStraightLegs) {
  const SkeletonMotion motion = parse_deepmimic(json({rest_row()}), "a.txt");
  EXPECT_LT((place(motion, "right_ankle") - Vector3d(0, 0.9 - 0.421546 - 0.409870, 0.084887)).norm(), 1e-12);
  EXPECT_LT((place(motion, "left_elbow_end") - place(motion, "left_shoulder") -
             Vector3d(0, -0.274788 - 0.258947, 0))
                .norm(),
            1e-12);
}

TEST(DeepMimic, HingesTurnAboutZAndBendTheRightWay) {
  auto row = rest_row();
  row[kRightKneeColumn] = -1.0;
  row[kRightElbowColumn] = 1.0;
  const SkeletonMotion motion = parse_deepmimic(json({row}), "a.txt");
  const Vector3d shank = place(motion, "right_ankle") - place(motion, "right_knee");
  EXPECT_LT((shank - 0.409870 * Vector3d(-std::sin(1.0), -std::cos(1.0), 0)).norm(),
            1e-12);  // heel goes back
  const Vector3d forearm = place(motion, "right_elbow_end") - place(motion, "right_elbow");
  EXPECT_LT((forearm - 0.258947 * Vector3d(std::sin(1.0), -std::cos(1.0), 0)).norm(),
            1e-12);  // hand comes forward
}

TEST(DeepMimic, QuaternionsAreWxyzAndNormalised) {
  auto row = rest_row();
  row[kLeftHipColumn] = 1.1 * std::sqrt(0.5);      // w
  row[kLeftHipColumn + 1] = 1.1 * std::sqrt(0.5);  // x: a quarter turn swings the leg from −y to −z
  const SkeletonMotion motion = parse_deepmimic(json({row}), "a.txt");
  const Vector3d thigh = place(motion, "left_knee") - place(motion, "left_hip");
  EXPECT_LT((thigh - Vector3d(0, 0, -0.421546)).norm(), 1e-12);
}

TEST(DeepMimic, IgnoresTheLastDuration) {
  const SkeletonMotion motion =
      parse_deepmimic(json({rest_row(0.016666), rest_row(0.016666), rest_row(0.0)}), "b/a.txt");
  EXPECT_EQ(motion.fps, 60.0);
  EXPECT_EQ(motion.frames(), 3);
  EXPECT_EQ(motion.name, "a");
  EXPECT_TRUE(motion.warnings.empty());
  EXPECT_EQ(parse_deepmimic(json({rest_row(0.02), rest_row(0.02), rest_row(0.05), rest_row(0.0)}), "a")
                .warnings.size(),
            1u);
}

TEST(DeepMimic, ChecksAndIgnoresOtherKeys) {
  const std::string other =
      "\"A, \\\" [\": [], \"B\": {\"x\": [1, -2.5e3, {\"y\": null}], \"z\": true}, \"C\": {},";
  EXPECT_EQ(parse_deepmimic(json({rest_row()}, other), "a").frames(), 1);
  expect_refused_clip(json({rest_row()}, "\"B\": [1,],\n"), "line 2", "']'");
  expect_refused_clip(json({rest_row()}, "\"B\": maybe,\n"), "line 2", "'maybe'");
  expect_refused_clip("{\"B\": \"open", "line 1", "quotation mark");
}

TEST(DeepMimic, ReportsErrorsWithTheirLine) {
  const std::string good = json({rest_row(), rest_row()});
  expect_refused_clip("", "line 1", "the end of the file");
  expect_refused_clip("[1]", "line 1", "'['");
  expect_refused_clip("{\"Loop\": \"none\"}", "expected a list of Frames", "none");
  expect_refused_clip("{\"Frames\": []}", "line 1", "at least one frame");
  expect_refused_clip(good.substr(0, good.size() / 2), "line 5", "the end of the file");
  expect_refused_clip(good + "x", "line 9", "'x'");
  auto row = rest_row();
  row.pop_back();
  expect_refused_clip(json({rest_row(), row}), "line 6", "','");
  row = rest_row();
  row.push_back(1.0);
  expect_refused_clip(json({row}), "line 5", "']'");
  row = rest_row();
  row[kLeftHipColumn] = 0.0;
  expect_refused_clip(json({row}), "line 5", "left_hip");
  row = rest_row();
  row[2] = 1e9;
  expect_refused_clip(json({row}), "line 5", "10000");
  expect_refused_clip(json({rest_row(0.0)}), "Frames", "durations");
  std::string nan = good;
  expect_refused_clip(nan.replace(nan.find("0.9"), 3, "nan"), "line 5", "number 3 of the 44 of frame 0");
}

TEST(DeepMimic, QuaternionsAsXyzwAreRefused) {
  std::vector<double> row = rest_row();
  std::size_t c = 4;
  for (const int numbers : {4, 4, 4, 4, 1, 4, 4, 1, 4, 1, 4, 4, 1}) {
    if (numbers == 4) std::swap(row[c], row[c + 3]);
    c += static_cast<std::size_t>(numbers);
  }
  expect_refused_clip(json({row, row}), "Frames", "x, y, z, w?");
}

TEST(DeepMimic, BoundsTheNestingOfBrackets) {
  expect_refused_clip("{\"A\": " + std::string(1000000, '['), "line 1", "64 levels");
}

TEST(DeepMimic, RejectsEveryTruncation) {
  const std::string good = json({rest_row()});
  for (std::size_t length = 0; length + 1 < good.size(); ++length)
    EXPECT_THROW(parse_deepmimic(good.substr(0, length), "a.txt"), DataError) << length;
}

}  // namespace
}  // namespace mimicx::import

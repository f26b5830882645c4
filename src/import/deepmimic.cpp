#include "import/deepmimic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/number_text.h"
#include "core/quantile.h"
#include "import/evidence/frame_rate.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

constexpr int kColumns = 44;
constexpr int kMaxNesting = 64;         ///< of values that are skipped
constexpr double kMaxFrameValue = 1e4;  ///< m, rad

/// A joint of the humanoid: its position in its parent's frame (m) and its columns in a row.
struct HumanoidJoint {
  const char* name;
  int parent;
  Vector3d offset;
  int numbers;  ///< 4: quaternion, 1: angle about z, 0: fixed
};

/// Joint offsets as published with the paper. The last joint of an ankle is the front lower edge of its foot
/// box.
const std::array<HumanoidJoint, 17>& humanoid() {
  static const std::array<HumanoidJoint, 17> joints = {{
      {"root", -1, {0, 0, 0}, 4},
      {"chest", 0, {0, 0.236151, 0}, 4},
      {"neck", 1, {0, 0.223894, 0}, 4},
      {"right_hip", 0, {0, 0, 0.084887}, 4},
      {"right_knee", 3, {0, -0.421546, 0}, 1},
      {"right_ankle", 4, {0, -0.409870, 0}, 4},
      {"right_ankle_end", 5, {0.1335, -0.05, 0}, 0},
      {"right_shoulder", 1, {-0.02405, 0.24350, 0.18311}, 4},
      {"right_elbow", 7, {0, -0.274788, 0}, 1},
      {"right_elbow_end", 8, {0, -0.258947, 0}, 0},
      {"left_hip", 0, {0, 0, -0.084887}, 4},
      {"left_knee", 10, {0, -0.421546, 0}, 1},
      {"left_ankle", 11, {0, -0.409870, 0}, 4},
      {"left_ankle_end", 12, {0.1335, -0.05, 0}, 0},
      {"left_shoulder", 1, {-0.02405, 0.24350, -0.18311}, 4},
      {"left_elbow", 14, {0, -0.274788, 0}, 1},
      {"left_elbow_end", 15, {0, -0.258947, 0}, 0},
  }};
  return joints;
}

using Row = Array<double, kColumns>;

/// Checks any JSON value and ignores it.
void skip_value(TextInput& in, int depth) {
  if (depth > kMaxNesting) in.fail_with("at most 64 levels of brackets", "more");
  const std::string_view word = in.word();
  if (word == "\"") {
    in.quoted();
  } else if (word == "[" || word == "{") {
    const std::string_view end = word == "[" ? "]" : "}";
    if (in.peek() == end) {
      in.word();
      return;
    }
    do {
      if (end == "}") {
        in.expect("\"");
        in.quoted();
        in.expect(":");
      }
      skip_value(in, depth + 1);
    } while (in.peek() == "," && !in.word().empty());
    in.expect(end);
  } else if (double number;
             word != "true" && word != "false" && word != "null" && !parse_number(word, number)) {
    in.fail("a JSON value", word);
  }
}

Row read_row(TextInput& in, std::size_t frame) {
  Row row{};
  in.expect("[");
  for (int c = 0; c < kColumns; ++c) {
    if (c > 0) in.expect(",");
    double& value = row[c];
    value = in.number("number " + std::to_string(c + 1) + " of the 44 of frame " + std::to_string(frame));
    if (std::abs(value) > kMaxFrameValue) in.fail_with("a number within ±10000", text_of(value));
  }
  in.expect("]");
  return row;
}

void add_frame(TextInput& in, const Row& row, SkeletonMotion& motion) {
  const auto& joints = humanoid();
  auto& translation = motion.translation.emplace_back();
  auto& rotation = motion.rotation.emplace_back();
  int c = 4;
  for (const HumanoidJoint& joint : joints) {
    translation.push_back(joint.parent < 0 ? Vector3d(row[1], row[2], row[3]) : joint.offset);
    Quaterniond q = Quaterniond::Identity();
    if (joint.numbers == 1) q = exp_map(row[c] * Vector3d::UnitZ());
    if (joint.numbers == 4) {
      q = Quaterniond(row[c], row[c + 1], row[c + 2], row[c + 3]);
      // Published clips have some that are off by 20 %.
      if (!(q.norm() > 0.5 && q.norm() < 2.0))
        in.fail_with("a unit quaternion for " + std::string(joint.name),
                     "one of length " + std::to_string(q.norm()));
      q.normalize();
    }
    rotation.push_back(q);
    c += joint.numbers;
  }
}

/// "Frames": the rows. @return the durations, s
std::vector<double> read_frames(TextInput& in, SkeletonMotion& motion) {
  std::vector<double> durations;
  in.expect("[");
  if (in.peek() == "]") in.fail_with("at least one frame", "none");
  do {
    if (durations.size() == kMaxJointFrames / humanoid().size())
      in.fail_with("less than a million frames", "more");
    const Row row = read_row(in, durations.size());
    add_frame(in, row, motion);
    durations.push_back(row[0]);
  } while (in.peek() == "," && !in.word().empty());
  in.expect("]");
  return durations;
}

/// Throws where the rotations of joints, which are small in most frames, are large as they are read and would
/// be small as x, y, z, w.
void require_real_part_first(const SkeletonMotion& motion) {
  double first = 0.0, last = 0.0;
  for (const auto& frame : motion.rotation)
    for (std::size_t j = 1; j < humanoid().size(); ++j)
      if (humanoid()[j].numbers == 4) first += std::abs(frame[j].w()), last += std::abs(frame[j].z());
  if (last > first)
    throw DataError(motion.path, "Frames", "quaternions as w, x, y, z",
                    "ones whose last number is the largest (x, y, z, w?)");
}

/// The median duration counts: the last frame's is 0 in most files.
void set_fps(std::vector<double> durations, SkeletonMotion& motion) {
  if (durations.size() > 1) durations.pop_back();
  const double duration = median(durations);
  if (!(duration >= 1.0 / kMaxFps && duration <= 10.0))
    throw DataError(motion.path, "Frames", "frame durations between 0.0005 and 10 s",
                    std::to_string(duration) + " s");
  const auto [shortest, longest] = std::minmax_element(durations.begin(), durations.end());
  if (*longest > 1.01 * duration || *shortest < 0.99 * duration)
    motion.warnings.push_back("frames have different durations: all are taken to last " +
                              std::to_string(duration) + " s");
  motion.fps = rate_of_frame_time(text_of(duration), duration);
}

}  // namespace

SkeletonMotion parse_deepmimic(std::string_view text, const std::filesystem::path& path,
                               const std::optional<double>& fps) {
  TextInput in(text, path.string(), "{}[],:\"");
  SkeletonMotion motion;
  motion.name = path.stem().string();
  motion.path = path.string();
  motion.metric_up = 'y';
  for (const HumanoidJoint& joint : humanoid())
    motion.joints.push_back({joint.name, joint.parent, joint.offset, joint.numbers == 0});
  std::vector<double> durations;
  in.expect("{");
  do {
    in.expect("\"");
    const std::string_view key = in.quoted();
    in.expect(":");
    if (key != "Frames")
      skip_value(in, 0);
    else if (durations.empty())
      durations = read_frames(in, motion);
    else
      in.fail_with("one list of Frames", "a second one");
  } while (in.peek() == "," && !in.word().empty());
  in.expect("}");
  if (const std::string_view rest = in.word(); !rest.empty())
    in.fail_with("nothing after the closing brace", "'" + printable(rest) + "'");
  if (durations.empty()) throw DataError(motion.path, "", "a list of Frames", "none");
  require_real_part_first(motion);
  if (fps)
    motion.fps = *fps;
  else
    set_fps(durations, motion);
  return motion;
}

}  // namespace mimicx::import

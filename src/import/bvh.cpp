#include "import/bvh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/number_text.h"
#include "core/units.h"
#include "import/evidence/frame_rate.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

constexpr std::size_t kMaxJoints = 4096;
constexpr std::size_t kMaxDepth = 256;
constexpr std::size_t kMaxChannels = 6;   ///< of one joint
constexpr double kMaxChannelValue = 1e7;  ///< degrees or file units: 10 km in millimetres

/// One column of the MOTION part.
struct Channel {
  std::size_t joint;
  int axis;  ///< 0, 1, 2
  bool rotation;
};

struct Hierarchy {
  std::vector<SkeletonJoint> joints;
  std::vector<Channel> channels;  ///< in the order of the columns
};

/// BVH keywords are found in any case.
bool is_word(std::string_view word, std::string_view keyword) { return equal_but_for_case(word, keyword); }

double bounded_number(TextInput& in, const std::string& what) {
  const double value = in.number(what);
  if (std::abs(value) > kMaxChannelValue) in.fail_with("a number within ±1e7", text_of(value));
  return value;
}

/// The rest of the line up to an opening brace: names may have spaces.
std::string joint_name(TextInput& in) {
  std::string name;
  while (in.peek() != "{") {
    const std::string_view word = in.word_on_line();
    if (word.empty()) break;
    if (!name.empty()) name += ' ';
    name += word;
  }
  return escaped_name(name);
}

void read_channels(TextInput& in, Hierarchy& out) {
  const std::size_t count = in.integer("the number of channels", 0, kMaxChannels);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = in.word();
    const int axis = word.empty() ? -1 : std::tolower(static_cast<unsigned char>(word[0])) - 'x';
    const std::string_view kind = word.empty() ? word : word.substr(1);
    if (axis < 0 || axis > 2 || (!is_word(kind, "position") && !is_word(kind, "rotation")))
      in.fail("a channel such as Xposition or Zrotation", word);
    out.channels.push_back({out.joints.size() - 1, axis, is_word(kind, "rotation")});
  }
}

/// Reads the skeletons, from the first ROOT to the last closing brace. It does not recurse, because deep
/// files could overflow the stack.
Hierarchy read_hierarchy(TextInput& in) {
  Hierarchy out;
  std::vector<std::size_t> open;  ///< joints whose closing brace is still to come
  const auto begin_joint = [&](bool end_site) {
    if (out.joints.size() == kMaxJoints) in.fail_with("at most 4096 joints", "more");
    if (open.size() == kMaxDepth) in.fail_with("at most 256 levels of joints", "more");
    SkeletonJoint joint;
    joint.parent = open.empty() ? -1 : static_cast<int>(open.back());
    joint.end_site = end_site;
    joint.offset.setZero();
    joint.name = joint_name(in);
    if (end_site) joint.name = out.joints[open.back()].name + "_end";
    if (joint.name.empty()) in.fail("a joint name", in.peek());
    out.joints.push_back(joint);
    in.expect("{");
    open.push_back(out.joints.size() - 1);
  };
  if (const std::string_view word = in.word(); !is_word(word, "HIERARCHY")) in.fail("'HIERARCHY'", word);
  if (const std::string_view word = in.word(); !is_word(word, "ROOT")) in.fail("'ROOT'", word);
  begin_joint(false);
  while (!open.empty() || is_word(in.peek(), "ROOT")) {
    const std::string_view word = in.word();
    if (open.empty()) {
      begin_joint(false);
      continue;
    }
    const bool end_site = out.joints[open.back()].end_site;
    if (is_word(word, "OFFSET")) {
      for (int axis = 0; axis < 3; ++axis)
        out.joints[open.back()].offset[axis] = bounded_number(in, "a number of OFFSET");
    } else if (is_word(word, "CHANNELS") && !end_site && open.back() + 1 == out.joints.size()) {
      read_channels(in, out);
    } else if (is_word(word, "JOINT") && !end_site) {
      begin_joint(false);
    } else if ((is_word(word, "End") || is_word(word, "EndSite")) && !end_site) {
      begin_joint(true);
    } else if (word == "}") {
      open.pop_back();
    } else {
      in.fail(end_site ? "OFFSET or '}'" : "OFFSET, CHANNELS, JOINT, End Site or '}'", word);
    }
  }
  if (out.channels.empty()) in.fail_with("joints with channels", "none");
  return out;
}

double read_fps(TextInput& in, const std::optional<double>& given, SkeletonMotion& motion) {
  in.label("Frame Time");
  const std::string text(in.word_on_line());
  double time = 0.0;
  const bool sound = parse_number(text, time) && time >= 1.0 / kMaxFps && time <= 10.0;
  if (!sound && given) {
    motion.decisions.push_back("frame time '" + printable(text) + "' gives no frame rate: --fps gives it");
    return *given;
  }
  if (text.empty()) in.fail_with("the frame time", "the end of the line (--fps gives a frame rate)");
  if (!sound) in.fail("a frame time between 0.0005 and 10 s (--fps gives a frame rate)", text);
  const double fps = rate_of_frame_time(text, time);
  if (fps != 1.0 / time)
    motion.decisions.push_back("frame time " + printable(text) + " s: " + rate_text(fps) +
                               " frames per second");
  return fps;
}

/// Adds the OFFSETs of the joints below the roots to their position channels, where these would else put most
/// of the joints that have them at their parents: displacements, not positions.
void add_offsets(const Hierarchy& hierarchy, SkeletonMotion& motion) {
  constexpr double kSmall = 0.1;  ///< of the OFFSET
  std::vector<std::array<bool, 3>> moved(hierarchy.joints.size(), {false, false, false});
  for (const Channel& c : hierarchy.channels)
    if (!c.rotation && hierarchy.joints[c.joint].parent >= 0)
      moved[c.joint][static_cast<std::size_t>(c.axis)] = true;
  int fallen = 0, others = 0;  // joints that would be at their parents, and that would not
  for (std::size_t j = 0; j < moved.size(); ++j) {
    if (moved[j] != std::array{true, true, true} || hierarchy.joints[j].offset.isZero()) continue;
    double mean = 0.0;
    for (const auto& frame : motion.translation)
      mean += frame[static_cast<int>(j)].norm() / static_cast<double>(motion.translation.size());
    ++(mean < kSmall * hierarchy.joints[j].offset.norm() ? fallen : others);
  }
  if (fallen <= others) return;
  for (auto& frame : motion.translation)
    for (std::size_t j = 0; j < moved.size(); ++j)
      for (int axis = 0; axis < 3; ++axis)
        if (moved[j][static_cast<std::size_t>(axis)])
          frame[static_cast<int>(j)][axis] += hierarchy.joints[j].offset[axis];
  motion.decisions.emplace_back("position channels: displacements, added to the OFFSET of " +
                                std::to_string(fallen) +
                                " joints, which they would else put at their parents");
}

void read_frame(TextInput& in, const Hierarchy& hierarchy, std::size_t frame, double angle_unit,
                SkeletonMotion& motion) {
  const std::size_t count = hierarchy.channels.size();
  auto& translation = motion.translation.emplace_back();
  for (const SkeletonJoint& joint : hierarchy.joints) translation.push_back(joint.offset);
  auto& rotation = motion.rotation.emplace_back(hierarchy.joints.size(), Quaterniond::Identity());
  for (std::size_t c = 0; c < count; ++c) {
    const std::string_view word = c == 0 ? in.word() : in.word_on_line();
    double value = 0.0;
    if (word.empty() || !parse_number(word, value) || std::abs(value) > kMaxChannelValue) {
      const std::string place = "number " + std::to_string(c + 1) + " of the " + std::to_string(count) +
                                " of frame " + std::to_string(frame);
      if (!word.empty()) in.fail(place, word);
      in.fail_with(place, in.peek().empty() ? "the end of the file" : "the end of the line");
    }
    const Channel& channel = hierarchy.channels[c];
    if (channel.rotation) {
      motion.largest_angle = std::max(motion.largest_angle, std::abs(value));
      rotation[channel.joint] =
          rotation[channel.joint] * rotation_about(Vector3d::Unit(channel.axis), angle_unit * value);
    } else {
      translation[channel.joint][channel.axis] = value;
    }
  }
  if (const std::string_view word = in.word_on_line(); !word.empty())
    in.fail_with(std::to_string(count) + " numbers in a frame", "more");
}

}  // namespace

SkeletonMotion parse_bvh(std::string_view text, const std::filesystem::path& path, const BvhConfig& config) {
  TextInput in(text, path.string(), "{}");
  in.skip_comments();
  const Hierarchy hierarchy = read_hierarchy(in);
  SkeletonMotion motion;
  motion.name = path.stem().string();
  motion.path = path.string();
  motion.joints = hierarchy.joints;
  if (const std::string_view word = in.word(); !is_word(word, "MOTION")) in.fail("'MOTION'", word);
  in.label("Frames");
  const std::size_t frames = in.integer("the number of frames", 1, kMaxJointFrames / hierarchy.joints.size());
  motion.fps = read_fps(in, config.fps, motion);
  // Check the declared size before allocating: every number takes at least two bytes.
  if (frames > (in.bytes_left() + 1) / (2 * hierarchy.channels.size()))
    in.fail_with(
        std::to_string(frames) + " frames of " + std::to_string(hierarchy.channels.size()) + " numbers",
        "only " + std::to_string(in.bytes_left()) + " bytes");
  motion.translation.reserve(frames);
  motion.rotation.reserve(frames);
  for (std::size_t t = 0; t < frames; ++t)
    read_frame(in, hierarchy, t, config.radians ? 1.0 : kDegree, motion);
  add_offsets(hierarchy, motion);
  if (std::none_of(hierarchy.channels.begin(), hierarchy.channels.end(),
                   [](const Channel& c) { return !c.rotation; }))
    motion.warnings.emplace_back("no joint has position channels: the body stays where it is");
  if (!in.peek().empty())
    motion.warnings.push_back("the file declares " + std::to_string(frames) +
                              " frames but has more: the rest is not read");
  return motion;
}

}  // namespace mimicx::import

#include "import/retarget/joint_names.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "character/body_words.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

enum Side { kMiddle, kLeft, kRight };

/// Words for a body, the most specific first: "foot" is the ankle if no joint is called ankle.
struct Part {
  int left, right;  ///< bodies; equal for the head and neck
  std::vector<std::string_view> words;
};

/// Rows are searched in this order, and a joint is used for one body only.
const std::vector<Part>& parts() {
  static const std::vector<Part> table = {
      {kLeftHip, kRightHip, {"upleg", "upperleg", "thigh", "femur", "hip"}},
      {kLeftKnee, kRightKnee, {"knee", "shin", "calf", "tibia", "lowerleg", "lowleg", "leg"}},
      {kLeftAnkle, kRightAnkle, {"ankle", "foot"}},
      {kLeftFoot, kRightFoot, {"toebase", "toe", "toes", "toe0", "ball", "foot"}},
      {kNeck, kNeck, {"neck", "lowerneck", "neck1", "neck01"}},
      {kHead, kHead, {"head"}},
      {kLeftShoulder, kRightShoulder, {"upperarm", "uparm", "arm", "shldr", "humerus", "shoulder"}},
      {kLeftElbow, kRightElbow, {"elbow", "forearm", "lowerarm", "lowarm", "radius"}},
      {kLeftWrist, kRightWrist, {"wrist", "hand"}},
  };
  return table;
}

/// Bodies that retargeting requires, each with the body that must be above it in the tree.
constexpr std::array<std::array<int, 2>, 12> kNeeded = {{{kLeftHip, kPelvis},
                                                         {kRightHip, kPelvis},
                                                         {kLeftKnee, kLeftHip},
                                                         {kRightKnee, kRightHip},
                                                         {kLeftAnkle, kLeftKnee},
                                                         {kRightAnkle, kRightKnee},
                                                         {kLeftShoulder, kSpine3},
                                                         {kRightShoulder, kSpine3},
                                                         {kLeftElbow, kLeftShoulder},
                                                         {kRightElbow, kRightShoulder},
                                                         {kLeftWrist, kLeftElbow},
                                                         {kRightWrist, kRightElbow}}};

/// Lower-case parts of a name without parts that are a side.
std::vector<std::string> split(const std::string& name, Side& side) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::string_view(" _-.:|").find(c) != std::string_view::npos)
      words.emplace_back();
    else
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  std::erase_if(words, [&](const std::string& word) {
    if (word == "l" || word == "left") side = kLeft;
    if (word == "r" || word == "right") side = kRight;
    return word.empty() || word == "l" || word == "left" || word == "r" || word == "right";
  });
  return words;
}

/// How well a joint's name matches a body; smaller is better.
struct Match {
  std::size_t word;     ///< place in the row of the table
  std::size_t dropped;  ///< parts left out in front
  auto operator<=>(const Match&) const = default;
};

/// Position of the word `text` in a row of the table; the word may have the wanted side as prefix or suffix.
std::optional<std::size_t> word_of(const Part& part, std::string_view text, Side side, Side wanted) {
  const auto place = [&](std::string_view core) -> std::optional<std::size_t> {
    const auto found = std::find(part.words.begin(), part.words.end(), core);
    if (found == part.words.end()) return std::nullopt;
    return static_cast<std::size_t>(found - part.words.begin());
  };
  if (side == wanted) return place(text);
  if (side != kMiddle || wanted == kMiddle) return std::nullopt;
  for (const std::string_view mark : wanted == kLeft ? std::array<std::string_view, 2>{"left", "l"}
                                                     : std::array<std::string_view, 2>{"right", "r"}) {
    if (text.starts_with(mark))
      if (const auto found = place(text.substr(mark.size()))) return found;
    if (mark.size() > 1 && text.ends_with(mark))
      if (const auto found = place(text.substr(0, text.size() - mark.size()))) return found;
  }
  return std::nullopt;
}

std::optional<Match> match(const Part& part, const std::string& name, Side wanted) {
  Side side = kMiddle;
  const std::vector<std::string> words = split(name, side);
  for (std::size_t dropped = 0; dropped < words.size(); ++dropped) {
    std::string joined;
    for (std::size_t i = dropped; i < words.size(); ++i) joined += words[i];
    if (const auto word = word_of(part, joined, side, wanted)) return Match{*word, dropped};
  }
  return std::nullopt;
}

void find_by_name(const SkeletonMotion& motion, JointMap& map) {
  const auto taken = [&](int joint) { return std::find(map.begin(), map.end(), joint) != map.end(); };
  for (const Part& part : parts())
    for (const Side side : part.left == part.right ? std::vector{kMiddle} : std::vector{kLeft, kRight}) {
      int& joint = map[side == kRight ? part.right : part.left];
      if (joint >= 0) continue;  // the user's word
      std::optional<Match> best;
      for (std::size_t j = 0; j < motion.joints.size(); ++j) {
        if (motion.joints[j].end_site || taken(static_cast<int>(j))) continue;
        const auto found = match(part, motion.joints[j].name, side);
        if (!found || (best && *best <= *found)) continue;
        best = found;
        joint = static_cast<int>(j);
      }
    }
}

/// From a joint up to the root, the joint itself first.
std::vector<int> path_to_root(const SkeletonMotion& motion, int joint) {
  std::vector<int> path;
  for (; joint >= 0; joint = motion.joints[joint].parent) path.push_back(joint);
  return path;
}

/// The lowest joint above both; -1 where one hangs on the other.
int meeting_point(const SkeletonMotion& motion, int a, int b) {
  const std::vector<int> of_a = path_to_root(motion, a), of_b = path_to_root(motion, b);
  for (const int joint : of_a)
    if (std::find(of_b.begin(), of_b.end(), joint) != of_b.end())
      return joint == a || joint == b ? -1 : joint;
  return -1;
}

/// An end site that hangs on `joint`, else -1.
int end_site_of(const SkeletonMotion& motion, int joint) {
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
    if (motion.joints[j].end_site && motion.joints[j].parent == joint) return static_cast<int>(j);
  return -1;
}

/// Where the neck joint is at the same position as the chest's, as in the CMU recordings, the neck is the
/// joint after it.
void raise_neck(const SkeletonMotion& motion, JointMap& map) {
  if (map[kNeck] < 0 || map[kHead] < 0 || map[kSpine3] < 0) return;
  const std::vector<int> path = path_to_root(motion, map[kHead]);
  const auto neck = std::find(path.begin(), path.end(), map[kNeck]);
  if (neck == path.end() || neck - path.begin() < 2) return;
  const SkeletonJoint& joint = motion.joints[map[kNeck]];
  if (joint.parent == map[kSpine3] && joint.offset.isZero()) map[kNeck] = *(neck - 1);
}

/// Pelvis, chest and collars from the tree; wrists and feet from end sites.
void find_by_shape(const SkeletonMotion& motion, JointMap& map) {
  const auto both = [&](int left, int right) { return map[left] >= 0 && map[right] >= 0; };
  if (map[kPelvis] < 0 && both(kLeftHip, kRightHip))
    map[kPelvis] = meeting_point(motion, map[kLeftHip], map[kRightHip]);
  if (map[kSpine3] < 0 && both(kLeftShoulder, kRightShoulder))
    map[kSpine3] = meeting_point(motion, map[kLeftShoulder], map[kRightShoulder]);
  for (const auto& [collar, shoulder] :
       {std::array{kLeftCollar, kLeftShoulder}, {kRightCollar, kRightShoulder}}) {
    const int joint = map[shoulder];
    if (map[collar] >= 0 || joint < 0 || map[kSpine3] < 0) continue;
    const std::vector<int> path = path_to_root(motion, joint);
    const auto chest = std::find(path.begin(), path.end(), map[kSpine3]);
    if (chest != path.end() && chest - path.begin() >= 2) map[collar] = *(chest - 1);
  }
  for (const auto& [end, parent] : {std::array{kLeftWrist, kLeftElbow},
                                    {kRightWrist, kRightElbow},
                                    {kLeftFoot, kLeftAnkle},
                                    {kRightFoot, kRightAnkle}})
    if (map[end] < 0 && map[parent] >= 0) map[end] = end_site_of(motion, map[parent]);
}

void check(const SkeletonMotion& motion, const JointMap& map) {
  const auto joint_name = [&](int joint) { return "'" + motion.joints[joint].name + "'"; };
  std::string missing;
  for (const auto& [body, above] : kNeeded)
    if (map[body] < 0) missing += (missing.empty() ? "" : ", ") + body_in_words(body);
  if (!missing.empty())
    throw DataError(
        motion.path, "skeleton",
        "a joint for each of hips, knees, ankles, shoulders, elbows and wrists (a joint map can name them)",
        "none for " + missing);
  for (const auto& [body, above] : kNeeded) {
    const int joint = map[body], parent = map[above];
    const std::vector<int> path = path_to_root(motion, joint);
    if (parent < 0 || joint == parent || std::find(path.begin(), path.end(), parent) == path.end())
      throw DataError(
          motion.path, "skeleton",
          joint_name(joint) + ", taken for " + body_in_words(body) + ", below " + body_in_words(above),
          parent < 0 ? "no such joint" : joint_name(parent) + " elsewhere");
  }
}

/// The first joint of the skeleton that the user names for a body.
void apply_user_map(const NamedJoints& names, const SkeletonMotion& motion, JointMap& map) {
  for (const auto& [body, joint] : names)
    for (std::size_t j = 0; j < motion.joints.size() && map[body] < 0; ++j)
      if (motion.joints[j].name == joint) map[body] = static_cast<int>(j);
}

}  // namespace

NamedJoints parse_joint_map(const std::string& text, const std::filesystem::path& path) {
  NamedJoints names;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    line = line.substr(0, line.find('#'));
    const auto trimmed = [](std::string s) {
      const char* blanks = " \t\r";
      s.erase(0, std::min(s.find_first_not_of(blanks), s.size()));
      return s.substr(0, s.find_last_not_of(blanks) + 1);
    };
    if (trimmed(line).empty()) continue;
    const std::string place = "line " + std::to_string(number + 1);
    if (line.find('=') == std::string::npos)
      throw DataError(path.string(), place, "body = joint name", "'" + printable(trimmed(line)) + "'");
    const std::string body = trimmed(line.substr(0, line.find('='))),
                      joint = trimmed(line.substr(line.find('=') + 1));
    const int found = body_of_name(body);
    if (found < 0)
      throw DataError(path.string(), place, "one of the 22 body names, e.g. left_knee",
                      "'" + printable(body) + "'");
    names.emplace_back(found, printable(joint));
  }
  return names;
}

JointMap map_joints(const SkeletonMotion& motion, const std::filesystem::path& user_map) {
  JointMap map;
  map.fill(-1);
  if (!user_map.empty()) apply_user_map(parse_joint_map(read_text(user_map), user_map), motion, map);
  find_by_name(motion, map);
  find_by_shape(motion, map);
  raise_neck(motion, map);
  check(motion, map);
  return map;
}

}  // namespace mimicx::import

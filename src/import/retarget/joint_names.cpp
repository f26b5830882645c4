#include "import/retarget/joint_names.h"

#include <iconv.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "character/body_words.h"
#include "import/retarget/skeleton_shape.h"
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
      {kLeftHip, kRightHip, {"upleg", "upperleg", "thigh", "thighbend", "femur", "hip"}},
      {kLeftKnee, kRightKnee, {"knee", "shin", "calf", "tibia", "lowerleg", "lowleg", "loleg", "leg"}},
      {kLeftAnkle, kRightAnkle, {"ankle", "foot"}},
      {kLeftFoot, kRightFoot, {"toebase", "toe", "toes", "toe0", "ball", "foot"}},
      {kNeck, kNeck, {"neck", "lowerneck", "neck1", "neck01"}},
      {kHead, kHead, {"head"}},
      {kLeftShoulder,
       kRightShoulder,
       {"upperarm", "uparm", "uarm", "arm", "shldr", "shldrbend", "humerus", "shoulder"}},
      {kLeftElbow,
       kRightElbow,
       {"elbow", "forearm", "forearmbend", "lowerarm", "lowarm", "loarm", "farm", "radius"}},
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
  bool astray;          ///< not below the joint of the body that is above
  std::size_t word;     ///< place in the row of the table
  std::size_t dropped;  ///< parts and digits left out
  int fewer;            ///< minus the number of joints below: helpers have none
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
    if (text.ends_with(mark))
      if (const auto found = place(text.substr(0, text.size() - mark.size()))) return found;
  }
  return std::nullopt;
}

/// Whether a part of a name behind the word says nothing: a number, or what a rig calls its joints.
bool is_idle(const std::string& part) {
  constexpr std::array<std::string_view, 10> kIdle = {"jnt", "joint", "bone", "bind", "def",
                                                      "bn",  "jt",    "skin", "sk",   "bend"};
  return part.find_first_not_of("0123456789") == std::string::npos ||
         std::find(kIdle.begin(), kIdle.end(), part) != kIdle.end();
}

/// @return place of the word, and how many parts and digits were left out; none without a match
std::optional<std::pair<std::size_t, std::size_t>> match(const Part& part, const std::string& name,
                                                         Side wanted) {
  Side side = kMiddle;
  std::vector<std::string> words = split(name, side);
  for (std::size_t behind = 0;; ++behind) {
    for (std::size_t dropped = 0; dropped < words.size(); ++dropped) {
      std::string joined;
      for (std::size_t i = dropped; i < words.size(); ++i) joined += words[i];
      if (const auto word = word_of(part, joined, side, wanted)) return std::pair(*word, dropped + behind);
    }
    if (words.empty()) return std::nullopt;
    std::string& last = words.back();
    if (is_idle(last))
      words.pop_back();
    else if (std::isdigit(static_cast<unsigned char>(last.back())))
      last.erase(last.find_last_not_of("0123456789") + 1);
    else
      return std::nullopt;
  }
}

bool is_below(const SkeletonMotion& motion, int joint, int above) {
  for (; joint >= 0; joint = motion.joints[joint].parent)
    if (joint == above) return true;
  return false;
}

/// The body of a limb that is above another one; -1 for the first of a limb, and for neck and head.
int above_in_limb(int body) {
  const auto found =
      std::find_if(kNeeded.begin(), kNeeded.end(), [&](const auto& row) { return row[0] == body; });
  return found == kNeeded.end() || (*found)[1] == kPelvis || (*found)[1] == kSpine3 ? -1 : (*found)[1];
}

void find_by_name(const SkeletonMotion& motion, JointMap& map) {
  const auto taken = [&](int joint) { return std::find(map.begin(), map.end(), joint) != map.end(); };
  std::vector<int> below(motion.joints.size(), 0);  // number of joints below each
  for (std::size_t j = motion.joints.size(); j-- > 0;)
    if (const int parent = motion.joints[j].parent; parent >= 0)
      below[static_cast<std::size_t>(parent)] += below[j] + 1;
  for (const Part& part : parts())
    for (const Side side : part.left == part.right ? std::vector{kMiddle} : std::vector{kLeft, kRight}) {
      int& joint = map[side == kRight ? part.right : part.left];
      if (joint >= 0) continue;  // the user's word
      std::optional<Match> best;
      for (std::size_t j = 0; j < motion.joints.size(); ++j) {
        if (motion.joints[j].end_site || taken(static_cast<int>(j))) continue;
        const auto word = match(part, motion.joints[j].name, side);
        if (!word) continue;
        const int above = above_in_limb(side == kRight ? part.right : part.left);
        const bool astray =
            above >= 0 && map[above] >= 0 && !is_below(motion, static_cast<int>(j), map[above]);
        const Match found{astray, word->first, word->second, -below[j]};
        if (best && *best <= found) continue;
        best = found;
        joint = static_cast<int>(j);
      }
    }
}

/// Helpers of both sides at one place are no hips or shoulders: the joint below each is.
void step_over_helpers(const SkeletonMotion& motion, const JointMap& given, JointMap& map) {
  if (motion.frames() == 0) return;
  const SkeletonPose pose = pose_of(motion, 0);
  const auto only_child = [&](int joint) {
    int child = -1;
    for (std::size_t j = 0; j < motion.joints.size(); ++j)
      if (motion.joints[j].parent == joint) child = child == -1 ? static_cast<int>(j) : -2;
    return child;
  };
  for (const auto& [left, right] : {std::array{kLeftHip, kRightHip}, {kLeftShoulder, kRightShoulder}})
    while (map[left] >= 0 && map[right] >= 0 && given[left] < 0 && given[right] < 0 &&
           (pose.p[map[left]] - pose.p[map[right]]).norm() < 1e-6 * pose.p[map[left]].norm() + 1e-9) {
      const int l = only_child(map[left]), r = only_child(map[right]);
      if (l < 0 || r < 0) return;
      map[left] = l;
      map[right] = r;
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
  const auto joint_name = [&](int joint) { return "'" + printable(motion.joints[joint].name) + "'"; };
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

/// A UTF-8 name in another encoding, as a joint of a file in this encoding is called here; empty: the name
/// cannot be written in it.
std::string encoded_name(std::string name, const char* encoding) {
  const iconv_t converter = iconv_open(encoding, "UTF-8");
  if (converter == reinterpret_cast<iconv_t>(-1)) return {};
  std::string out(2 * name.size(), '\0');
  char *from = name.data(), *to = out.data();
  std::size_t bytes = name.size(), room = out.size();
  const bool exact = iconv(converter, &from, &bytes, &to, &room) == 0;
  iconv_close(converter);
  out.resize(out.size() - room);
  return exact ? escaped_name(out) : "";
}

/// The ways in which a file may spell a name.
std::vector<std::string> spellings(const std::string& name) {
  std::vector<std::string> out = {name};
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c >= 0x80; }))
    for (const char* encoding : {"CP932", "GBK"})  // CP932: Shift-JIS
      if (const std::string other = encoded_name(name, encoding); !other.empty()) out.push_back(other);
  return out;
}

/// The first joint of the skeleton that the user names for a body.
/// @return a line that tells the bodies of whose names the skeleton has none; empty: it has one of each
std::string apply_user_map(const NamedJoints& names, const SkeletonMotion& motion, JointMap& map) {
  PerBody<std::string> asked;
  for (const auto& [body, joint] : names) {
    asked[body] += (asked[body].empty() ? "'" : ", '") + printable(joint) + "'";
    for (const std::string& spelling : spellings(joint))
      for (std::size_t j = 0; j < motion.joints.size() && map[body] < 0; ++j)
        if (motion.joints[j].name == spelling) map[body] = static_cast<int>(j);
  }
  std::string missing;
  for (int b = 0; b < kBodies; ++b)
    if (map[b] < 0 && !asked[b].empty())
      missing += (missing.empty() ? "" : "; ") + body_in_words(b) + " " + asked[b];
  return missing.empty() ? missing : "the skeleton has no joint of --joint-map's names: " + missing;
}

}  // namespace

NamedJoints parse_joint_map(const std::string& text, const std::filesystem::path& path) {
  NamedJoints names;
  std::size_t number = 0;
  const std::size_t first = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // behind a byte order mark
  for (std::size_t begin = first; begin < text.size(); ++number) {
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
    names.emplace_back(found, escaped_name(joint));
  }
  return names;
}

JointMap map_joints(const SkeletonMotion& motion, const std::filesystem::path& user_map,
                    std::vector<std::string>* told) {
  JointMap given;
  given.fill(-1);
  if (!user_map.empty()) {
    const std::string missing = apply_user_map(parse_joint_map(read_text(user_map), user_map), motion, given);
    if (told != nullptr && !missing.empty()) told->push_back(missing);
  }
  JointMap map = given;
  find_by_name(motion, map);
  step_over_helpers(motion, given, map);
  find_by_shape(motion, map);
  raise_neck(motion, map);
  try {
    check(motion, map);
    return map;
  } catch (const DataError&) {
    const auto shape = map_by_shape(motion);
    if (!shape) throw;
    std::string said;
    for (int b = 0; b < kBodies; ++b) {
      map[b] = given[b] >= 0 ? given[b] : (*shape)[b];
      if (given[b] < 0 && map[b] >= 0)
        said += (said.empty() ? "" : ", ") + body_in_words(b) + " '" + printable(motion.joints[map[b]].name) +
                "'";
    }
    find_by_shape(motion, map);
    try {
      check(motion, map);
    } catch (const DataError&) {
      map.fill(-2);
    }
    if (map[0] == -2) throw;
    if (told != nullptr) told->push_back("joints are matched by the skeleton's shape, not by name: " + said);
  }
  return map;
}

}  // namespace mimicx::import

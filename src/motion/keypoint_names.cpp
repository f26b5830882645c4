#include "motion/keypoint_names.h"

#include <algorithm>
#include <map>
#include <utility>

namespace mimicx::motion {
namespace {

constexpr int kFacePoints = 68, kFingerJoints = 4;
constexpr double kHeelHeight = 0.025, kToeHeight = 0.012;  ///< m: detectors mark the skin, not the sole

void add_hand(const std::string& side, std::vector<std::string>& names) {
  names.push_back(side + "_hand_root");
  for (const char* finger : {"thumb", "forefinger", "middle_finger", "ring_finger", "pinky_finger"})
    for (int joint = 1; joint <= kFingerJoints; ++joint)
      names.push_back(side + "_" + finger + std::to_string(joint));
}

std::vector<std::string> whole_body_names() {
  std::vector<std::string> names = keypoint_names(KeypointSet::kCoco17);
  for (const char* side : {"left", "right"})
    for (const char* point : {"_big_toe", "_small_toe", "_heel"}) names.push_back(std::string(side) + point);
  for (int i = 0; i < kFacePoints; ++i) names.push_back("face-" + std::to_string(i));
  for (const char* side : {"left", "right"}) add_hand(side, names);
  return names;
}

}  // namespace

std::vector<std::string> keypoint_names(KeypointSet set) {
  if (set == KeypointSet::kJoints22) return {kBodyNames.begin(), kBodyNames.end()};
  if (set == KeypointSet::kCoco133) return whole_body_names();
  return {"nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
          "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
          "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};
}

std::optional<KeypointSet> keypoint_set_of(std::size_t points) {
  for (const KeypointSet set : {KeypointSet::kJoints22, KeypointSet::kCoco17, KeypointSet::kCoco133})
    if (keypoint_names(set).size() == points) return set;
  return {};
}

std::string mirrored_name(const std::string& name) {
  if (name.starts_with("left_")) return "right_" + name.substr(5);
  if (name.starts_with("right_")) return "left_" + name.substr(6);
  return name;
}

std::string known_keypoint_name(const std::string& name) {
  const auto upper = [&](std::size_t i) { return i < name.size() && name[i] >= 'A' && name[i] <= 'Z'; };
  const auto lower = [&](std::size_t i) { return i < name.size() && name[i] >= 'a' && name[i] <= 'z'; };
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool blank = name[i] == ' ' || name[i] == '-';
    const bool word = i > 0 && upper(i) && (lower(i - 1) || (upper(i - 1) && lower(i + 1)));
    if (word) plain += '_';
    plain += blank ? '_' : upper(i) ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  for (const auto& [letter, side] : {std::pair("l_", "left_"), {"r_", "right_"}})
    if (plain.starts_with(letter)) plain = side + plain.substr(2);
  if (plain == "mid_hip") plain = kBodyNames[kPelvis];
  static const std::vector<std::string> coco = keypoint_names(KeypointSet::kCoco17);
  const bool known = place_of_keypoint(plain) || std::find(coco.begin(), coco.end(), plain) != coco.end();
  return known ? plain : name;
}

std::optional<KeypointPlace> place_of_keypoint(const std::string& name) {
  constexpr int kRight = kPointsPerFoot;  // heel, ball and toe of a foot: inner, outer
  static const std::map<std::string, KeypointPlace> kFeet = {
      {"left_heel", {kLeftAnkle, 0, 1, kHeelHeight}},
      {"left_big_toe", {kLeftFoot, 4, 4, kToeHeight}},
      {"left_small_toe", {kLeftFoot, 5, 5, kToeHeight}},
      {"right_heel", {kRightAnkle, kRight, kRight + 1, kHeelHeight}},
      {"right_big_toe", {kRightFoot, kRight + 4, kRight + 4, kToeHeight}},
      {"right_small_toe", {kRightFoot, kRight + 5, kRight + 5, kToeHeight}}};
  if (const int body = body_of_name(name); body >= 0) return KeypointPlace{body};
  const auto found = kFeet.find(name);
  return found == kFeet.end() ? std::nullopt : std::optional(found->second);
}

Vector3d place_on(const Character& character, const KeypointPlace& place) {
  Vector3d p_B = place.above * Vector3d::UnitY();
  for (int i = place.first; i <= place.last; ++i)
    p_B += sole_point(character.contact_points[i]) / (place.last - place.first + 1);
  return p_B;
}

}  // namespace mimicx::motion

#include "motion/keypoint_members.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "motion/keypoint_check.h"
#include "motion/keypoint_names.h"
#include "motion/npz_member.h"

namespace mimicx::motion {
namespace {

using Shape = std::vector<std::size_t>;

/// The file's names, or without any the names of the set with this number of keypoints. Unreadable names
/// (pickled ones, numbers) are an error.
std::vector<std::string> read_keypoint_names(const Npz& npz, const Member& points, Clip& clip) {
  const auto& unread = npz.unsupported();
  const bool unreadable = std::any_of(unread.begin(), unread.end(),
                                      [](const auto& member) { return member.first == "keypoint_names"; });
  if (npz.has("keypoint_names") || unreadable) {
    const NpyArray& member = npz.at("keypoint_names");
    if (member.type != NpyArray::Type::kText) throw DataError(npz.path, "keypoint_names", "text", "numbers");
    std::vector<std::string> names = member.text;
    for (std::string& name : names) name = known_keypoint_name(name);
    return names;
  }
  if (points.array.shape.size() != 3) points.fail("shape (frames, keypoints, 3)", points.shape());
  const std::size_t count = points.array.shape[1];
  const std::optional<KeypointSet> set = keypoint_set_of(count);
  if (!set)
    throw DataError(
        npz.path, "keypoint_names",
        "the keypoints' names (optional for 22: the body's joints; 17: COCO; 133: COCO-WholeBody)",
        "none for " + std::to_string(count) + " keypoints");
  const char* taken_for = *set == KeypointSet::kJoints22 ? "the 22 joints"
                          : *set == KeypointSet::kCoco17 ? "those of COCO"
                                                         : "those of COCO-WholeBody";
  clip.decisions.push_back("keypoints: " + std::to_string(count) + " without names, taken for " + taken_for +
                           " in their order");
  return keypoint_names(*set);
}

/// Adds a decision where most keypoints are not used: they belong to face and fingers, or have other names.
void say_what_is_left_aside(const std::vector<std::string>& names, Clip& clip) {
  constexpr int kTold = 3;
  const auto used = std::count_if(names.begin(), names.end(), [](const std::string& name) {
    return place_of_keypoint(name).has_value();
  });
  if (2 * used >= std::ssize(names)) return;
  const std::vector<std::string> detector = keypoint_names(KeypointSet::kCoco133);
  std::string unknown;
  int others = 0;
  for (const std::string& name : names)
    if (!place_of_keypoint(name) && std::find(detector.begin(), detector.end(), name) == detector.end() &&
        ++others <= kTold)
      unknown += (unknown.empty() ? "" : ", ") + name;
  clip.decisions.push_back("keypoints: " + std::to_string(used) + " of " + std::to_string(names.size()) +
                           " have a place on the body; the others (" +
                           (others == 0 ? "face, fingers" : unknown + (others > kTold ? ", …" : "")) +
                           ") are not used");
}

/// (frames, keypoints, 3), or without confidences (frames, keypoints, 2), where a point is not seen that is
/// not finite or at (0, 0).
PerFrame<std::vector<Vector3d>> read_points(const Member& points, std::size_t frames, std::size_t count,
                                            Clip& clip) {
  const bool confident = points.array.shape.back() != 2;
  const std::size_t numbers = confident ? 3 : 2;
  points.expect_shape(confident ? Shape{frames, count, 3} : Shape{frames, count, 2});
  PerFrame<std::vector<Vector3d>> uvc;
  uvc.assign(frames, std::vector<Vector3d>(count, Vector3d::Zero()));
  for (std::size_t i = 0; i < frames * count; ++i) {
    const double* v = points.values.data() + numbers * i;
    const Vector3d point(v[0], v[1], confident ? v[2] : (v[0] != 0.0 || v[1] != 0.0 ? 1.0 : 0.0));
    if (point.allFinite()) uvc[i / count][i % count] = point;
  }
  if (!confident)
    clip.decisions.emplace_back(
        "keypoints: without confidences; all are trusted alike but those at (0, 0) and those that are not "
        "finite");
  return uvc;
}

/// (3, 3), the same for every frame, or the four numbers fx, fy, cx, cy.
Matrix3d read_intrinsics(const Member& member, std::size_t frames) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const std::vector<double>& v = member.values;
  member.expect_finite();
  if (member.array.shape == Shape{4}) {
    Matrix3d intrinsics = Matrix3d::Identity();
    intrinsics(0, 0) = v[0], intrinsics(1, 1) = v[1], intrinsics(0, 2) = v[2], intrinsics(1, 2) = v[3];
    return intrinsics;
  }
  if (member.array.shape != Shape{frames, 3, 3} && member.array.shape != Shape{1, 3, 3})
    member.expect_shape({3, 3});
  for (std::size_t i = 9; i < v.size(); ++i)
    if (v[i] != v[i % 9])
      member.fail("the same camera in all frames", "another one in frame " + std::to_string(i / 9));
  return RowMajor(v.data());
}

/// (4, 4) or (3, 4), or one of these per frame.
PerFrame<Eigen::Matrix4d> read_extrinsics(const Member& member, std::size_t frames) {
  const Shape& shape = member.array.shape;
  const bool moving = shape.size() == 3;
  const std::size_t rows = shape.size() >= 2 && shape[shape.size() - 2] == 3 ? 3 : 4;
  member.expect_shape(moving ? Shape{frames, rows, 4} : Shape{rows, 4});
  member.expect_finite();
  PerFrame<Eigen::Matrix4d> extrinsics;
  extrinsics.assign(moving ? frames : 1, Eigen::Matrix4d::Identity());
  for (std::size_t i = 0; i < member.values.size(); ++i)
    extrinsics[i / (4 * rows)](static_cast<int>(i / 4 % rows), static_cast<int>(i % 4)) = member.values[i];
  return extrinsics;
}

/// Whether an array has the shape of extrinsics, for any number of frames.
bool has_shape_of_extrinsics(const NpyArray& array) {
  const Shape& shape = array.shape;
  if (array.type == NpyArray::Type::kText || (shape.size() != 2 && shape.size() != 3)) return false;
  const std::size_t rows = shape[shape.size() - 2];
  return (rows == 3 || rows == 4) && shape.back() == 4;
}

/// The matrices of a member that has that shape, world → camera; none where one has another last row.
std::optional<PerFrame<Eigen::Matrix4d>> cameras_of(const NpyArray& array) {
  if (!has_shape_of_extrinsics(array)) return std::nullopt;
  const std::vector<double> values = array.to_double();
  const std::size_t numbers = 4 * array.shape[array.shape.size() - 2];
  PerFrame<Eigen::Matrix4d> cameras;
  cameras.assign(values.size() / numbers, Eigen::Matrix4d::Identity());
  for (std::size_t i = 0; i < values.size(); ++i)
    cameras[i / numbers](static_cast<int>(i % numbers / 4), static_cast<int>(i % 4)) = values[i];
  constexpr double kSame = 0.01;
  for (const Eigen::Matrix4d& camera : cameras)
    if (!(camera.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(kSame)) return std::nullopt;
  return cameras;
}

/// The member of these cameras, in the shape that it had.
NpyArray member_of(const PerFrame<Eigen::Matrix4d>& cameras, const Shape& shape) {
  std::vector<double> values;
  const int numbers = 4 * static_cast<int>(shape[shape.size() - 2]);
  for (const Eigen::Matrix4d& camera : cameras)
    for (int i = 0; i < numbers; ++i) values.push_back(camera(i / 4, i % 4));
  return NpyArray::from_double(shape, values.data());
}

void leave_out_camera(Clip& clip) {
  std::erase_if(clip.passthrough, [](const auto& member) {
    return member.first == "camera_intrinsics" || member.first == "camera_extrinsics";
  });
  clip.warnings.emplace_back(
      "camera_extrinsics are no matrices world to camera, (4, 4) or (frames, 4, 4): the camera is left out, "
      "because the world changes");
}

}  // namespace

const std::vector<std::string> kKeypointMembers = {"keypoints_2d", "keypoint_names", "camera_intrinsics",
                                                   "camera_extrinsics"};

bool read_keypoints(const Npz& npz, Clip& clip) {
  if (!npz.has("keypoints_2d")) return false;
  if (!npz.has("camera_intrinsics") || !npz.has("camera_extrinsics")) {
    clip.warnings.push_back("keypoints_2d without camera_intrinsics and camera_extrinsics are not used");
    return false;
  }
  const std::size_t frames = clip.rotations.size();
  const Member points(npz, "keypoints_2d");
  Keypoints out;
  out.names = read_keypoint_names(npz, points, clip);
  say_what_is_left_aside(out.names, clip);
  out.uvc = read_points(points, frames, out.names.size(), clip);
  out.intrinsics = read_intrinsics(Member(npz, "camera_intrinsics"), frames);
  out.extrinsics = read_extrinsics(Member(npz, "camera_extrinsics"), frames);
  check_keypoints(npz.path, out, clip.decisions);
  clip.keypoints = std::move(out);
  return true;
}

void add_keypoints(Npz& npz, const Keypoints& k) {
  const std::size_t frames = k.uvc.size(), count = k.names.size();
  std::vector<double> values;
  for (const auto& frame : k.uvc)
    for (const Vector3d& uvc : frame) values.insert(values.end(), uvc.data(), uvc.data() + 3);
  npz.set("keypoints_2d", NpyArray::from_double({frames, count, 3}, values.data()));
  npz.set("keypoint_names", NpyArray::from_text(k.names));
  npz.set("camera_intrinsics", from_matrix(k.intrinsics));
  values.clear();
  for (const Eigen::Matrix4d& e : k.extrinsics)
    for (int i = 0; i < 16; ++i) values.push_back(e(i / 4, i % 4));
  const std::size_t poses = k.extrinsics.size();
  npz.set("camera_extrinsics", NpyArray::from_double(poses == 1 ? std::vector<std::size_t>{4, 4}
                                                                : std::vector<std::size_t>{poses, 4, 4},
                                                     values.data()));
}

void change_cameras(const std::function<void(Eigen::Matrix4d&)>& change, Clip& clip) {
  if (clip.keypoints)
    for (Eigen::Matrix4d& camera : clip.keypoints->extrinsics) change(camera);
  const auto member = std::find_if(clip.passthrough.begin(), clip.passthrough.end(),
                                   [](const auto& m) { return m.first == "camera_extrinsics"; });
  if (member == clip.passthrough.end()) return;
  std::optional<PerFrame<Eigen::Matrix4d>> cameras = cameras_of(member->second);
  if (!cameras) return leave_out_camera(clip);
  for (Eigen::Matrix4d& camera : *cameras) change(camera);
  member->second = member_of(*cameras, member->second.shape);
}

}  // namespace mimicx::motion

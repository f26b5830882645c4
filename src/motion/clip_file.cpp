#include "motion/clip_file.h"

#include <algorithm>
#include <cmath>

#include "core/number_text.h"
#include "motion/keypoint_check.h"
#include "motion/keypoint_names.h"

namespace mimicx::motion {
namespace {

constexpr int kPoseColumns = 3 * kBodies;  ///< root and 21 joints
constexpr double kMaxFps = 2000.0;

/// A member as doubles, with its place for error messages.
struct Member {
  const Npz& npz;
  std::string key;
  const NpyArray& array;
  std::vector<double> values;

  Member(const Npz& archive, const std::string& name) : npz(archive), key(name), array(archive.at(name)) {
    if (array.type == NpyArray::Type::kText) fail("numbers", "text");
    values = array.to_double();
  }
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    throw DataError(npz.path, key, expected, found);
  }
  std::string shape() const {
    std::string text = "shape (";
    for (std::size_t i = 0; i < array.shape.size(); ++i)
      text += (i ? ", " : "") + std::to_string(array.shape[i]);
    return text + ")";
  }
  void expect_shape(const std::vector<std::size_t>& expected) const {
    if (array.shape == expected) return;
    std::string text = "shape (";
    for (std::size_t i = 0; i < expected.size(); ++i) text += (i ? ", " : "") + std::to_string(expected[i]);
    fail(text + ")", shape());
  }
  /// Rows of a matrix of `columns` columns, all finite.
  std::size_t expect_rows(std::size_t columns) const {
    if (array.shape.size() != 2 || array.shape[1] != columns)
      fail("shape (frames, " + std::to_string(columns) + ")", shape());
    expect_finite();
    return array.shape[0];
  }
  void expect_finite() const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) {
        const std::size_t rows = array.shape.empty() ? 1 : array.shape[0];
        fail("finite numbers", "one that is not, in row " + std::to_string(i / (values.size() / rows)));
      }
  }
};

std::string member_text(const Npz& npz, const std::string& key) {
  const NpyArray& array = npz.at(key);
  if (array.text.size() != 1) throw DataError(npz.path, key, "one word", "something else");
  return array.text[0];
}

double read_fps(const Npz& npz) {
  for (const char* key : {"mocap_framerate", "mocap_frame_rate"}) {
    if (!npz.has(key)) continue;
    const Member fps(npz, key);
    if (fps.values.size() != 1 || !(fps.values[0] > 0.0 && fps.values[0] <= kMaxFps))
      fps.fail("one frame rate between 0 and 2000 Hz",
               fps.values.size() == 1 ? text_of(fps.values[0]) : fps.shape());
    return fps.values[0];
  }
  throw DataError(npz.path, "", "a frame rate (mocap_framerate or mocap_frame_rate)", "neither");
}

/// Columns from `first` on, elements untouched.
NpyArray columns_from(const NpyArray& array, std::size_t first) {
  const std::size_t rows = array.shape[0], columns = array.shape[1];
  const std::size_t width = rows * columns == 0 ? 0 : array.bytes.size() / (rows * columns);
  NpyArray out;
  out.type = array.type;
  out.shape = {rows, columns - first};
  for (std::size_t r = 0; r < rows; ++r) {
    const auto row = array.bytes.begin() + static_cast<std::ptrdiff_t>(r * columns * width);
    out.bytes.insert(out.bytes.end(), row + static_cast<std::ptrdiff_t>(first * width),
                     row + static_cast<std::ptrdiff_t>(columns * width));
  }
  return out;
}

/// Keeps columns of `poses` for hands, jaw and eyes. They are written to the same columns again, even if the
/// file also has them as named arrays. Their order does not matter here.
void keep_other_columns(const Npz& npz, std::size_t frames, Clip& clip) {
  if (!npz.has("poses")) return;
  const NpyArray& poses = npz.at("poses");
  if (poses.type == NpyArray::Type::kText || poses.shape.size() != 2 || poses.shape[0] != frames) return;
  if (poses.shape[1] > kPoseColumns)
    clip.passthrough.emplace_back("poses_rest", columns_from(poses, kPoseColumns));
}

/// Fills the rotations; returns the body model of the layout.
std::string read_rotations(const Npz& npz, Clip& clip) {
  const auto vector_at = [](const std::vector<double>& v, std::size_t at) {
    return Vector3d(v[at], v[at + 1], v[at + 2]);
  };
  if (npz.has("root_orient") && npz.has("pose_body")) {
    const Member root(npz, "root_orient"), body(npz, "pose_body");
    const std::size_t frames = root.expect_rows(3);
    if (body.expect_rows(3 * kJoints) != frames)
      body.fail(std::to_string(frames) + " frames as in root_orient", body.shape());
    clip.rotations.resize(frames);
    for (std::size_t t = 0; t < frames; ++t) {
      clip.rotations[t][0] = vector_at(root.values, 3 * t);
      for (std::size_t j = 0; j < kJoints; ++j)
        clip.rotations[t][j + 1] = vector_at(body.values, 3 * (kJoints * t + j));
    }
    keep_other_columns(npz, frames, clip);
    return "smplx";
  }
  const Member poses(npz, "poses");
  if (poses.array.shape.size() != 2) poses.fail("shape (frames, 66, 72, 156 or 165)", poses.shape());
  const std::size_t columns = poses.array.shape[1];
  if (columns != 66 && columns != 72 && columns != 156 && columns != 165)
    poses.fail("66, 72, 156 or 165 columns", std::to_string(columns));
  clip.rotations.resize(poses.expect_rows(columns));
  for (std::size_t t = 0; t < clip.rotations.size(); ++t)
    for (std::size_t j = 0; j < kBodies; ++j)
      clip.rotations[t][j] = vector_at(poses.values, columns * t + 3 * j);
  keep_other_columns(npz, clip.rotations.size(), clip);
  return columns == 72 ? "smpl" : columns == 156 ? "smplh" : "smplx";
}

/// Variants such as "smplx_locked_head" count as their base model.
std::string read_body_model(const Npz& npz, const std::string& from_layout) {
  for (const char* key : {"body_model", "surface_model_type"}) {
    if (!npz.has(key)) continue;
    const std::string name = member_text(npz, key);
    for (const char* known : {"mimicx", "smplx", "smplh", "smpl"})
      if (name == known || name.starts_with(std::string(known) + "_")) return known;
    throw DataError(npz.path, key, "mimicx, smplx, smplh or smpl", "'" + name + "'");
  }
  return from_layout;
}

void read_betas(const Npz& npz, Clip& clip) {
  if (!npz.has("betas")) return;
  const Member betas(npz, "betas");
  betas.expect_finite();
  const auto& shape = betas.array.shape;
  const bool per_frame = shape.size() == 2 && shape[0] == clip.rotations.size() && shape[0] > 1;
  if (shape.size() != 1 && !(shape.size() == 2 && (shape[0] == 1 || per_frame)))
    betas.fail("one row of shape parameters", betas.shape());
  const std::size_t count = std::min<std::size_t>(shape.back(), kBetas);
  std::copy_n(betas.values.begin(), count, clip.betas.begin());
  if (shape.back() > kBetas)
    clip.passthrough.emplace_back(
        "betas_rest", NpyArray::from_double({shape.back() - kBetas}, betas.values.data() + kBetas));
  const bool any = std::any_of(clip.betas.begin(), clip.betas.end(), [](double b) { return b != 0.0; });
  if (clip.body_model == "mimicx") {
    for (const double b : clip.betas)
      if (std::abs(b) > kMaxBeta) betas.fail("shape parameters within ±5", text_of(b));
  } else if (any && !clip.rest_joints) {
    clip.warnings.push_back(foreign_betas_warning(clip.body_model));
  }
  if (any && per_frame)
    clip.warnings.push_back("betas are given per frame: those of the first frame are used");
}

/// The body of a motion that was simulated with the user's own body model.
void read_rest_joints(const Npz& npz, Clip& clip) {
  if (!npz.has("rest_joints")) return;
  const Member joints(npz, "rest_joints");
  joints.expect_shape({kBodies, 3});
  joints.expect_finite();
  clip.rest_joints.emplace();
  for (std::size_t i = 0; i < kBodies; ++i)
    (*clip.rest_joints)[i] = Eigen::Map<const Vector3d>(joints.values.data() + 3 * i);
  try {
    make_character_of_joints(*clip.rest_joints);
  } catch (const std::invalid_argument& error) {
    joints.fail("the joints of a human", error.what());
  }
}

void check_joint_names(const Npz& npz) {
  if (!npz.has("joint_names")) return;
  const std::vector<std::string>& names = npz.at("joint_names").text;
  for (std::size_t i = 0; i < kBodies; ++i)
    if (i >= names.size() || names[i] != kBodyNames[i])
      throw DataError(npz.path, "joint_names",
                      "'" + std::string(kBodyNames[i]) + "' as joint " + std::to_string(i),
                      i < names.size() ? "'" + names[i] + "'" : "the end of the list");
}

const std::vector<std::string> kKeypointMembers = {"keypoints_2d", "keypoint_names", "camera_intrinsics",
                                                   "camera_extrinsics"};

/// The file's names, or without any the names of the set with this number of keypoints. Unreadable names
/// (pickled ones) are an error.
std::vector<std::string> read_keypoint_names(const Npz& npz, const Member& points, Clip& clip) {
  const auto& unread = npz.unsupported();
  const bool unreadable = std::any_of(unread.begin(), unread.end(),
                                      [](const auto& member) { return member.first == "keypoint_names"; });
  if (npz.has("keypoint_names") || unreadable) return npz.at("keypoint_names").text;
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

/// Adds a decision where most keypoints belong to face and fingers, which are not used.
void say_what_is_left_aside(const std::vector<std::string>& names, Clip& clip) {
  const auto used = std::count_if(names.begin(), names.end(), [](const std::string& name) {
    return place_of_keypoint(name).has_value();
  });
  if (2 * used < std::ssize(names))
    clip.decisions.push_back("keypoints: " + std::to_string(used) + " of " + std::to_string(names.size()) +
                             " have a place on the body; the others (face, fingers) are not used");
}

Keypoints read_keypoints(const Npz& npz, Clip& clip) {
  const std::size_t frames = clip.rotations.size();
  const Member points(npz, "keypoints_2d");
  Keypoints out;
  out.names = read_keypoint_names(npz, points, clip);
  say_what_is_left_aside(out.names, clip);
  const std::size_t count = out.names.size();
  const Member intrinsics(npz, "camera_intrinsics"), extrinsics(npz, "camera_extrinsics");
  points.expect_shape({frames, count, 3});
  intrinsics.expect_shape({3, 3});
  intrinsics.expect_finite();
  const bool moving = extrinsics.array.shape.size() == 3;
  extrinsics.expect_shape(moving ? std::vector<std::size_t>{frames, 4, 4} : std::vector<std::size_t>{4, 4});
  extrinsics.expect_finite();
  out.uvc.assign(frames, std::vector<Vector3d>(count));
  for (std::size_t i = 0; i < frames * count; ++i) {
    const Vector3d uvc = Eigen::Map<const Vector3d>(points.values.data() + 3 * i);
    out.uvc[i / count][i % count] = uvc.allFinite() ? uvc : Vector3d::Zero();
  }
  out.intrinsics = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(intrinsics.values.data());
  for (std::size_t i = 0; i < (moving ? frames : 1); ++i)
    out.extrinsics.push_back(
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(extrinsics.values.data() + 16 * i));
  return out;
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

/// A passed-through member, or nullptr.
const NpyArray* passed_on(const Clip& clip, const std::string& key) {
  for (const auto& [name, array] : clip.passthrough)
    if (name == key) return &array;
  return nullptr;
}

/// The columns of two matrices side by side, float64; only the first matrix where their rows differ.
NpyArray beside(const NpyArray& left, const NpyArray& right) {
  if (right.shape.size() != 2 || right.shape[0] != left.shape[0]) return left;
  Eigen::MatrixXd both(to_matrix(left).rows(), to_matrix(left).cols() + to_matrix(right).cols());
  both << to_matrix(left), to_matrix(right);
  return from_matrix(both);
}

/// The columns of `poses` after those of the body: the input's own columns, or for a file with named arrays
/// of SMPL-X these in the model's order: jaw, eyes (0 where missing), hands.
NpyArray other_columns(const Clip& clip) {
  if (const NpyArray* rest = passed_on(clip, "poses_rest")) return *rest;
  constexpr std::pair<const char*, std::size_t> kParts[] = {
      {"pose_jaw", 3}, {"pose_eye", 6}, {"pose_hand", 90}};
  const std::size_t frames = clip.rotations.size();
  if (!passed_on(clip, "pose_hand")) return {};
  std::vector<NpyArray> parts;
  for (const auto& [name, columns] : kParts) {
    const std::vector<std::size_t> shape = {frames, columns};
    const NpyArray* part = passed_on(clip, name);
    const std::vector<double> none(frames * columns, 0.0);
    parts.push_back(part && part->shape == shape ? *part : NpyArray::from_double(shape, none.data()));
  }
  return beside(beside(parts[0], parts[1]), parts[2]);
}

/// The betas in use and those past the tenth.
NpyArray all_betas(const Clip& clip) {
  std::vector<double> betas(clip.betas.begin(), clip.betas.end());
  if (const NpyArray* rest = passed_on(clip, "betas_rest")) {
    const std::vector<double> values = rest->to_double();
    betas.insert(betas.end(), values.begin(), values.end());
  }
  return NpyArray::from_double({betas.size()}, betas.data());
}

NpyArray rest_joints_member(const RestJoints& joints) {
  std::vector<double> values;
  for (const Vector3d& p : joints) values.insert(values.end(), p.data(), p.data() + 3);
  return NpyArray::from_double({kBodies, 3}, values.data());
}

}  // namespace

Clip read_clip(const std::filesystem::path& path) { return clip_from(read_npz(path), path.stem().string()); }

Clip clip_from(const Npz& npz, const std::string& name) {
  Clip clip;
  clip.name = name;
  check_joint_names(npz);
  clip.fps = read_fps(npz);
  clip.body_model = read_body_model(npz, read_rotations(npz, clip));
  const std::size_t frames = clip.rotations.size();
  if (frames == 0) throw DataError(npz.path, "", "at least one frame", "none");
  const Member trans(npz, "trans");
  if (trans.expect_rows(3) != frames)
    trans.fail(std::to_string(frames) + " frames as in the rotations", trans.shape());
  for (std::size_t t = 0; t < frames; ++t)
    clip.trans.push_back(Eigen::Map<const Vector3d>(trans.values.data() + 3 * t));
  read_rest_joints(npz, clip);
  read_betas(npz, clip);
  if (npz.has("gender")) clip.gender = member_text(npz, "gender");

  std::vector<std::string> used = {"poses",           "root_orient",
                                   "pose_body",       "trans",
                                   "rest_joints",     "betas",
                                   "gender",          "joint_names",
                                   "mocap_framerate", "mocap_frame_rate",
                                   "body_model",      "surface_model_type"};
  if (npz.has("keypoints_2d") && npz.has("camera_intrinsics") && npz.has("camera_extrinsics")) {
    clip.keypoints = read_keypoints(npz, clip);
    check_keypoints(npz.path, *clip.keypoints, clip.decisions);
    used.insert(used.end(), kKeypointMembers.begin(), kKeypointMembers.end());
  } else if (npz.has("keypoints_2d")) {
    clip.warnings.push_back("keypoints_2d without camera_intrinsics and camera_extrinsics are not used");
  }
  for (const auto& [key, array] : npz.members())
    if (std::find(used.begin(), used.end(), key) == used.end()) clip.passthrough.emplace_back(key, array);
  for (const auto& [key, why] : npz.unsupported())
    clip.warnings.push_back(std::string(why.what()) + " (left out)");
  return clip;
}

Npz to_npz(const Clip& clip, const std::vector<std::pair<std::string, NpyArray>>& extra) {
  Npz npz;
  const std::size_t frames = clip.rotations.size();
  std::vector<double> root, body, trans;
  for (const auto& frame : clip.rotations) {
    root.insert(root.end(), frame[0].data(), frame[0].data() + 3);
    for (std::size_t j = 1; j < kBodies; ++j) body.insert(body.end(), frame[j].data(), frame[j].data() + 3);
  }
  for (const Vector3d& p : clip.trans) trans.insert(trans.end(), p.data(), p.data() + 3);
  const NpyArray root_orient = NpyArray::from_double({frames, 3}, root.data());
  const NpyArray pose_body = NpyArray::from_double({frames, 3 * kJoints}, body.data());
  npz.set("poses", beside(beside(root_orient, pose_body), other_columns(clip)));
  npz.set("trans", NpyArray::from_double({frames, 3}, trans.data()));
  npz.set("betas", all_betas(clip));
  npz.set("mocap_framerate", NpyArray::scalar(clip.fps));
  npz.set("gender", NpyArray::scalar_text(clip.gender));
  npz.set("joint_names", NpyArray::from_text({kBodyNames.begin(), kBodyNames.end()}));
  npz.set("body_model", NpyArray::scalar_text(clip.body_model));
  if (clip.rest_joints) npz.set("rest_joints", rest_joints_member(*clip.rest_joints));
  if (clip.keypoints) add_keypoints(npz, *clip.keypoints);
  if (passed_on(clip, "pose_hand")) {  // readers of SMPL-X files expect these
    npz.set("root_orient", root_orient);
    npz.set("pose_body", pose_body);
    npz.set("mocap_frame_rate", NpyArray::scalar(clip.fps));
  }
  for (const auto& [key, array] : clip.passthrough)
    if (!npz.has(key) && key != "poses_rest" && key != "betas_rest") npz.set(key, array);
  for (const auto& [key, array] : extra) npz.set(key, array);
  return npz;
}

void write_clip(const std::filesystem::path& path, const Clip& clip,
                const std::vector<std::pair<std::string, NpyArray>>& extra) {
  write_npz(path, to_npz(clip, extra));
}

}  // namespace mimicx::motion

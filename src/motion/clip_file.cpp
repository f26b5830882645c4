#include "motion/clip_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

#include "core/number_text.h"
#include "core/so3.h"
#include "motion/keypoint_members.h"
#include "motion/npz_member.h"
#include "motion/passthrough.h"

namespace mimicx::motion {
namespace {

constexpr int kPoseColumns = 3 * kBodies;  ///< root and 21 joints
constexpr double kMaxFps = 2000.0;

/// Names that one member has in files of different programs, the usual one first.
using Names = std::vector<std::string>;
const Names kPoses = {"poses", "smpl_poses", "fullpose", "full_pose", "thetas", "theta", "pose"};
const Names kRoot = {"root_orient", "global_orient"};
const Names kBody = {"pose_body", "body_pose"};
const Names kTrans = {"trans", "transl", "smpl_trans", "translation"};
const Names kRates = {"mocap_framerate", "mocap_frame_rate", "fps", "frame_rate", "framerate"};
const Names kBetaNames = {"betas", "smpl_betas", "beta"};

/// The first of the names that the archive has; empty: none.
std::string found_among(const Names& names, const Npz& npz) {
  for (const std::string& name : names)
    if (npz.has(name)) return name;
  return {};
}

/// The members that the poses are read from; empty: none. Where there are root and body, `poses` is not read
/// but for hands and face.
struct Sources {
  std::string root, body, poses, trans;

  explicit Sources(const Npz& npz)
      : root(found_among(kRoot, npz)), body(found_among(kBody, npz)), trans(found_among(kTrans, npz)) {
    if (!root.empty() && !body.empty()) return;
    root.clear();
    body.clear();
    poses = found_among(kPoses, npz);
  }
  bool named() const { return !root.empty(); }
  std::string rotations() const { return named() ? root + " with " + body : poses; }
};

/// A text; the first of several that are equal. None where the member is something else.
std::optional<std::string> member_text(const Npz& npz, const std::string& key) {
  const NpyArray& array = npz.at(key);
  if (array.text.empty() ||
      std::count(array.text.begin(), array.text.end(), array.text[0]) != std::ssize(array.text))
    return std::nullopt;
  return array.text[0];
}

std::string listed(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The file's frame rate. Where it has several that differ, the first counts, with a warning.
double read_fps(const Npz& npz, const std::optional<double>& given, Clip& clip) {
  std::optional<double> rate;
  std::string key, found = "none";
  for (const std::string& name : kRates) {
    if (!npz.has(name)) continue;
    if (npz.at(name).type == NpyArray::Type::kText) {
      found = "text in " + name;
      continue;
    }
    const Member fps(npz, name);
    const bool sound = fps.values.size() == 1 && fps.values[0] > 0.0 && fps.values[0] <= kMaxFps;
    if (!sound && !given)
      fps.fail("one frame rate between 0 and 2000 Hz (--fps gives one)",
               fps.values.size() == 1 ? text_of(fps.values[0]) : fps.shape());
    if (!sound) continue;
    if (rate && std::abs(fps.values[0] / *rate - 1.0) > 1e-3 && !given)
      clip.warnings.push_back("two frame rates: " + key + " says " + text_of(*rate) + ", " + name + " says " +
                              text_of(fps.values[0]) + "; the first is used (--fps overrides)");
    if (!rate) rate = fps.values[0], key = name;
  }
  for (const auto& [name, why] : npz.unsupported())
    if (std::find(kRates.begin(), kRates.end(), name) != kRates.end()) found = "a pickled " + name;
  if (!rate && !given)
    throw DataError(npz.path, "", "a frame rate (mocap_framerate, mocap_frame_rate or fps; --fps gives one)",
                    found);
  return rate ? *rate : *given;
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

/// Keeps columns of the poses for hands, jaw and eyes. They are written to the same columns again, even if
/// the file also has them as named arrays. Their order does not matter here.
void keep_other_columns(const Member& poses, std::size_t used, Clip& clip) {
  if (poses.columns() <= used) return;
  NpyArray flat = poses.array;
  flat.shape = {poses.rows(), poses.columns()};
  clip.passthrough.emplace_back("poses_rest", columns_from(flat, used));
}

[[noreturn]] void fail_without_rotations(const Npz& npz) {
  std::string names;
  for (const auto& [key, array] : npz.members()) names += (names.empty() ? "" : ", ") + key;
  if (!npz.unsupported().empty()) {
    names += names.empty() ? "" : ", and ";
    for (const auto& [key, why] : npz.unsupported())
      names += (&key == &npz.unsupported().front().first ? "" : ", ") + key;
    names +=
        " (pickled, or of types that are not read: tools/convert_video_results.py converts results of video "
        "estimators)";
  }
  throw DataError(npz.path, "",
                  "rotations (poses; or root_orient and pose_body; or global_orient and body_pose)",
                  names.empty() ? "no members at all" : names);
}

/// Fails where a member has rotation matrices, quaternions or the first two columns of matrices ("6D").
void expect_axis_angle(const Member& member) {
  const auto& shape = member.array.shape;
  for (const auto& [numbers, name] :
       {std::pair<std::size_t, const char*>{4, "quaternions"}, {6, "6D rotations"}})
    for (const std::size_t joints : {1U, 21U, 22U, 23U, 24U, 52U, 55U})
      if (member.columns() == numbers * joints && (shape.size() == 2 || shape.back() == numbers))
        member.fail("rotations as axis-angle", member.shape() + ", " + name);
  if (shape.size() >= 3 && shape[shape.size() - 1] == 3 && shape[shape.size() - 2] == 3 && shape.size() != 3)
    member.fail("rotations as axis-angle", member.shape() + ", rotation matrices");
}

/// Fills the rotations; returns the body model of the layout.
std::string read_rotations(const Npz& npz, const Sources& sources, Clip& clip) {
  const auto vector_at = [](const std::vector<double>& v, std::size_t at) {
    return Vector3d(v[at], v[at + 1], v[at + 2]);
  };
  if (sources.named()) {
    const Member root(npz, sources.root), body(npz, sources.body);
    expect_axis_angle(root);
    expect_axis_angle(body);
    const std::size_t frames = root.rows(), columns = body.columns();
    if (root.columns() != 3) root.fail("shape (frames, 3)", root.shape());
    if (columns != 3 * kJoints && columns != 3 * kJoints + 6)
      body.fail("shape (frames, 63) or (frames, 69)", body.shape());
    if (body.rows() != frames) body.fail(std::to_string(frames) + " frames as in " + root.key, body.shape());
    root.expect_finite_columns(3);
    body.expect_finite_columns(3 * kJoints);
    clip.rotations.resize(frames);
    for (std::size_t t = 0; t < frames; ++t) {
      clip.rotations[t][0] = vector_at(root.values, 3 * t);
      for (std::size_t j = 0; j < kJoints; ++j)
        clip.rotations[t][j + 1] = vector_at(body.values, columns * t + 3 * j);
    }
    if (npz.has("poses") && npz.at("poses").type != NpyArray::Type::kText) {
      const Member poses(npz, "poses");
      if (poses.rows() != frames)
        poses.fail(std::to_string(frames) + " frames as in " + root.key, poses.shape());
      keep_other_columns(poses, kPoseColumns, clip);
    } else {
      keep_other_columns(body, 3 * kJoints, clip);
    }
    return columns == 3 * kJoints ? "smplx" : "smpl";
  }
  if (sources.poses.empty()) fail_without_rotations(npz);
  const Member poses(npz, sources.poses);
  expect_axis_angle(poses);
  const std::size_t columns = poses.columns();
  if (columns == 0) poses.fail("shape (frames, 66, 72, 156 or 165)", poses.shape());
  if (columns != 66 && columns != 72 && columns != 156 && columns != 165)
    poses.fail("66, 72, 156 or 165 columns", std::to_string(columns));
  poses.expect_finite_columns(kPoseColumns);
  clip.rotations.resize(poses.rows());
  for (std::size_t t = 0; t < clip.rotations.size(); ++t)
    for (std::size_t j = 0; j < kBodies; ++j)
      clip.rotations[t][j] = vector_at(poses.values, columns * t + 3 * j);
  keep_other_columns(poses, kPoseColumns, clip);
  return columns == 72 ? "smpl" : columns == 156 ? "smplh" : "smplx";
}

/// The largest angle between rotation vectors and those of the clip's bodies from `first` on, rad; 0 where
/// the member has other rows, or another width.
double largest_turn(const Member& member, std::initializer_list<std::size_t> widths, std::size_t first,
                    const Clip& clip) {
  const std::size_t columns = member.columns(), bodies = std::min(*widths.begin() / 3, kBodies - first);
  if (member.rows() != clip.rotations.size() ||
      std::find(widths.begin(), widths.end(), columns) == widths.end())
    return 0.0;
  double largest = 0.0;
  for (std::size_t t = 0; t < clip.rotations.size(); ++t)
    for (std::size_t j = 0; j < bodies; ++j) {
      const Vector3d turn = Eigen::Map<const Vector3d>(member.values.data() + columns * t + 3 * j);
      const Quaterniond used = exp_map(clip.rotations[t][first + j]);
      largest = std::max(largest, log_map(exp_map(turn).conjugate() * used).norm());
    }
  return largest;
}

/// The largest distance between the rows of two members of one shape, in their unit; 0 of other shapes.
double largest_distance(const Member& a, const Member& b) {
  double largest = 0.0;
  for (std::size_t i = 0; a.array.shape == b.array.shape && i + 2 < a.values.size(); i += 3)
    largest = std::max(largest, (Eigen::Map<const Vector3d>(a.values.data() + i) -
                                 Eigen::Map<const Vector3d>(b.values.data() + i))
                                    .norm());
  return largest;
}

/// Members that are not used, and how far each is from those that are.
using Deviations = std::vector<std::pair<std::string, double>>;

void warn_of(const std::string& what, const std::string& unit, const std::string& used,
             const Deviations& others, Clip& clip) {
  constexpr double kRounding = 1e-3;
  std::string names;
  double most = 0.0;
  for (const auto& [name, by] : others)
    if (by > kRounding) names += ", " + name, most = std::max(most, by);
  if (!names.empty())
    clip.warnings.push_back("two sources of " + what + ": " + used + names + " differ by up to " +
                            formatted("%.3g", most) + unit + "; the first is used");
}

/// Warns where members say something else than those that are used in their place.
void compare_sources(const Npz& npz, const Sources& used, Clip& clip) {
  Deviations rotations, places;
  const auto visit = [&](const Names& names, const auto& add) {
    for (const std::string& name : names) {
      const bool is_used = name == used.root || name == used.body || name == used.poses || name == used.trans;
      if (!is_used && npz.has(name) && npz.at(name).type != NpyArray::Type::kText) add(Member(npz, name));
    }
  };
  visit(kRoot, [&](const Member& m) { rotations.emplace_back(m.key, largest_turn(m, {3}, 0, clip)); });
  visit(kBody, [&](const Member& m) { rotations.emplace_back(m.key, largest_turn(m, {63, 69}, 1, clip)); });
  visit(kPoses, [&](const Member& m) {
    rotations.emplace_back(m.key, largest_turn(m, {66, 72, 156, 165}, 0, clip));
  });
  const Member trans(npz, used.trans);
  visit(kTrans, [&](const Member& m) { places.emplace_back(m.key, largest_distance(m, trans)); });
  warn_of("rotations", " rad", used.rotations(), rotations, clip);
  warn_of("places", "", used.trans, places, clip);
}

/// Other names of what is read, for poses and places those with a row per frame. They are not copied, because
/// they would contradict a motion that has changed.
Names other_names(const Npz& npz, const Sources& used, std::size_t frames) {
  Names found;
  const auto add = [&](const Names& names, const Names& read, bool per_frame) {
    for (const std::string& name : names)
      if (npz.has(name) && npz.at(name).type != NpyArray::Type::kText &&
          std::find(read.begin(), read.end(), name) == read.end() &&
          (!per_frame || is_per_frame(name, npz.at(name), frames)))
        found.push_back(name);
  };
  add(kRoot, {used.root}, false);
  add(kBody, {used.body}, false);
  add(kPoses, {used.poses, "poses"}, true);  // `poses` is written anew
  add(kTrans, {used.trans}, true);
  add(kBetaNames, {found_among(kBetaNames, npz)}, false);
  return found;
}

/// AIST++'s smpl_trans is in the unit of smpl_scaling, which is the size of the body in it; 1 in other files.
double scaling_of(const Npz& npz) {
  if (!npz.has("smpl_scaling")) return 1.0;
  const Member scaling(npz, "smpl_scaling");
  if (scaling.values.empty() || !(scaling.values[0] > 0.0 && std::isfinite(scaling.values[0])))
    scaling.fail("a positive number", "another one");
  return scaling.values[0];
}

/// Variants such as "smplx_locked_head" count as their base model.
std::string read_body_model(const Npz& npz, const std::string& from_layout) {
  for (const char* key : {"body_model", "surface_model_type"}) {
    if (!npz.has(key)) continue;
    const std::string name = member_text(npz, key).value_or("something else");
    std::string plain;  // of "SMPL-X", "smpl+h"
    for (const char c : name)
      if (c != '-' && c != '+' && c != ' ')
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* known : {"mimicx", "smplx", "smplh", "smpl"})
      if (plain == known || plain.starts_with(std::string(known) + "_")) return known;
    throw DataError(npz.path, key, "mimicx, smplx, smplh or smpl", "'" + name + "'");
  }
  return from_layout;
}

void read_betas(const Npz& npz, Clip& clip) {
  const std::string key = found_among(kBetaNames, npz);
  if (key.empty()) return;
  const Member betas(npz, key);
  std::vector<std::size_t> shape =
      betas.array.shape;  // without dimensions of one between the first and the last
  while (shape.size() > 2 && shape[1] == 1) shape.erase(shape.begin() + 1);
  const bool per_frame = shape.size() == 2 && shape[0] == clip.rotations.size() && shape[0] > 1;
  if (shape.size() != 1 && !(shape.size() == 2 && (shape[0] == 1 || per_frame))) {
    if (clip.body_model == "mimicx") betas.fail("one row of shape parameters", betas.shape());
    clip.warnings.push_back("betas of " + betas.shape() + " are not used");
    return;
  }
  const std::size_t count = std::min<std::size_t>(shape.back(), kBetas);
  std::copy_n(betas.values.begin(), count, clip.betas.begin());
  for (const double b : clip.betas)
    if (!std::isfinite(b)) betas.fail_not_finite(0);
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

void check_joint_names(const Npz& npz) {
  if (!npz.has("joint_names")) return;
  const std::vector<std::string>& names = npz.at("joint_names").text;
  for (std::size_t i = 0; i < kBodies; ++i)
    if (i >= names.size() || names[i] != kBodyNames[i])
      throw DataError(npz.path, "joint_names",
                      "'" + std::string(kBodyNames[i]) + "' as joint " + std::to_string(i),
                      i < names.size() ? "'" + names[i] + "'" : "the end of the list");
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

constexpr std::size_t kPlateNumbers = 8;

/// (plates, 8): centre x, y, yaw, half extents x, y, height, stiffness, damping.
NpyArray scene_member(const Scene& scene) {
  std::vector<double> values;
  for (const Plate& p : scene.plates)
    values.insert(values.end(), {p.centre.x(), p.centre.y(), p.yaw, p.half_extents.x(), p.half_extents.y(),
                                 p.height, p.stiffness, p.damping});
  return NpyArray::from_double({scene.plates.size(), kPlateNumbers}, values.data());
}

/// Row `index` of the first dimension, elements untouched.
NpyArray row_of(const NpyArray& array, std::size_t index) {
  NpyArray out;
  out.type = array.type;
  out.shape.assign(array.shape.begin() + 1, array.shape.end());
  const std::size_t width = array.bytes.size() / array.shape[0];
  const auto begin = array.bytes.begin() + static_cast<std::ptrdiff_t>(index * width);
  out.bytes.assign(begin, begin + static_cast<std::ptrdiff_t>(width));
  return out;
}

/// The archive, or of one whose arrays have a dimension for people in front, (P, T, …), the part of one
/// person. More people than frames are frames with people, (T, P, …), and refused.
Npz one_person_of(const Npz& npz, const std::optional<int>& person) {
  const std::string body = found_among(kBody, npz), trans = found_among(kTrans, npz);
  const std::string key = body.empty() ? found_among(kPoses, npz) : body;
  const bool may_have = !key.empty() && !trans.empty() && npz.at(trans).shape.size() == 3 &&
                        npz.at(key).shape.size() >= 3 && npz.at(trans).shape[2] == 3;
  const auto& shape = may_have ? npz.at(key).shape : std::vector<std::size_t>{};
  if (!may_have || shape[0] != npz.at(trans).shape[0] || shape[1] != npz.at(trans).shape[1]) {
    if (person && *person != 1)
      throw DataError(npz.path, "", "people 1 to " + std::to_string(*person), "one person");
    return npz;
  }
  const std::size_t people = shape[0];
  if (people > shape[1])
    throw DataError(npz.path, key, "people first, (people, frames, ...)",
                    text_of_shape(shape) + ": " + std::to_string(people) + " people in " +
                        std::to_string(shape[1]) + " frames, or " + std::to_string(shape[1]) +
                        (shape[1] == 1 ? " person in " : " people in ") + std::to_string(people) +
                        " frames, whose first two dimensions are to be exchanged");
  const auto place = static_cast<std::size_t>(person.value_or(1));
  if ((people != 1 && !person) || place > people)
    throw DataError(npz.path, key, "one person: --person 1 to " + std::to_string(people),
                    std::to_string(people) + " people, " + text_of_shape(shape));
  Npz out;
  out.path = npz.path;
  for (const auto& [name, array] : npz.members()) {
    const auto& s = array.shape;
    const bool of_people = array.type != NpyArray::Type::kText && s.size() >= 2 && s[0] == people &&
                           (s[1] == shape[1] || (s.size() == 2 && name == found_among(kBetaNames, npz)));
    out.set(name, of_people ? row_of(array, place - 1) : array);
  }
  for (const auto& [name, why] : npz.unsupported()) out.set_unsupported(name, why);
  return out;
}

}  // namespace

Clip read_clip(const std::filesystem::path& path, const ClipConfig& config) {
  return clip_from(read_npz(path), path.stem().string(), config);
}

Clip clip_from(const Npz& archive, const std::string& name, const ClipConfig& config) {
  const Npz npz = one_person_of(archive, config.person);
  Clip clip;
  clip.name = name;
  check_joint_names(npz);
  const Sources sources(npz);
  clip.body_model = read_body_model(npz, read_rotations(npz, sources, clip));
  const std::size_t frames = clip.rotations.size();
  if (frames == 0) throw DataError(npz.path, "", "at least one frame", "none");
  const Member trans(npz, sources.trans.empty() ? kTrans[0] : sources.trans);
  if (trans.columns() != 3) trans.fail("shape (frames, 3)", trans.shape());
  trans.expect_finite_columns(3);
  if (trans.rows() != frames)
    trans.fail(std::to_string(frames) + " frames as in the rotations", trans.shape());
  const double unit = scaling_of(npz);
  for (std::size_t t = 0; t < frames; ++t)
    clip.trans.push_back(Eigen::Map<const Vector3d>(trans.values.data() + 3 * t) / unit);
  compare_sources(npz, sources, clip);
  clip.fps = read_fps(npz, config.fps, clip);
  clip.rest_joints = rest_joints_of(npz);
  read_betas(npz, clip);
  clip.scene = scene_of(npz);
  if (npz.has("gender")) clip.gender = member_text(npz, "gender").value_or("neutral");

  const Names others = other_names(npz, sources, frames);
  Names used = {"rest_joints",  "gender",
                "joint_names",  "joints",
                "body_model",   "surface_model_type",
                "smpl_scaling", kSceneMember,
                sources.root,   sources.body,
                sources.poses,  "poses",
                sources.trans,  found_among(kBetaNames, npz)};
  for (const Names& names : {kRates, others}) used.insert(used.end(), names.begin(), names.end());
  if (read_keypoints(npz, clip)) used.insert(used.end(), kKeypointMembers.begin(), kKeypointMembers.end());
  if (!others.empty())
    clip.decisions.push_back("not copied: " + listed(others) + " (other names of members that are used)");
  for (const auto& [key, array] : npz.members())
    if (std::find(used.begin(), used.end(), key) == used.end()) clip.passthrough.emplace_back(key, array);
  for (const auto& [key, why] : npz.unsupported())
    clip.warnings.push_back(std::string(why.what()) + " (left out)");
  return clip;
}

Scene scene_of(const Npz& npz) {
  Scene scene;
  if (!npz.has(kSceneMember)) return scene;
  const Member member(npz, kSceneMember);
  if (member.array.shape.size() != 2 || member.columns() != kPlateNumbers)
    member.fail("shape (plates, 8)", member.shape());
  for (std::size_t k = 0; k < member.rows(); ++k) {
    const double* v = member.values.data() + kPlateNumbers * k;
    scene.plates.push_back({{v[0], v[1]}, v[2], {v[3], v[4]}, v[5], v[6], v[7]});
  }
  require_scene(scene, npz.path + ": " + kSceneMember);
  return scene;
}

void add_scene(const Scene& scene, Npz& npz) {
  if (!scene.flat()) npz.set(kSceneMember, scene_member(scene));
}

std::optional<RestJoints> rest_joints_of(const Npz& npz) {
  if (!npz.has("rest_joints")) return std::nullopt;
  const Member member(npz, "rest_joints");
  member.expect_shape({kBodies, 3});
  member.expect_finite();
  RestJoints joints;
  for (std::size_t i = 0; i < kBodies; ++i)
    joints[i] = Eigen::Map<const Vector3d>(member.values.data() + 3 * i);
  try {
    make_character_of_joints(joints);
  } catch (const std::invalid_argument& error) {
    member.fail("the joints of a human", error.what());
  }
  return joints;
}

void add_rest_joints(const std::optional<RestJoints>& joints, Npz& npz) {
  if (!joints) return;
  std::vector<double> values;
  for (const Vector3d& p : *joints) values.insert(values.end(), p.data(), p.data() + 3);
  npz.set("rest_joints", NpyArray::from_double({kBodies, 3}, values.data()));
}

NpyArray joint_positions_member(const Clip& clip) {
  std::vector<double> values;
  for (const BodyPoses& pose : poses_of(clip))
    for (const Vector3d& p : pose.p_WB) values.insert(values.end(), p.data(), p.data() + 3);
  return NpyArray::from_double({clip.rotations.size(), kBodies, 3}, values.data());
}

bool is_in_our_world(const Clip& clip) {
  const NpyArray* world = passed_on(clip, kWorldMember);
  return world && world->text == std::vector<std::string>{kOurWorld};
}

std::vector<std::pair<std::string, NpyArray>> world_members(const Clip& clip) {
  if (clip.body_model == "mimicx") return {};
  return {{kWorldMember, NpyArray::scalar_text(kOurWorld)}};
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
  add_rest_joints(clip.rest_joints, npz);
  add_scene(clip.scene, npz);
  if (clip.keypoints) add_keypoints(npz, *clip.keypoints);
  if (passed_on(clip, "pose_hand") && clip.body_model != "mimicx") {  // readers of SMPL-X files expect these
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

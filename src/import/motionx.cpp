#include "import/motionx.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "import/plausibility.h"
#include "import/world_transform.h"
#include "motion/npz_member.h"

namespace mimicx::import {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kMotionXFps = 30.0;
constexpr double kAistScale = 1.0 / 94.0;  ///< of the data set's README
constexpr std::size_t kOwnBlanks = 64;     ///< by which our header is longer
constexpr Index kBody = 0, kTrans = 309, kBetaColumns = 312;

/// Columns that pass through, and the names they get.
struct Columns {
  const char* name;
  Index first, columns;
};
constexpr Columns kParts[] = {
    {"pose_hand", 66, 90}, {"pose_jaw", 156, 3}, {"expression", 159, 50}, {"face_shape", 209, 100}};

void require_layout(const NpyArray& array, const std::string& path) {
  if (array.type == NpyArray::Type::kText) throw DataError(path, "", "numbers", "text");
  if (array.shape.size() == 2 && array.shape[1] == kMotionxColumns && array.shape[0] > 0) return;
  throw DataError(
      path, "",
      "a Motion-X array of shape (frames, 322), joint positions (frames, 22, 3) or HumanML3D's features "
      "(frames, 263)",
      motion::text_of_shape(array.shape));
}

void read_betas(const MatrixXd& values, motion::Clip& clip) {
  const MatrixXd betas = values.middleCols(kBetaColumns, kBetas);
  for (std::size_t k = 0; k < kBetas; ++k) clip.betas[k] = betas(0, static_cast<Index>(k));
  if (!betas.row(0).isZero(0.0)) clip.warnings.push_back(motion::foreign_betas_warning(clip.body_model));
  if (!(betas.rowwise() - betas.row(0)).isZero(0.0))
    clip.warnings.emplace_back("betas change over time: those of the first frame are used");
}

/// Whether the supporting foot is implausibly fast, or the pelvis implausibly high (y is up), and far less in
/// another unit.
bool is_wrong_scale(const motion::Clip& clip, double speed, double speed_scaled) {
  constexpr double kFastSupport = 3.0, kFarHeight = 20.0, kCalmer = 1.0 / 3.0;  // m/s, m
  std::vector<double> heights;
  for (const Vector3d& trans : clip.trans) heights.push_back(std::abs(trans.y()));
  return (speed > kFastSupport || finite_quantile(heights, 0.5) > kFarHeight) &&
         speed_scaled < kCalmer * speed;
}

/// Converts from centimetres, or undoes the scale and the mirrored axis of the AIST subset, where speeds show
/// them. Both factors are similar; the right one gives calmer feet.
void settle_unit(motion::Clip& clip) {
  motion::Clip aist = clip, centimetres = clip;
  for (Vector3d& trans : aist.trans) trans = kAistScale * trans.cwiseProduct(Vector3d(1, 1, -1));
  for (Vector3d& trans : centimetres.trans) trans *= 0.01;
  const double before = support_speed(clip), as_aist = support_speed(aist),
               as_centimetres = support_speed(centimetres);
  const double after = std::min(as_aist, as_centimetres);
  if (!is_wrong_scale(clip, before, after)) return;
  const bool is_aist = as_aist <= as_centimetres;
  clip = is_aist ? aist : centimetres;
  clip.decisions.push_back(std::string("scale: ") +
                           (is_aist ? "1/94 with z negated, the known error of Motion-X's AIST part"
                                    : "the translation is in centimetres") +
                           " (the stillest joint moved at " + short_number(before) + " m/s, now at " +
                           short_number(after) + "; --scale overrides)");
}

std::vector<std::size_t> shape_of(Index rows, Index columns) {
  return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
}

/// Puts jaw and hands of the columns of `poses` behind the body into their places: of SMPL-X, where eyes,
/// which Motion-X does not have, are between them; of SMPL-H hands alone.
void put_rest(const NpyArray& rest, MatrixXd& values) {
  constexpr Columns hands = kParts[0], jaw = kParts[1];
  constexpr Index eyes = 6;
  const bool smplx = rest.shape == shape_of(values.rows(), jaw.columns + eyes + hands.columns);
  if (!smplx && rest.shape != shape_of(values.rows(), hands.columns)) return;
  const MatrixXd columns = to_matrix(rest);
  if (smplx) values.middleCols(jaw.first, jaw.columns) = columns.leftCols(jaw.columns);
  values.middleCols(hands.first, hands.columns) = columns.rightCols(hands.columns);
}

}  // namespace

motion::Clip motionx_from(const NpyArray& array, const std::string& name, const std::string& path,
                          bool may_scale) {
  require_layout(array, path);
  const MatrixXd values = to_matrix(array);
  constexpr Columns used[] = {
      {"pose", kBody, 3 * kBodies}, {"trans", kTrans, 3}, {"betas", kBetaColumns, kBetas}};
  for (Index t = 0; t < values.rows(); ++t)
    for (const Columns& part : used)
      if (!values.row(t).segment(part.first, part.columns).allFinite())
        throw DataError(path, "frame " + std::to_string(t), std::string("finite numbers of ") + part.name,
                        "one that is not");
  motion::Clip clip;
  clip.name = name;
  clip.fps = kMotionXFps;
  clip.body_model = "smplx";
  clip.decisions.emplace_back(kMotionxFormat);
  for (Index t = 0; t < values.rows(); ++t) {
    clip.rotations.emplace_back();
    for (int j = 0; j < kBodies; ++j) clip.rotations.back()[j] = values.row(t).segment<3>(kBody + 3 * j);
    clip.trans.emplace_back(values.row(t).segment<3>(kTrans));
  }
  read_betas(values, clip);
  for (const Columns& part : kParts)
    clip.passthrough.emplace_back(part.name, from_matrix(values.middleCols(part.first, part.columns)));
  if (may_scale) settle_unit(clip);
  rotate_world(rotation_to_z_up('y'), clip);
  return clip;
}

NpyArray to_motionx(const motion::Clip& clip) {
  if (clip.fps != kMotionXFps) throw std::invalid_argument("Motion-X files are at 30 fps: give --rate 30");
  motion::Clip out = clip;
  if (clip.body_model != "smplx") {
    // The same pelvis on SMPL-X's mean body: a shape of another model means nothing there.
    motion::Clip body;
    body.body_model = "smplx";
    motion::put_on_body_of(body, out);
  }
  rotate_world(rotation_to_z_up('y').conjugate(), out);
  MatrixXd values = MatrixXd::Zero(out.frames(), kMotionxColumns);
  for (Index t = 0; t < values.rows(); ++t) {
    for (int j = 0; j < kBodies; ++j) values.row(t).segment<3>(kBody + 3 * j) = out.rotations[t][j];
    values.row(t).segment<3>(kTrans) = out.trans[t];
    for (std::size_t k = 0; k < kBetas; ++k) values(t, kBetaColumns + static_cast<Index>(k)) = out.betas[k];
  }
  for (const auto& [name, array] : clip.passthrough)
    if (name == "poses_rest") put_rest(array, values);
  for (const Columns& part : kParts)
    for (const auto& [name, array] : clip.passthrough)
      if (name == part.name && array.shape == shape_of(values.rows(), part.columns))
        values.middleCols(part.first, part.columns) = to_matrix(array);
  return from_matrix(values);
}

void write_motionx(const std::filesystem::path& path, const motion::Clip& clip) {
  std::string bytes = format_npy(to_motionx(clip));
  bytes.replace(0, kMotionxOpening.size(), kMotionxOpening);
  bytes.insert(bytes.find('\n'), kOwnBlanks, ' ');
  write_file_atomically(path, bytes);
}

}  // namespace mimicx::import

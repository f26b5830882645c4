#include "picture/layout.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "core/number_text.h"

namespace mimicx::picture {
namespace {

constexpr int kGap = 2;  ///< between cells, pixels

/// Default size of a cell, pixels.
struct NaturalSize {
  int height, least_width, most_width;
};
NaturalSize natural_size(Kind kind) {
  switch (kind) {
    case Kind::kStill:
      return {640, 360, 1280};
    case Kind::kStroboscope:
      return {420, 600, 1600};
    case Kind::kStrip:
      return {320, 110, 640};
    case Kind::kAnimation:
      return {400, 240, 800};
  }
  throw std::invalid_argument("natural_size: no such kind");
}

bool is_beside(Kind kind) { return kind == Kind::kStill || kind == Kind::kAnimation; }

std::string in_seconds(double time) { return formatted("%.2f s", time); }

/// @throws std::invalid_argument
TimeSpan common_stretch(const List<PosedMotion>& motions, const PictureConfig& config) {
  TimeSpan stretch = config.stretch;
  if (stretch.first > stretch.last)
    throw std::invalid_argument("it begins at " + in_seconds(stretch.first) + ", after its end at " +
                                in_seconds(stretch.last));
  for (const PosedMotion& p : motions) stretch.last = std::min(stretch.last, p.seconds());
  const auto refuse = [&](double time) {
    throw std::invalid_argument(in_seconds(time) + " is not in the motion, which ends at " +
                                in_seconds(stretch.last));
  };
  if (stretch.first > stretch.last) refuse(stretch.first);
  for (const double time : config.at)
    if (time < 0.0 || time > stretch.last + 0.5 / motions[0].fps) refuse(time);
  return stretch;
}

List<double> moments_of(const List<PosedMotion>& motions, const PictureConfig& config) {
  const TimeSpan stretch = common_stretch(motions, config);
  if (!config.at.empty()) {
    List<double> moments = config.at;
    std::sort(moments.begin(), moments.end());
    return moments;
  }
  if (config.kind == Kind::kStill) return {telling_moment(motions[0], stretch)};
  if (config.kind != Kind::kAnimation) return even_moments(stretch, config.moments);
  List<double> moments;
  for (int k = 0; stretch.first + k / config.rate <= stretch.last + 1e-9; ++k)
    moments.push_back(stretch.first + k / config.rate);
  return moments;
}

/// The middle of all pelvises at a moment, on the floor.
Vector3d middle_at(const List<PosedMotion>& motions, double time) {
  Vector3d middle = Vector3d::Zero();
  for (const PosedMotion& p : motions)
    middle += p.poses[p.frame_at(time)].p_WB[kPelvis] / static_cast<double>(motions.count());
  return {middle.x(), middle.y(), 0.0};
}

/// Points around the body, and that on the floor below it: to the six sides of its capsules' ends.
void add_outline(const PosedMotion& motion, double time, const Vector3d& origin, List<Vector3d>& points) {
  const BodyPoses& poses = motion.poses[motion.frame_at(time)];
  const Vector3d pelvis = poses.p_WB[kPelvis];
  points.push_back(Vector3d(pelvis.x(), pelvis.y(), 0.0) - origin);
  for (const Capsule& c : motion.character.capsule)
    for (const Vector3d& end : {c.a_B, c.b_B})
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-c.radius, c.radius})
          points.push_back(poses.p_WB[c.body] + poses.q_WB[c.body] * end + side * Vector3d::Unit(axis) -
                           origin);
}

class Planner {
 public:
  Planner(const List<PosedMotion>& motions, const PictureConfig& config)
      : motions_(motions), config_(config), moments_(moments_of(motions, config)) {
    const double heading = heading_angle(motions[0].poses[0].q_WB[kPelvis]);
    look_.azimuth = heading - config.view * std::numbers::pi / 180.0;
    for (const double time : moments_)
      for (const PosedMotion& p : motions_) add_outline(p, time, origin_at(time), points_);
    columns_ = is_beside(config.kind) ? motions.count() : config.kind == Kind::kStrip ? moments_.count() : 1;
    rows_ = is_beside(config.kind) ? 1 : motions.count();
    size_ = config.size ? *config.size : natural();
    if (cell_width() < kLeastCell || cell_height() < kLeastCell)
      throw std::invalid_argument("a picture of " + std::to_string(columns_) + " x " + std::to_string(rows_) +
                                  " cells does not fit into " + std::to_string(size_.width) + " x " +
                                  std::to_string(size_.height) + " pixels");
    camera_ = render::framing(points_, look_, {cell_width(), cell_height(), 0.4 * margin(), margin()});
  }

  Layout layout() const {
    Layout out{size_, moments_, {}};
    if (config_.kind == Kind::kAnimation)
      for (const double time : moments_) out.pages.push_back(page({time}));
    else
      out.pages.push_back(page(moments_));
    return out;
  }

 private:
  /// Origin of the camera's position.
  Vector3d origin_at(double time) const {
    return config_.kind == Kind::kStrip ? middle_at(motions_, time) : Vector3d(Vector3d::Zero());
  }

  Size natural() const {
    const NaturalSize cell = natural_size(config_.kind);
    size_.height = rows_ * (cell.height + kGap) - kGap;  // margin() follows from it
    const double wide = render::aspect_of(points_, look_) * (cell.height - 2.0 * margin()) + 0.8 * margin();
    const int width = std::clamp(static_cast<int>(wide), cell.least_width, cell.most_width);
    return {columns_ * (width + kGap) - kGap, size_.height};
  }

  int cell_width() const { return (size_.width + kGap) / columns_ - kGap; }
  int cell_height() const { return (size_.height + kGap) / rows_ - kGap; }
  double text_height() const { return std::clamp(0.032 * cell_height(), 7.0, 18.0); }
  /// Above and below the bodies, where the notes stand.
  double margin() const { return std::min(2.5 * text_height(), 0.2 * cell_height()); }

  Page page(const List<double>& moments) const {
    Page page{moments[0], {}, {}};
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const bool is_strip = config_.kind == Kind::kStrip;
        Cell cell{is_beside(config_.kind) ? column : row,
                  is_strip ? List<double>{moments[column]} : moments,
                  camera_,
                  column * (cell_width() + kGap),
                  row * (cell_height() + kGap),
                  cell_width(),
                  cell_height()};
        cell.camera.p_WC += origin_at(cell.moments[0]);
        page.cells.push_back(cell);
        if (column == 0 || is_beside(config_.kind)) page.notes.push_back(label_of(cell));
        if (row == rows_ - 1) page.notes.push_back(time_of(cell));
      }
    return page;
  }

  Note label_of(const Cell& cell) const {
    const double height = text_height(), right = is_beside(config_.kind) ? cell.x + cell.width : size_.width;
    return {motions_[cell.motion].label, cell.x + height, cell.y + 1.8 * height, height,
            right - cell.x - 2.0 * height};
  }

  Note time_of(const Cell& cell) const {
    const double height = 0.85 * text_height();
    const std::string until =
        config_.kind == Kind::kStroboscope ? " to " + in_seconds(cell.moments.back()) : std::string();
    return {in_seconds(cell.moments.front()) + until, cell.x + height, cell.y + cell.height - height, height,
            cell.width - 2.0 * height};
  }

  const List<PosedMotion>& motions_;
  const PictureConfig& config_;
  List<double> moments_;
  render::Look look_;
  List<Vector3d> points_;
  int columns_ = 1, rows_ = 1;
  mutable Size size_;
  render::Camera camera_;
};

}  // namespace

Layout lay_out(const List<PosedMotion>& motions, const PictureConfig& config) {
  if (motions.empty()) throw std::invalid_argument("lay_out: no motion to show");
  return Planner(motions, config).layout();
}

}  // namespace mimicx::picture

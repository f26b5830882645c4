#include "motion/keypoint_check.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/elementary.h"
#include "core/number_text.h"

namespace mimicx::motion {
namespace {

constexpr double kFarthest = 1e5;     ///< px from the corner of the picture
constexpr double kNormalised = 2.5;   ///< px; every person is larger
constexpr double kPixelFocal = 10.0;  ///< focal lengths above this are in pixels
constexpr double kPercent = 1.5;      ///< confidences above this are in percent
constexpr double kNoRotation = 0.01;  ///< largest deviation of RᵀR and of the scale

std::string number(double value) { return formatted("%.4g", value); }

template <class Each>
void for_each_detection(Keypoints& k, const Each& each) {
  for (auto& frame : k.uvc)
    for (Vector3d& uvc : frame)
      if (uvc.z() > 0.0) each(uvc);
}

void check_names(const std::string& path, const Keypoints& k) {
  std::set<std::string> seen;
  for (const std::string& name : k.names)
    if (!name.empty() && !seen.insert(name).second)
      throw DataError(path, "keypoint_names", std::to_string(k.names.size()) + " different names",
                      "'" + name + "' twice");
}

void check_confidences(const std::string& path, Keypoints& k, std::vector<std::string>& decisions) {
  double most = 0.0;
  int over = 0;
  for_each_detection(k, [&](const Vector3d& uvc) {
    most = std::max(most, uvc.z());
    over += uvc.z() > 1.0 ? 1 : 0;
  });
  if (over == 0) return;
  if (most > 100.0) throw DataError(path, "keypoints_2d", "confidences between 0 and 1", number(most));
  const bool percent = most > kPercent;
  for_each_detection(k, [&](Vector3d& uvc) { uvc.z() = percent ? uvc.z() / 100.0 : std::min(uvc.z(), 1.0); });
  decisions.push_back(percent ? "keypoints: confidences up to " + number(most) + ", taken for percent"
                              : "keypoints: " + std::to_string(over) +
                                    " confidences a little over 1, up to " + number(most) + ", taken for 1");
}

void check_pixels(const std::string& path, Keypoints& k, std::vector<std::string>& decisions) {
  int all = 0, far = 0;
  double farthest = 0.0;
  for_each_detection(k, [&](Vector3d& uvc) {
    const double reach = uvc.head<2>().cwiseAbs().maxCoeff();
    ++all;
    if (reach <= kFarthest) return;
    farthest = std::max(farthest, reach);
    ++far;
    uvc.setZero();
  });
  if (2 * far > all)
    throw DataError(path, "keypoints_2d", "pixels", "points " + number(farthest) + " px away");
  if (far > 0)
    decisions.push_back("keypoints: " + std::to_string(far) + " points up to " + number(farthest) +
                        " px away, taken for not detected");
  double reach = 0.0;
  for_each_detection(
      k, [&](const Vector3d& uvc) { reach = std::max(reach, uvc.head<2>().cwiseAbs().maxCoeff()); });
  if (all > far && reach < kNormalised && k.intrinsics(0, 0) > kPixelFocal)
    throw DataError(
        path, "keypoints_2d", "pixels, as the focal length is",
        "coordinates up to " + number(reach) + " (multiply them by the picture's width and height)");
}

void tell_none(Keypoints& k, std::vector<std::string>& decisions) {
  bool any = false;
  for_each_detection(k, [&](const Vector3d&) { any = true; });
  if (!any)
    decisions.emplace_back("keypoints: none is detected (no confidence is over 0), so they cannot be fitted");
}

void check_intrinsics(const std::string& path, const Keypoints& k) {
  const Matrix3d& K = k.intrinsics;
  const double fx = K(0, 0), fy = K(1, 1);
  if (!(fx > 0.0 && fy > 0.0))
    throw DataError(path, "camera_intrinsics", "focal lengths over 0", number(fx) + " and " + number(fy));
  if (K(1, 0) != 0.0 || K(2, 0) != 0.0 || K(2, 1) != 0.0 || K(2, 2) != 1.0)
    throw DataError(path, "camera_intrinsics", "rows (fx s cx), (0 fy cy), (0 0 1)",
                    "a last row of " + number(K(2, 0)) + " " + number(K(2, 1)) + " " + number(K(2, 2)));
}

void check_extrinsics(const std::string& path, const Keypoints& k) {
  for (int t = 0; t < k.extrinsics.count(); ++t) {
    const Eigen::Matrix4d& E = k.extrinsics[t];
    const std::string place =
        k.extrinsics.size() > 1 ? "camera_extrinsics, frame " + std::to_string(t) : "camera_extrinsics";
    const auto fail = [&](const std::string& found) {
      throw DataError(path, place, "a rotation and a translation, world to camera", found);
    };
    const Matrix3d R = E.topLeftCorner<3, 3>();
    const double volume = R.determinant(), scale = pow(std::abs(volume), 1.0 / 3.0);
    if ((E.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > kNoRotation)
      fail("a last row that is not 0 0 0 1 (a transposed matrix?)");
    if (!(scale > 0.0) ||
        ((R.transpose() * R) / (scale * scale) - Matrix3d::Identity()).cwiseAbs().maxCoeff() > kNoRotation)
      fail("other axes than right angles");
    if (volume < 0.0) fail("a mirrored camera");
    if (std::abs(scale - 1.0) > kNoRotation) fail("a rotation scaled by " + number(scale));
  }
}

}  // namespace

void check_keypoints(const std::string& path, Keypoints& keypoints, std::vector<std::string>& decisions) {
  check_names(path, keypoints);
  check_intrinsics(path, keypoints);
  check_extrinsics(path, keypoints);
  check_confidences(path, keypoints, decisions);
  check_pixels(path, keypoints, decisions);
  tell_none(keypoints, decisions);
}

}  // namespace mimicx::motion

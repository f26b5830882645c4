/// Markers of a clip's person, the way a motion capture has them.
#pragma once

#include <cstdio>
#include <string>

#include "character/bodies.h"
#include "import/opensim/markers.h"
#include "import/world_transform.h"
#include "motion/clip.h"

namespace mimicx::test {

/// y up, metres. Hips are where Harrington's regression puts them; lateral and medial markers ("R.Knee",
/// "R.Knee.Med") are 5 cm beside knees and ankles, three markers each on thigh, shank and foot.
inline import::Markers markers_of(const motion::Clip& clip) {
  const Quaterniond to_y_up = import::rotation_to_z_up('y').conjugate();
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  import::Markers markers;
  markers.path = "made.trc";
  markers.fps = clip.fps;
  const auto add = [&](const std::string& name, const auto& place) {
    markers.names.push_back(name);
    import::Track& track = markers.tracks.emplace_back();
    for (const BodyPoses& pose : poses) track.push_back(to_y_up * place(pose));
  };
  const auto on = [](int body, const Vector3d& offset) {
    return [=](const BodyPoses& pose) { return Vector3d(pose.p_WB[body] + pose.q_WB[body] * offset); };
  };
  // By the regression: half the distance of the hips is 0.33 width + 7.3 mm.
  const Vector3d left_hip = poses[0].q_WB[0].conjugate() * (poses[0].p_WB[kLeftHip] - poses[0].p_WB[0]),
                 right_hip = poses[0].q_WB[0].conjugate() * (poses[0].p_WB[kRightHip] - poses[0].p_WB[0]);
  const Vector3d hips = 0.5 * (left_hip + right_hip), out = (left_hip - right_hip).normalized();
  const double width = (0.5 * (left_hip - right_hip).norm() - 0.0073) / 0.33, depth = 0.2;
  const Vector3d ahead = Vector3d::UnitZ() - out.z() * out, forward = ahead.normalized(),
                 up = forward.cross(out);
  const Vector3d front = hips + (0.24 * depth + 0.0099) * forward + (0.30 * width + 0.0109) * up;
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0.0 ? "L." : "R.";
    const int right = side > 0.0 ? 0 : 1;
    const Vector3d beside(0.05 * side, 0.0, 0.0);
    add(name + "ASIS", on(kPelvis, front + 0.5 * width * side * out));
    add(name + "PSIS", on(kPelvis, front - depth * forward + 0.04 * side * out));
    add(name + "Knee", on(kLeftKnee + right, beside));
    add(name + "Knee.Med", on(kLeftKnee + right, -beside));
    add(name + "Ankle", on(kLeftAnkle + right, beside));
    add(name + "Ankle.Med", on(kLeftAnkle + right, -beside));
    for (const auto& [segment, body] :
         {std::pair("Thigh.", kLeftHip + right), {"Shank.", kLeftKnee + right}}) {
      add(name + segment + "Upper", on(body, {0.08 * side, -0.1, 0.0}));
      add(name + segment + "Front", on(body, {0.05 * side, -0.25, 0.06}));
      add(name + segment + "Rear", on(body, {0.05 * side, -0.25, -0.05}));
    }
    add(name + "Heel", on(kLeftAnkle + right, {0.0, -0.04, -0.06}));
    add(name + "Toe.Med", on(kLeftFoot + right, -0.8 * beside));
    add(name + "Toe.Lat", on(kLeftFoot + right, 0.8 * beside));
    add(name + "Acromion", [=](const BodyPoses& pose) {
      const Vector3d shoulders = 0.5 * (pose.p_WB[kLeftShoulder] + pose.p_WB[kRightShoulder]),
                     middle = 0.5 * (pose.p_WB[kLeftHip] + pose.p_WB[kRightHip]);
      return Vector3d(pose.p_WB[kLeftShoulder + right] +
                      0.17 * (pose.p_WB[kLeftShoulder] - pose.p_WB[kRightShoulder]).norm() *
                          (shoulders - middle).normalized());
    });
    add(name + "Elbow", on(kLeftElbow + right, Vector3d::Zero()));
    add(name + "Wrist", on(kLeftWrist + right, Vector3d::Zero()));
  }
  return markers;
}

/// @param unit  of the file: "mm" or "m"
inline std::string format_trc(const import::Markers& markers, const std::string& unit = "mm") {
  const std::size_t frames = markers.tracks[0].size();
  char cell[64];
  std::string text =
      "PathFileType\t4\t(X/Y/Z)\tmade.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n";
  std::snprintf(cell, sizeof cell, "%g\t%g\t%zu\t%zu\t", markers.fps, markers.fps, frames,
                markers.names.size());
  text += cell + unit + "\nFrame#\tTime";
  for (const std::string& name : markers.names) text += '\t' + name + "\t\t";
  text += "\n\t";
  for (std::size_t i = 1; i <= markers.names.size(); ++i)
    for (const char axis : {'X', 'Y', 'Z'}) text += '\t' + (axis + std::to_string(i));
  text += "\n\n";
  for (std::size_t t = 0; t < frames; ++t) {
    std::snprintf(cell, sizeof cell, "%zu\t%.6f", t + 1, static_cast<double>(t) / markers.fps);
    text += cell;
    for (const import::Track& track : markers.tracks)
      for (int axis = 0; axis < 3; ++axis) {
        const double value = track[static_cast<int>(t)][axis] * (unit == "mm" ? 1000.0 : 1.0);
        std::snprintf(cell, sizeof cell, std::isfinite(value) ? "\t%.9f" : "\t", value);
        text += cell;
      }
    text += '\n';
  }
  return text;
}

}  // namespace mimicx::test

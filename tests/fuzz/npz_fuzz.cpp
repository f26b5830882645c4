// Target: archives: zip directory, members, and the motion in them.
#include "fuzz/driver.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"

namespace mimicx::fuzz::npz {

std::vector<std::string> seeds() {
  motion::Clip clip = test::random_clip(1, 3, 0.3);
  const std::string plain = format_npz(motion::to_npz(clip));
  motion::Keypoints k;
  k.names = {"left_hip", "nose"};
  k.uvc.assign(3, {Vector3d(1, 2, 0.5), Vector3d(3, 4, 0)});
  k.extrinsics.assign(1, Eigen::Matrix4d::Identity());
  clip.keypoints = k;
  clip.body_model = "smplx";
  clip.passthrough.emplace_back("pose_hand", from_matrix(Eigen::MatrixXd::Zero(3, 90)));
  Npz people;  // of two people, under other names
  people.set("global_orient", NpyArray::from_double({2, 1, 3}, std::vector<double>(6, 0.5).data()));
  people.set("body_pose", NpyArray::from_double({2, 1, 63}, std::vector<double>(126, 0.1).data()));
  people.set("transl", NpyArray::from_double({2, 1, 3}, std::vector<double>(6, 1.0).data()));
  people.set("fps", NpyArray::scalar(30.0));
  return {plain, format_npz(motion::to_npz(clip)), format_npz(Npz{}), format_npz(people)};
}

void feed(const std::string& bytes) {
  try {
    import::ReadConfig config;
    if (bytes.size() % 2 == 1) config.fps = 30.0, config.person = 1;
    import::motion_from(bytes, "fuzz.npz", config);
  } catch (const DataError&) {
  }
}

const Target target("npz", seeds, feed);

}  // namespace mimicx::fuzz::npz

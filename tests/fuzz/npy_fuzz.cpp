// Target: arrays: as a Motion-X file, and as each member of an archive with valid zip checksums.
#include "fuzz/driver.h"
#include "import/motion_file.h"
#include "import/motionx.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"

namespace mimicx::fuzz::npy {

std::vector<std::string> seeds() {
  motion::Clip clip = test::random_clip(1, 3, 0.3);
  clip.body_model = "smplx";
  const Eigen::MatrixXf floats = to_matrix(import::to_motionx(clip)).cast<float>();
  return {format_npy(import::to_motionx(clip)), format_npy(motion::to_npz(clip).at("poses")),
          format_npy(motion::to_npz(clip).at("betas")), format_npy(motion::to_npz(clip).at("joint_names")),
          format_npy(NpyArray::from_float({3, 322}, floats.data()))};
}

void feed(const std::string& bytes) {
  try {
    import::motion_from(bytes, "fuzz.npy");
  } catch (const DataError&) {
  }
  try {
    const NpyArray array =
        parse_npy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "fuzz.npy", "");
    const Npz sound = motion::to_npz(test::random_clip(1, 3, 0.3));
    for (const char* member : {"poses", "trans", "betas", "mocap_framerate", "joint_names", "body_model",
                               "keypoints_2d", "rest_joints", "gender"}) {
      Npz npz = sound;
      npz.set(member, array);
      try {
        motion::to_npz(motion::clip_from(npz, "fuzz"));
      } catch (const DataError&) {
      }
    }
  } catch (const DataError&) {
  }
}

const Target target("npy", seeds, feed);

}  // namespace mimicx::fuzz::npy

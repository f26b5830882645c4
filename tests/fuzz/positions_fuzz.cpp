// Target: joint positions (T, 22, 3) and HumanML3D's features (T, 263): read, turned into rotations and
// retargeted.
#include "core/npz/npy.h"
#include "fuzz/driver.h"
#include "import/motion_file.h"
#include "import/positions.h"
#include "motion/made_motions.h"

namespace mimicx::fuzz::positions {

std::vector<std::string> seeds() {
  const NpyArray positions = test::positions_of(test::random_clip(1, 3, 0.3)),
                 features = test::features_of(positions),
                 one_frame = test::positions_of(test::standing_clip(1, 0.9), 100.0);
  const Eigen::MatrixXf floats = to_matrix(positions).cast<float>();
  const std::vector<std::string> seeds = {
      format_npy(positions), format_npy(features), format_npy(one_frame),
      format_npy(NpyArray::from_float(positions.shape, Eigen::MatrixXf(floats.transpose()).data()))};
  for (const std::string& seed : seeds) import::motion_from(seed, "seed.npy");  // each is read
  return seeds;
}

void feed(const std::string& bytes) {
  try {
    import::motion_from(bytes, "fuzz.npy");
  } catch (const DataError&) {
  }
}

const Target target("positions", seeds, feed);

}  // namespace mimicx::fuzz::positions

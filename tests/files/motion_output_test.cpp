#include "files/motion_output.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "import/motion_file.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"

namespace mimicx::files {
namespace {

// A person who lies is turned upright where the axes are detected.
TEST(WriteInput, AMotionOfAnotherBodyIsReadAsItWas) {
  TemporaryFolder folder;
  motion::Clip lying = motion::standing_clip(20);
  import::rotate_world(import::rotation_to_z_up('y').conjugate(), lying);
  lying.body_model = "smplx";
  write_input(folder.path / "a.npz", lying);
  const motion::Clip back = import::read_motion(folder.path / "a.npz");
  EXPECT_EQ(back.rotations, lying.rotations);
  EXPECT_EQ(back.trans, lying.trans);
}

TEST(WriteInput, AMotionOfOurBodyHasOnlyTheUsualMembers) {
  TemporaryFolder folder;
  const motion::Clip clip = motion::standing_clip(20);
  write_input(folder.path / "a.npz", clip);
  motion::write_clip(folder.path / "b.npz", clip);
  EXPECT_EQ(read_file(folder.path / "a.npz"), read_file(folder.path / "b.npz"));
}

}  // namespace
}  // namespace mimicx::files

/// Target: BVH text, read and retargeted.
#include "core/error.h"
#include "fuzz/driver.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"

namespace mimicx::fuzz::bvh {
namespace {

/// A small clip of the 22 bodies, which also exercises names, calibration and solving.
motion::Clip small_clip() {
  motion::Clip clip;
  for (int t = 0; t < 3; ++t) {
    auto& rotations = clip.rotations.emplace_back();
    rotations.fill(Vector3d::Zero());
    rotations[kLeftKnee] = {0.1 * t, 0, 0};
    rotations[kPelvis] = {1.57, 0, 0};
    clip.trans.emplace_back(0.01 * t, 0, 0.9);
  }
  return clip;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string small =
      "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Yrotation Xrotation\n"
      "\tJOINT Chest\n\t{\n\t\tOFFSET 0 10 0\n\t\tCHANNELS 3 Zrotation Yrotation Xrotation\n\t\tEnd "
      "Site\n\t\t{\n"
      "\t\t\tOFFSET 0 1 0\n\t\t}\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n1 2 3 4 5 6 7 8 9\n9 8 7 6 5 4 "
      "3 2 1\n";
  std::string foreign = import::format_bvh(small_clip());
  for (std::size_t at = 0; (at = foreign.find("OFFSET 0.0", at)) != std::string::npos; at += 8)
    foreign.replace(at, 10, "OFFSET 0.1");  // no longer this program's own skeleton
  std::string nameless = foreign, crowd = small;
  for (const char* word : {"hip", "knee", "ankle", "shoulder", "elbow", "wrist"})  // matched by the shape
    for (std::size_t at = 0; (at = nameless.find(word, at)) != std::string::npos;)
      nameless.replace(at, 2, "xx");
  crowd.replace(crowd.find("MOTION"), 6, "ROOT Ball\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\nMOTION");
  return {small, import::format_bvh(small_clip()), foreign, nameless, crowd};
}

void feed(const std::string& bytes) {
  try {
    import::ReadConfig config;
    if (bytes.size() % 2 == 1) config.fps = 30.0;  // stands in for any frame time
    import::motion_from(bytes, "fuzz.bvh", config);
  } catch (const DataError&) {
  }
}

const Target target("bvh", seeds, feed);

}  // namespace mimicx::fuzz::bvh

#include "files/exchange/qpos.h"

#include "files/archive_members.h"
#include "motion/prepare/hinge.h"
#include "physics/mjcf.h"

namespace mimicx::files {

void write_qpos(const std::filesystem::path& path, const motion::Clip& clip) {
  const auto q = motion::to_hinges(motion::character_of(clip), motion::joint_rotations(clip));
  const Vector3d pelvis = rest_pelvis(clip);
  const PerBody<int> order = physics::mjcf_order();
  std::vector<double> qpos;
  for (std::size_t t = 0; t < q.size(); ++t) {
    append(Vector3d(clip.trans[t] + pelvis), qpos);
    append(q[t][kPelvis], qpos);
    for (const int body : order) {
      if (body == kPelvis) continue;
      const Quaterniond& joint = q[t][body];
      if (is_hinge(body))
        qpos.push_back(log_map(joint).dot(hinge_axis(body)));
      else
        append(joint, qpos);
    }
  }
  std::vector<std::string> names;
  for (const int body : order)
    if (body != kPelvis) names.emplace_back(kBodyNames[body]);
  Npz npz;
  npz.set("qpos", NpyArray::from_double({q.size(), kQpos}, qpos.data()));
  npz.set("fps", NpyArray::scalar(clip.fps));
  npz.set("joint_names", NpyArray::from_text(names));
  write_npz(path, npz);
}

}  // namespace mimicx::files

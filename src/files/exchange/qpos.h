/// A motion for MuJoCo: qpos per frame, for the model that `mimicx export-mjcf` writes of the same body.
///
/// Members of the npz: `qpos` (T, 79), `fps`, `joint_names` (21,) in MuJoCo's order. MuJoCo lists joints
/// depth first, children in the order of `Body`. A row: pelvis in the world (m), its rotation (w x y z); then
/// per joint 4 numbers of a ball (w x y z, relative to the parent) or 1 of a hinge (rad, positive flexes).
/// Knees and elbows are re-solved as hinges first, as preparation does (reference.h).
///
///     import mujoco, numpy; m = mujoco.MjModel.from_xml_path("body.xml"); d = mujoco.MjData(m)
///     for q in numpy.load("walk.qpos.npz")["qpos"]: d.qpos = q; mujoco.mj_forward(m, d)
///
/// What it does not do: no velocities; the simulator's own are in a run's substeps.
#pragma once

#include <filesystem>

#include "motion/clip.h"

namespace mimicx::files {

inline constexpr std::size_t kQpos = 7 + 17 * 4 + 4;

void write_qpos(const std::filesystem::path& path, const motion::Clip& clip);

}  // namespace mimicx::files

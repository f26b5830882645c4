/// The motion a simulated character is asked to follow: prepared, at 30 fps, in the simulator's coordinates.
///
/// Generalised coordinates and velocities are those of physics/model.h: joint rotations relative to the
/// parent, joint angular velocities in the child's frame, root position and linear velocity of the pelvis
/// joint in the world, root angular velocity in the pelvis frame.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx {

struct ReferenceFrame {
  Vector3d p_root = Vector3d::Zero();  ///< pelvis joint in world, m
  Vector3d v_root = Vector3d::Zero();  ///< its velocity in world, m/s
  PerBody<Quaterniond>
      q;  ///< [0] root in world; joints relative to the parent; hinges exactly about their axis
  PerBody<Vector3d> omega;  ///< [0] root; joints relative to the parent; in the body's own frame, rad/s
};

struct Reference {
  std::string name;
  double fps = 30.0;
  Character character;
  std::vector<ReferenceFrame> frames;
  std::vector<BodyPoses> poses;        ///< forward kinematics of every frame
  std::vector<bool> flagged;           ///< frames whose input was implausible and has been bridged
  std::optional<Keypoints> keypoints;  ///< at the reference's frames

  int size() const { return static_cast<int>(frames.size()); }
};

/// What preparation did to a clip; every figure goes into the manifest.
struct PreparationReport {
  double floor_shift_mm = 0;      ///< static height added to put the motion on the floor
  double max_floor_shift_mm = 0;  ///< largest per-frame height change, static part included
  double hinge_residual_mean_mm = 0, hinge_residual_max_mm = 0;  ///< METHOD §2
  double change_mean_mm = 0,
         change_max_mm = 0;   ///< of joint positions against the input (both on the standard skeleton)
  double foot_level_deg = 0;  ///< largest constant rotation that levelled a sole or toes (motion/feet.h)
  int flagged_frames = 0;
  std::vector<std::string> notes;
};

struct PreparationOptions {
  double fps = 30.0;
  bool level_feet = true;      ///< remove a constant error in the pitch and roll of standing feet
  bool ground = true;          ///< align with the floor
  bool bridge_flagged = true;  ///< interpolate over implausible frames
};

/// Resample, convert hinges, level the feet, align with the floor, flag and bridge implausible frames,
/// differentiate.
/// @throws DataError for fewer than 2 frames or non-finite values.
Reference prepare_reference(const Clip& clip, const PreparationOptions& options, PreparationReport* report);

/// Velocities of `frames` by central differences on the rotation group; frames[i].q and p_root must be set.
void differentiate(std::vector<ReferenceFrame>& frames, double fps);

/// SMPL rotations → joint rotations whose knees and elbows are hinges: the parent's rotation and the hinge
/// angle are re-solved so that upper and lower bone point exactly the same way, the child keeps its world
/// orientation. METHOD §2. Ankles and wrists stay in place for every limb the hinge can reach; towards a
/// straight limb (under 30°) the parent's twist is blended with SMPL's own, which moves the knee or elbow
/// by millimetres and keeps the motion continuous. Joints that are hinges already stay as they are.
/// @param smpl  [frames][22] joint rotations (entry 0: root in world)
std::vector<PerBody<Quaterniond>> to_hinges(const Character& character,
                                            const std::vector<PerBody<Quaterniond>>& smpl);

/// Simulated or prepared motion → clip in our layout (axis-angle, trans of body model "mimicx").
Clip to_clip(const std::string& name, double fps, const Character& character,
             const std::vector<Vector3d>& p_root, const std::vector<PerBody<Quaterniond>>& q);

}  // namespace mimicx

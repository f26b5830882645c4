/* mimicx for programs in C, and in languages that call C (python/mimicx.py). docs/c_interface.md
 *
 *     mimicx_motion* motion = mimicx_motion_new();
 *     mimicx_motion_read(motion, bytes, size, "clip.bvh");
 *     if (mimicx_motion_clean(motion, NULL, NULL) != MIMICX_OK) puts(mimicx_motion_error(motion));
 *     mimicx_array torques;
 *     mimicx_motion_array(motion, "joint_torques", &torques);
 *
 * Units: m, s, rad, N, N m. World axes: z up. Rotations: quaternions w, x, y, z. A body is one of 22
 * (mimicx_body_name). A handle may be used by one thread at a time; several threads may each use their own. A
 * function that takes a handle leaves the text of its error in it. No function ends the program or throws.
 */
#ifndef MIMICX_H
#define MIMICX_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__) && defined(MIMICX_BUILDS_LIBRARY)
#define MIMICX_API __attribute__((visibility("default"), used))
#else
#define MIMICX_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Changes where a program that was compiled with an older header would go wrong. It is the number in the
 * library's file name, libmimicx.so.1. */
#define MIMICX_ABI 1

#define MIMICX_BODIES 22

typedef enum {
  MIMICX_OK = 0,
  MIMICX_FAILED = 1,       /* the error says why; the handle is as it was */
  MIMICX_NOT_FOLLOWED = 2, /* a motion was made, but the body lost the reference: the error says where */
  MIMICX_STOPPED = 3       /* by the progress function; the handle is as it was */
} mimicx_status;

/* Numbers that belong to a handle, in C order, or that are given to it. */
typedef struct {
  void* data;
  char type[8];       /* as NumPy names it: "<f8", "<f4", "<i8", "<i4", "|u1", "|b1" */
  int32_t dimensions; /* 0 to 4 */
  int64_t shape[4];
} mimicx_array;

typedef struct mimicx_motion mimicx_motion;
typedef struct mimicx_simulator mimicx_simulator;

/* MIMICX_ABI of the library. */
MIMICX_API int mimicx_abi(void);
/* "0.1.0 (commit)" */
MIMICX_API const char* mimicx_version(void);
/* "left_knee"; NULL beyond 0 ... 21 */
MIMICX_API const char* mimicx_body_name(int body);
/* The body that carries this one; -1 for the pelvis. */
MIMICX_API int mimicx_body_parent(int body);

/* ---- Motions ---- */

/* An empty motion; NULL without memory. */
MIMICX_API mimicx_motion* mimicx_motion_new(void);
MIMICX_API void mimicx_motion_free(mimicx_motion* motion);
/* Of the last call that did not return MIMICX_OK; "" before. Valid until the next call. */
MIMICX_API const char* mimicx_motion_error(const mimicx_motion* motion);

/* Changes how the next motion is read and cleaned.
 * @param name   threads, fit (0 or 1), as_is (0 or 1), limit_seconds; up (x, y, z, -x, -y, -z), scale, fps,
 * floor, mass, height, body (file or standard), root, person, as the program's options; scene; or a setting
 * that `mimicx config` lists for plans and the simulation
 * @param value  as on the command line; of a scene its JSON (docs/scenes.md), or auto: found before cleaning
 */
MIMICX_API mimicx_status mimicx_motion_set(mimicx_motion* motion, const char* name, const char* value);

/* Reads the bytes of a file of any format that the program reads. @param name  of the file; its suffix counts
 */
MIMICX_API mimicx_status mimicx_motion_read(mimicx_motion* motion, const void* bytes, size_t size,
                                            const char* name);
/* Gives the motion an array, which is copied, as a member of an .npz file (docs/formats.md): poses
 * [frames][66], trans [frames][3], betas [10], mocap_framerate, keypoints_2d [frames][points][3],
 * camera_intrinsics [3][3], camera_extrinsics [4][4] ... The first one after a motion was read or cleaned
 * begins a new motion. It is read when it is needed. */
MIMICX_API mimicx_status mimicx_motion_put(mimicx_motion* motion, const char* member,
                                           const mimicx_array* array);
/* The same for texts: body_model (count 1), keypoint_names. */
MIMICX_API mimicx_status mimicx_motion_put_text(mimicx_motion* motion, const char* member,
                                                const char* const* texts, int count);

/* Told what is being done, several times a second, by one thread at a time, not always the caller's. Anything
 * but 0 stops the work. */
typedef int (*mimicx_progress)(const char* doing, void* user);

/* Fits the motion to its keypoints, where it has any, and plans it, as `mimicx plan` does; the motion then is
 * the simulated one. Works in a folder of its own in $TMPDIR, which it removes. @param progress  may be NULL
 */
MIMICX_API mimicx_status mimicx_motion_clean(mimicx_motion* motion, mimicx_progress progress, void* user);

/* An array of the motion, as named in docs/formats.md; of a cleaned one also joints, joint_torques,
 * ground_wrenches ... It is the handle's own and valid until the next call that changes the motion. */
MIMICX_API mimicx_status mimicx_motion_array(mimicx_motion* motion, const char* member, mimicx_array* array);
/* Names of all arrays, each followed by a line end; NULL if there is no motion. Valid until the next call. */
MIMICX_API const char* mimicx_motion_members(mimicx_motion* motion);
/* JSON: what was cleaned and how well, as the entry of manifest.json (docs/formats.md); NULL before. */
MIMICX_API const char* mimicx_motion_record(mimicx_motion* motion);
/* JSON, as `mimicx audit --json`: do the forces explain the motion? Could any? NULL for a failure. Valid
 * until the next call. */
MIMICX_API const char* mimicx_motion_audit(mimicx_motion* motion);
/* The bytes of the motion as a file. @param suffix  .npz, .npy, .bvh, .glb, .mot, .sto or .csv
 * @param bytes  gets the bytes, valid until the next call */
MIMICX_API mimicx_status mimicx_motion_write(mimicx_motion* motion, const char* suffix, const void** bytes,
                                             size_t* size);

/* ---- A simulated body, for controllers of one's own ---- */

/* A body that stands, its target to stand. @param betas  [10] its shape; NULL: the standard body
 * @return NULL without memory, or for a shape that is none */
MIMICX_API mimicx_simulator* mimicx_simulator_new(const double* betas);
MIMICX_API void mimicx_simulator_free(mimicx_simulator* simulator);
MIMICX_API const char* mimicx_simulator_error(const mimicx_simulator* simulator);
/* Changes a setting of the simulation by the name that `mimicx config` lists: friction, gravity, physics_rate
 * ... */
MIMICX_API mimicx_status mimicx_simulator_set(mimicx_simulator* simulator, const char* name, double value);
/* Puts the body back to where it stood at first. */
MIMICX_API mimicx_status mimicx_simulator_stand(mimicx_simulator* simulator);
/* clang-format off */
/* Numbers of the simulator, <f8, valid as long as it lives. Write to those of the first four lines to change them:
 *   root_position [3], root_velocity [3]            of the pelvis' joint, world
 *   rotations [22][4], spins [22][3]                of the pelvis in the world; of joints relative to the parent;
 *                                                   spins in the body's own frame, rad/s
 *   target_rotations [22][4], target_spins [22][3]  of the joints' PD controllers; entry 0 is not used
 *   push [6]                                        on the pelvis, about its joint: moment, force; world axes
 *   body_positions [22][3], body_rotations [22][4]  in the world
 *   joint_torques [22][3]                           means over the last call of step, in the child's frame
 *   ground_wrenches [22][6], self_contact_wrenches [22][6]  the same: moment about the body's joint, force; world */
/* clang-format on */
MIMICX_API mimicx_status mimicx_simulator_array(mimicx_simulator* simulator, const char* name,
                                                mimicx_array* array);
/* Does physics steps, 240 a second by default. MIMICX_FAILED: the numbers went wrong, and are those before
 * the call. */
MIMICX_API mimicx_status mimicx_simulator_step(mimicx_simulator* simulator, int steps);

#ifdef __cplusplus
}
#endif

#endif

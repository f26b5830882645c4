#!/usr/bin/env python3
"""Does Blender see the motion that we wrote?

    mimicx convert RUN/motions/walk.npz walk.bvh
    tools/check_blender.py walk.bvh RUN/motions/walk.npz

Imports the BVH file with Blender's own importer, in the background and without touching anybody's settings, and
compares with the npz of the same motion, which must hold `joints` (as the motions of a run do): the distance of
every joint to its parent, the frame rate, the number of frames, and the joints' places in the world in up to 50
frames. Exit status 0 when all agree, 1 when not, 77 where there is no Blender. Blender reckons in single precision.
"""
import os
import shutil
import subprocess
import sys

NO_BLENDER = 77
LENGTH_MM, PLACE_MM, RATE = 0.01, 0.1, 1e-4  # what may differ; the rate relatively
FRAMES = 50
PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19]


def run_in_blender(files):
    blender = shutil.which("blender")
    if blender is None:
        print("check_blender: no blender here, nothing checked")
        return NO_BLENDER
    command = [blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", os.path.abspath(__file__), "--"]
    return subprocess.run(command + files, check=False).returncode


def check(bvh, npz):
    """Inside Blender. @return whether everything agrees"""
    import bpy
    import numpy as np
    from io_anim_bvh import import_bvh

    # Debian's Blender 3.4 opens BVH files with mode "rU", which its Python 3.11 no longer knows.
    import_bvh.open = lambda path, mode: open(path, mode.replace("U", ""))
    with np.load(npz) as motion:
        names, joints, fps = list(motion["joint_names"]), motion["joints"], float(motion["mocap_framerate"])
    bpy.ops.import_anim.bvh(filepath=os.path.abspath(bvh), update_scene_fps=True)
    scene, armature = bpy.context.scene, bpy.context.object
    bones = armature.data.bones
    length_mm = max(1e3 * abs((bones[names[b]].head_local - bones[names[p]].head_local).length
                              - np.linalg.norm(joints[0, b] - joints[0, p]))
                    for b, p in enumerate(PARENTS) if p >= 0)
    place_mm = 0.0
    for t in sorted(set(np.linspace(0, len(joints) - 1, FRAMES).astype(int))):
        scene.frame_set(int(t) + 1)  # Blender counts from 1
        for b, name in enumerate(names):
            head = np.array(armature.matrix_world @ armature.pose.bones[name].head)
            place_mm = max(place_mm, 1e3 * np.linalg.norm(head - joints[t, b]))
    first, last = armature.animation_data.action.frame_range
    frames, rate = round(last - first) + 1, scene.render.fps / scene.render.fps_base
    print(f"check_blender: {len(bones)} bones, lengths within {length_mm:.4f} mm; {frames} frames of {len(joints)} "
          f"at {rate:.4f} fps of {fps:.4f}; places within {place_mm:.4f} mm")
    return length_mm < LENGTH_MM and place_mm < PLACE_MM and frames == len(joints) and abs(rate / fps - 1.0) < RATE


def main():
    inside = "bpy" in sys.modules
    files = sys.argv[sys.argv.index("--") + 1:] if inside else sys.argv[1:]
    if len(files) != 2:
        print("usage: tools/check_blender.py MOTION.bvh MOTION.npz", file=sys.stderr)
        return 2
    if not inside:
        return run_in_blender(files)
    return 0 if check(*files) else 1


if __name__ == "__main__":
    sys.exit(main())

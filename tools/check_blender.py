#!/usr/bin/env python3
"""Does Blender see the motion that we wrote?

    mimicx convert RUN/motions/walk.npz walk.bvh
    tools/check_blender.py walk.bvh RUN/motions/walk.npz
    mimicx convert RUN/motions/walk.npz walk.glb --arrows
    tools/check_blender.py walk.glb RUN/motions/walk.npz

Imports the file with Blender's own importer, in the background and without touching anybody's settings, and compares
with the npz of the same motion, which must hold `joints` (as the motions of a run do): the distance of every joint to
its parent, the frame rate, the number of frames, and the joints' places in the world in up to 50 frames. Of a glb
also the skin: every vertex must be where linear blending of the bones puts it. Exit status 0 when all agree, 1 when
not, 77 where there is no Blender. Blender reckons in single precision.
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


def import_bvh(path, fps):
    """@return the armature, the frame at which Blender has the first of the motion, its frames per second"""
    import bpy
    from io_anim_bvh import import_bvh as importer

    # Debian's Blender 3.4 opens BVH files with mode "rU", which its Python 3.11 no longer knows.
    importer.open = lambda path, mode: open(path, mode.replace("U", ""))
    bpy.ops.import_anim.bvh(filepath=path, update_scene_fps=True)
    scene = bpy.context.scene
    return bpy.context.object, 1, scene.render.fps / scene.render.fps_base  # Blender counts from 1


def import_glb(path, fps):
    """The same. glTF has times, not frames: the scene's own rate is told before."""
    import bpy
    import numpy as np

    # Debian's Blender 3.4 asks for np.bool, which its NumPy 1.24 no longer knows.
    if not hasattr(np, "bool"):
        np.bool = bool
    render = bpy.context.scene.render
    render.fps, render.fps_base = round(fps), round(fps) / fps
    bpy.ops.import_scene.gltf(filepath=path)
    return next(o for o in bpy.data.objects if o.type == "ARMATURE"), 0, render.fps / render.fps_base


def skin_mm(armature, body, at_rest):
    """How far the skin is from linear blending of the bones, as Blender has both now."""
    import bpy
    import numpy as np

    moved = {bone.name: np.array(armature.matrix_world @ bone.matrix @ bone.bone.matrix_local.inverted())
             for bone in armature.pose.bones}
    names = [group.name for group in body.vertex_groups]
    shown = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    worst = 0.0
    for vertex, rest, now in zip(body.data.vertices, at_rest, shown.data.vertices):
        place = sum(group.weight * (moved[names[group.group]] @ rest) for group in vertex.groups)
        worst = max(worst, 1e3 * np.linalg.norm(place[:3] - np.array(shown.matrix_world @ now.co)))
    return worst


def check(path, npz):
    """Inside Blender. @return whether everything agrees"""
    import bpy
    import numpy as np

    with np.load(npz) as motion:
        names, joints, fps = list(motion["joint_names"]), motion["joints"], float(motion["mocap_framerate"])
    is_glb = path.lower().endswith(".glb")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    armature, start, rate = (import_glb if is_glb else import_bvh)(os.path.abspath(path), fps)
    scene, bones = bpy.context.scene, armature.data.bones
    body = bpy.data.objects.get("body")
    at_rest = [np.array([*v.co, 1.0]) for v in body.data.vertices] if body else []
    length_mm = max(1e3 * abs((bones[names[b]].head_local - bones[names[p]].head_local).length
                              - np.linalg.norm(joints[0, b] - joints[0, p]))
                    for b, p in enumerate(PARENTS) if p >= 0)
    place_mm, blend_mm = 0.0, 0.0
    for n, t in enumerate(sorted(set(np.linspace(0, len(joints) - 1, FRAMES).astype(int)))):
        scene.frame_set(int(t) + start)
        for b, name in enumerate(names):
            head = np.array(armature.matrix_world @ armature.pose.bones[name].head)
            place_mm = max(place_mm, 1e3 * np.linalg.norm(head - joints[t, b]))
        if is_glb and n % 10 == 0:
            blend_mm = max(blend_mm, skin_mm(armature, body, at_rest))
    first, last = armature.animation_data.action.frame_range
    frames = round(last - first) + 1
    skin = f"; skin of {len(at_rest)} vertices within {blend_mm:.4f} mm" if is_glb else ""
    print(f"check_blender: {len(bones)} bones, lengths within {length_mm:.4f} mm; {frames} frames of {len(joints)} "
          f"at {rate:.4f} fps of {fps:.4f}; places within {place_mm:.4f} mm{skin}")
    return (length_mm < LENGTH_MM and place_mm < PLACE_MM and blend_mm < PLACE_MM and bool(at_rest) == is_glb
            and frames == len(joints) and abs(rate / fps - 1.0) < RATE)


def main():
    inside = "bpy" in sys.modules
    files = sys.argv[sys.argv.index("--") + 1:] if inside else sys.argv[1:]
    if len(files) != 2:
        print("usage: tools/check_blender.py MOTION.bvh|MOTION.glb MOTION.npz", file=sys.stderr)
        return 2
    if not inside:
        return run_in_blender(files)
    return 0 if check(*files) else 1


if __name__ == "__main__":
    sys.exit(main())

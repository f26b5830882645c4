#!/usr/bin/env python3
"""A set of `mimicx corrupt` or `synth` as other detectors and estimators would have left it: docs/experiments.md, "What
estimators write". Needs NumPy.

    vary_estimates.py KIND SET OUT        SET/noisy → OUT/noisy, the truth beside it; by KIND and file names alone

gapS         S seconds of detections, S seconds of none
half         every keypoint is missing half of the time, in stretches
upper        legs and pelvis are never seen
jitS         the told camera trembles: S degrees and 50 S mm, white
inc          the camera is what takes the motion in the world to the same motion in front of the camera (calibrated
             sets): with errors of 4 % (of one second) and 1 % (white) in depth, 1 and .3 degrees in orientation
incstatic    as convert_video_results.py --static makes it of the same
incslam      as convert_video_results.py --slam makes it, the told camera being SLAM's
"""
import glob
import os
import sys
import zlib

import numpy as np

from convert_video_results import J0, camera_path, matrices

LEGS = "hip", "knee", "ankle", "foot", "heel", "toe", "pelvis"
OTHER_WORLD = matrices(np.array([[0.3, -0.8, 0.5]]))[0]


def wandering(random, frames, tau, n):
    """Noise of variance 1 (frames, n) that forgets within tau frames."""
    rows, x, kept = [], random.normal(size=n), np.exp(-1 / tau)
    for _ in range(frames):
        rows.append(x)
        x = kept * x + np.sqrt(1 - kept * kept) * random.normal(size=n)
    return np.array(rows)


def without_detections(kind, random, points, names, fps):
    points, frames = points.copy(), len(points)
    if kind.startswith("gap"):
        seconds = float(kind[3:])
        points[(np.arange(frames) / fps + seconds / 2) // seconds % 2 == 1] = 0
    elif kind == "upper":
        points[:, [any(part in name for part in LEGS) for name in names]] = 0
    elif kind == "half":
        for k in range(points.shape[1]):
            points[wandering(random, frames, fps / 2, 1)[:, 0] > 0, k] = 0
    return points


def trembling(degrees, random, E):
    E = E.copy()
    E[:, :3, :3] = matrices(np.radians(degrees) * random.normal(size=(len(E), 3))) @ E[:, :3, :3]
    E[:, :3, 3] += 0.05 * degrees * random.normal(size=(len(E), 3))
    return E


def derived(kind, random, motion, truth, E, fps):
    """Cameras from a motion in the world and its estimate in front of the camera E."""
    frames = len(E)
    pelvis, root = motion["trans"] + J0["smplx"], matrices(motion["poses"][:, :3])
    depth = 0.04 * wandering(random, frames, fps, 1) + 0.01 * random.normal(size=(frames, 1))
    side = 0.01 * wandering(random, frames, fps / 3, 2) + 0.003 * random.normal(size=(frames, 2))
    seen = (np.einsum("tij,tj->ti", E[:, :3, :3], truth["trans"] + J0["smplx"]) + E[:, :3, 3]) * (1 + depth)
    seen[:, :2] += side
    error = matrices(np.radians(1.0) * wandering(random, frames, fps, 3)
                     + np.radians(0.3) * random.normal(size=(frames, 3)))
    turn = error @ E[:, :3, :3] @ root @ root.transpose(0, 2, 1)
    if kind == "incstatic":
        still = np.tile(np.eye(3), (frames, 1, 1)), np.zeros((frames, 3))
        return camera_path(turn, pelvis, seen, *still)[0]
    if kind == "incslam":
        back = E[:, :3, :3].transpose(0, 2, 1)
        place = -np.einsum("tij,tj->ti", back, E[:, :3, 3])
        return camera_path(turn, pelvis, seen, OTHER_WORLD @ back, 0.37 * place @ OTHER_WORLD.T + [1, 2, 3])
    out = np.tile(np.eye(4), (frames, 1, 1))
    out[:, :3, :3] = turn
    out[:, :3, 3] = seen - np.einsum("tij,tj->ti", turn, pelvis)
    return out


def main(kind, source, out):
    os.makedirs(out + "/noisy", exist_ok=True)
    if not os.path.exists(out + "/truth"):
        os.symlink(os.path.abspath(source + "/truth"), out + "/truth")
    for path in sorted(glob.glob(source + "/noisy/*.npz")):
        name = os.path.basename(path)
        motion, truth = dict(np.load(path)), np.load(source + "/truth/" + name)
        random, fps = np.random.default_rng(zlib.crc32((name + kind).encode())), float(motion["mocap_framerate"])
        E = np.broadcast_to(motion["camera_extrinsics"], (len(motion["poses"]), 4, 4))
        if kind.startswith("inc"):
            motion["camera_extrinsics"] = derived(kind, random, motion, truth, E, fps)
        elif kind.startswith("jit"):
            motion["camera_extrinsics"] = trembling(float(kind[3:]), random, E)
        else:
            motion["keypoints_2d"] = without_detections(kind, random, motion["keypoints_2d"],
                                                        motion["keypoint_names"], fps)
        np.savez(out + "/noisy/" + name, **motion)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])

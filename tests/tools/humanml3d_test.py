#!/usr/bin/env python3
"""HumanML3D's 263 features, made here in NumPy as the data set's published processing makes them, are read by `mimicx`
as the motion that they were made of.

    humanml3d_test.py MIMICX DATA

DATA holds motions (data/synthetic/train/truth). Of each, positions (T, 22, 3) and features (T - 1, 263)
at 20 fps are written and converted. Both must give one motion, but for where it begins and which way it faces there.

Source: Guo et al., "Generating Diverse and Natural 3D Human Motions from Text" (CVPR 2022), their process_file:
on the floor, begun at the origin and faced to z; per frame r, the turn of the root about y to the next frame (half the
angle), its step in x and z, its height; then joints, 6D rotations, velocities and contacts of the feet, all in the
root's heading. Exit status 77: no NumPy here, skipped.
"""
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

CLIPS = ("walk_turn_101", "turn_in_place_101", "walk_101")
LEFT_HIP, RIGHT_HIP, LEFT_SHOULDER, RIGHT_SHOULDER = 1, 2, 16, 17
FEET = ((7, 10), (8, 11))  # ankle and ball: left, right
FEET_THRESHOLD = 0.002
SAME_MM = 0.1  # the one rest of a difference: floats, and the floor


def about_y(angle):
    """Rotation matrices, [..., 3, 3]."""
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    return np.stack([np.cos(angle), zero, np.sin(angle), zero, one, zero, -np.sin(angle), zero, np.cos(angle)],
                    -1).reshape(*np.shape(angle), 3, 3)


def facing(p):
    """Angle from z to where the body faces, about y. [frames]"""
    across = (p[:, LEFT_HIP] - p[:, RIGHT_HIP]) + (p[:, LEFT_SHOULDER] - p[:, RIGHT_SHOULDER])
    forward = np.cross(across, [0.0, 1.0, 0.0])
    return np.unwrap(np.arctan2(forward[:, 0], forward[:, 2]))


def features(p):
    """@param p (T, 22, 3), y up, m. @return (T - 1, 263)"""
    p = p - [0.0, p[..., 1].min(), 0.0]
    p = (p - p[0, 0] * [1.0, 0.0, 1.0]) @ about_y(-facing(p)[0]).T
    to_heading = about_y(-facing(p))
    turn = -0.5 * np.diff(facing(p))  # r's rotations take the heading to z: they turn the other way
    step = np.einsum("tij,tj->ti", to_heading[1:], np.diff(p[:, 0], axis=0))
    local = np.einsum("tij,tbj->tbi", to_heading, p - p[:, :1] * [1.0, 0.0, 1.0])
    velocity = np.einsum("tij,tbj->tbi", to_heading[:-1], np.diff(p, axis=0))
    contacts = [(np.square(np.diff(p[:, foot], axis=0)).sum(-1) < FEET_THRESHOLD).astype(float) for foot in FEET]
    rotations = np.zeros((len(p) - 1, 126))  # what the reader leaves alone
    return np.concatenate([turn[:, None], step[:, [0]], step[:, [2]], p[:-1, 0, 1:2], local[:-1, 1:].reshape(-1, 63),
                           rotations, velocity.reshape(-1, 66), *contacts], axis=1)


def joints_of(mimicx, motion, scratch):
    """@return the 22 joints, z up, and the frames per second"""
    table = scratch / "joints.csv"
    subprocess.run([mimicx, "convert", motion, table], check=True, stderr=subprocess.DEVNULL)
    rows = np.genfromtxt(table, delimiter=",", skip_header=1)
    return rows[:, 1:67].reshape(-1, 22, 3), 1.0 / (rows[1, 0] - rows[0, 0])


def at_20_fps(joints, fps):
    """Joints in the published world, y up, at every 20th of a second."""
    times = np.arange(0.0, (len(joints) - 1) / fps, 1.0 / 20.0)
    columns = joints.reshape(len(joints), -1).T
    z_up = np.stack([np.interp(times * fps, np.arange(len(joints)), column) for column in columns], -1)
    return z_up.reshape(-1, 22, 3)[..., [1, 2, 0]]  # x forward, y left, z up there: z, x and y here


def read_back(mimicx, array, scratch):
    np.save(scratch / "motion.npy", array.astype(np.float32))
    return joints_of(mimicx, scratch / "motion.npy", scratch)


def apart_mm(a, b):
    """Largest distance of two motions after the turn about z and the shift between them."""
    a, b = a - a.mean((0, 1)), b - b.mean((0, 1))
    turn = np.arctan2((a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]).sum(), (a[..., :2] * b[..., :2]).sum())
    c, s = np.cos(turn), np.sin(turn)
    return 1000.0 * np.linalg.norm(a @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T - b, axis=-1).max()


def main():
    mimicx, data = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory(prefix="mimicx-humanml3d-") as name:
        scratch = pathlib.Path(name)
        for clip in CLIPS:
            positions = at_20_fps(*joints_of(mimicx, data / (clip + ".npz"), scratch))
            made = features(positions)
            from_features, fps = read_back(mimicx, made, scratch)
            from_positions, _ = read_back(mimicx, positions[:-1], scratch)
            apart = apart_mm(from_features, from_positions)
            print(f"{clip}: {len(made)} frames at {fps:g} fps, at most {apart:.4f} mm apart")
            if not (apart < SAME_MM and abs(fps - 20.0) < 1e-3 and len(from_features) == len(made)):
                sys.exit(f"{clip}: the features are read as another motion than the positions they were made of")


if __name__ == "__main__":
    main()

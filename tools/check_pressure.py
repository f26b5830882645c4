#!/usr/bin/env python3
"""Are the centres of pressure of a .mot those of the physics steps?

    mimicx plan walk.npz --substeps --out RUN
    mimicx convert RUN/motions/walk.npz walk.mot
    tools/check_pressure.py walk.mot RUN/substeps/walk.npz RUN/motions/walk.npz

The .mot knows means over the intervals between frames alone, and takes joint centres midway between the two. Here the
wrench of the floor on each foot is summed up over every physics step, with the joints where they are in that step.
Prints for both feet how far the two centres of pressure are apart, at the height where the .mot has it (stairs), while
the foot carries more than 20 N. Needs NumPy.
Exit status 1 where the mean is over 1 mm or a force differs.
"""
import sys

import numpy as np

PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19]
FEET = {"r": (8, 11), "l": (7, 10)}  # ankle and ball


def product(a, b):
    """Of quaternions w x y z."""
    w, v, u = a[:, :1], a[:, 1:], b[:, 1:]
    return np.hstack([w * b[:, :1] - np.sum(v * u, 1, keepdims=True), w * u + b[:, :1] * v + np.cross(v, u)])


def rotated(q, v):
    t = 2.0 * np.cross(q[:, 1:], v)
    return v + q[:, :1] * t + np.cross(q[:, 1:], t)


def joints_of(q, first_joints):
    """Places of the 22 joints in every state. @param first_joints  those of the first, which tell the bones"""
    turn, place = [q[:, 3:7]], [q[:, :3]]
    for body in range(1, 22):
        parent = turn[PARENTS[body]]
        bone = first_joints[body] - first_joints[PARENTS[body]]
        offset = rotated(parent[:1] * [1, -1, -1, -1], bone[None])
        place.append(place[PARENTS[body]] + rotated(parent, np.repeat(offset, len(q), 0)))
        turn.append(product(parent, q[:, 3 + 4 * body:7 + 4 * body]))
    return place


def read_mot(path):
    lines = [line.split("\t") for line in open(path, encoding="utf-8").read().splitlines()]
    head = lines.index(["endheader"]) + 1
    return dict(zip(lines[head], np.array(lines[head + 1:], float).T))


def main():
    if len(sys.argv) != 4:
        print("usage: tools/check_pressure.py MOTION.mot SUBSTEPS.npz MOTION.npz", file=sys.stderr)
        return 2
    mot = read_mot(sys.argv[1])
    with np.load(sys.argv[2]) as steps, np.load(sys.argv[3]) as motion:
        q, wrench, joints = steps["q"].astype(float), steps["ground_wrenches"].astype(float), motion["joints"]
    place = joints_of(q, joints[0])
    per_interval = len(wrench) // len(mot["time"])
    good = True
    for side, bodies in FEET.items():
        force = sum(wrench[:, b, 3:] for b in bodies)
        moment = sum(wrench[:, b, :3] + np.cross(place[b][:-1], wrench[:, b, 3:]) for b in bodies)
        force, moment = (x.reshape(-1, per_interval, 3).mean(1) for x in (force, moment))
        at = {k: mot[f"ground_force_{side}_p{k}"] for k in "xyz"}  # y: the height of what the foot stands on
        on = force[:, 2] > 20.0
        upward = np.where(on, force[:, 2], 1.0)
        x, y = ((at["y"] * force[:, 0] - moment[:, 1]) / upward, (moment[:, 0] + at["y"] * force[:, 1]) / upward)
        off = 1e3 * np.hypot(at["x"] - x, at["z"] + y)[on]
        wrong = np.abs(mot[f"ground_force_{side}_vy"] - force[:, 2]).max()
        mean, most = (off.mean(), off.max()) if len(off) else (0.0, 0.0)
        print(f"check_pressure: foot {side}, {len(off)} intervals: centre of pressure within {mean:.2f} mm in the mean, "
              f"{most:.2f} mm at most; force within {wrong:.4f} N")
        good = good and mean < 1.0 and wrong < 0.01
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""tools/picture.py on a body made here, which stands still with level soles: what is said of its feet, equal bytes.

    picture_test.py TOOL        exit status 77: no NumPy here, skipped
"""
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

TOOL = sys.argv[1]
FRAMES = 9
PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19]
OFFSETS = np.zeros((22, 3))  # legs straight down, the ball 5 cm below the ankle and 12 cm before it; y up
OFFSETS[[1, 2]] = (0.1, -0.1, 0), (-0.1, -0.1, 0)
OFFSETS[[4, 5, 7, 8]] = 0, -0.4, 0
OFFSETS[[10, 11]] = 0, -0.05, 0.12
OFFSETS[[3, 6, 9, 12, 15]] = 0, 0.1, 0
STANDING = 0.1 + 0.8 + 0.05 + 0.022  # the pelvis over the soles, m
WEIGHT = 600.0


def motion(height, name, joints=False):
    """A body that stands with its soles `height` m over the floor, y up turned to z up."""
    poses = np.zeros((FRAMES, 66))
    poses[:, 0] = np.pi / 2
    trans = np.tile((0.0, 0.0, STANDING + height - 0.3), (FRAMES, 1))
    members = {"poses": poses, "trans": trans, "mocap_framerate": 30.0}
    if joints:
        places = np.zeros((22, 3))
        places[0] = (0, 0, STANDING + height)
        for body in range(1, 22):
            x, y, z = OFFSETS[body]
            places[body] = places[PARENTS[body]] + (x, -z, y)
        members["joints"] = np.tile(places, (FRAMES, 1, 1))
        members["ground_wrenches"] = np.zeros((FRAMES, 22, 6))
        members["ground_wrenches"][:, [7, 8], 5] = WEIGHT / 2
    np.savez(name, **members)
    return name


def draw(height, out):
    subprocess.run([sys.executable, TOOL, motion(height, "before.npz"), motion(0.0, "after.npz", joints=True), out,
                    "--frames", "0,4,8"], check=True)
    with open(out, encoding="utf-8") as file:
        return file.read()


def check_heights_are_told():
    assert draw(0.07, "high.svg").count("7 cm in the air") == 3
    assert draw(-0.03, "deep.svg").count("3 cm too deep") == 3
    level = draw(0.0, "level.svg")
    assert "in the air" not in level and "too deep" not in level


def check_every_foot_that_carries_has_an_arrow():
    heads = [line for line in draw(0.0, "arrows.svg").splitlines() if 'Z" fill=' in line]
    assert len(heads) == 3 * 2, len(heads)


def check_equal_files_give_equal_bytes():
    assert draw(0.07, "one.svg") == draw(0.07, "two.svg")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for check in (check_heights_are_told, check_every_foot_that_carries_has_an_arrow, check_equal_files_give_equal_bytes):
        check()
        print(check.__name__, "ok")

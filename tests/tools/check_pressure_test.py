#!/usr/bin/env python3
"""tools/check_pressure.py on a body that stands on one foot on a plate, and is pushed sideways by it.

    check_pressure_test.py TOOL

Exit status 77: no NumPy here, skipped.
"""
import os
import sys
import tempfile

try:
    import numpy as np

    import python_program
except ImportError:
    sys.exit(77)

TOOL = os.path.abspath(sys.argv[1])
STEPS, INTERVALS, RIGHT_ANKLE, HEIGHT = 8, 2, 8, 0.3
POINT, FORCE = np.array([0.5, 0.2, HEIGHT]), np.array([40.0, -30.0, 600.0])


def write_motion():
    joints = np.random.default_rng(1).normal(size=(INTERVALS + 1, 22, 3))
    wrenches = np.zeros((STEPS, 22, 6))
    wrenches[:, RIGHT_ANKLE] = [*np.cross(POINT - joints[0, RIGHT_ANKLE], FORCE), *FORCE]  # about the joint
    body = [*joints[0, 0], *[1, 0, 0, 0] * 22]
    np.savez("steps.npz", q=np.tile(body, (STEPS + 1, 1)), ground_wrenches=wrenches)
    np.savez("motion.npz", joints=joints)


def write_mot(point):
    columns = {"time": 0.0}
    for side, force, place in (("r", FORCE, point), ("l", np.zeros(3), np.zeros(3))):
        columns |= {f"ground_force_{side}_v{k}": force[i] for k, i in zip("xyz", (0, 2, 1))}
        columns |= {f"ground_force_{side}_px": place[0], f"ground_force_{side}_py": place[2],
                    f"ground_force_{side}_pz": -place[1]}
    row = "\t".join(map(str, columns.values()))
    with open("walk.mot", "w", encoding="utf-8") as file:
        file.write("\n".join(["endheader", "\t".join(columns), *[row] * INTERVALS]) + "\n")


def check():
    return python_program.run(TOOL, "walk.mot", "steps.npz", "motion.npz")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    write_motion()
    write_mot(POINT)
    status, told, complaint = check()
    assert status == 0 and "foot r, 2 intervals: centre of pressure within 0.00 mm" in told, told + complaint
    assert "foot l, 0 intervals" in told, told + complaint
    write_mot(POINT + [0.0, 0.002, 0.0])
    status, told, complaint = check()
    assert status == 1 and "within 2.00 mm" in told, told + complaint
print("check_pressure_test: ok")

#!/usr/bin/env python3
"""check_world.py MIMICX MOTION... : how often preparation tells that the world of a motion is wrong.

Converts every motion, tilts copies of it by 10° to 45° about four horizontal axes, and changes their translation.
Prints, per motion, how many of the tilted copies are told, and which translations. NumPy alone.
"""
import concurrent.futures
import json
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

ANGLES = (0, 10, 15, 20, 30, 45)
TRAVELS = {"as it is": (1, 1, 1), "missing": (0, 0, 1), "turned round": (-1, -1, 1), "x mirrored": (-1, 1, 1),
           "times 2.54": (2.54,) * 3, "times 0.01": (0.01,) * 3}


def quaternion(rotation):  # of rotation vectors, w first
    half = np.linalg.norm(rotation, axis=-1, keepdims=True) / 2
    return np.concatenate([np.cos(half), np.sinc(half / np.pi) / 2 * rotation], -1)


def rotation_vector(q):
    q = np.where(q[..., :1] < 0, -q, q)
    sine = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    return q[..., 1:] * 2 * np.arctan2(sine, q[..., :1]) / np.maximum(sine, 1e-12)


def product(a, b):
    w, v, x, u = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([w * x - (v * u).sum(-1, keepdims=True), w * u + x * v + np.cross(v, u)], -1)


def changed(motion, tilt, travel):
    """The world's rotation vector, then the factors of the pelvis' way."""
    out = {k: v for k, v in motion.items() if not k.startswith(("keypoint", "camera", "mimicx_world")) and k != "joints"}
    q, pelvis = quaternion(np.array(tilt, float)), motion["joints"][:, 0]
    rest, root = (pelvis - motion["trans"])[0], quaternion(motion["poses"][:, :3])
    v = np.concatenate([np.zeros((len(pelvis), 1)), pelvis], 1)
    turned = product(product(q, v), q * [1, -1, -1, -1])[:, 1:]
    out["trans"] = turned[0] + (turned - turned[0]) * travel - rest
    out["poses"] = np.hstack([rotation_vector(product(np.broadcast_to(q, root.shape), root)), motion["poses"][:, 3:]])
    return out


def notes(mimicx, folder, motion, tilt, travel):
    with tempfile.NamedTemporaryFile(suffix=".npz", dir=folder) as file:
        np.savez(file, **changed(motion, tilt, travel))
        file.flush()
        run = subprocess.run([mimicx, "info", file.name, "--json", "-"], capture_output=True, text=True)
    return " ".join(json.loads(run.stdout)["prepared"]["notes"]) if run.returncode == 0 else "failed"


def check(mimicx, folder, path):
    converted = Path(folder) / (path.replace("/", "_") + ".converted.npz")
    run = subprocess.run([mimicx, "convert", path, str(converted)], capture_output=True, text=True)
    if run.returncode:
        return path, None, None
    motion = dict(np.load(converted))
    told = []
    for angle in ANGLES:
        axes = [0.3 + k * np.pi / 2 for k in range(4 if angle else 1)]
        told.append(sum("stand on a slope" in notes(mimicx, folder, motion, np.radians(angle) * np.array(
            [np.cos(a), np.sin(a), 0]), (1, 1, 1)) for a in axes))
    return path, told, [name for name, travel in TRAVELS.items()
                        if "that they walk" in notes(mimicx, folder, motion, (0, 0, 0), travel)]


def main():
    mimicx, paths = sys.argv[1], sys.argv[2:]
    sums, travels, read = np.zeros(len(ANGLES), int), Counter(), 0
    print("| motion | " + " | ".join(f"{a}°" for a in ANGLES) + " | translations told |\n" + "|---" * 8 + "|")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor() as pool:
        for path, told, names in pool.map(lambda path: check(mimicx, folder, path), paths):
            if told is None:
                continue
            print(f"| {path} | " + " | ".join(map(str, told)) + f" | {', '.join(names)} |", flush=True)
            sums, travels, read = sums + told, travels + Counter(names), read + 1
    print(f"{read} motions, tilts told:", ", ".join(f"{a}° {n} of {read * (4 if a else 1)}" for a, n in zip(ANGLES, sums)))
    print("translations told:", ", ".join(f"{name} {travels[name]}" for name in TRAVELS))


if __name__ == "__main__":
    main()

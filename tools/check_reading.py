#!/usr/bin/env python3
"""check_reading.py MIMICX FOLDER... : how often reading decides right, on real motions and on altered copies of them.

Every BVH and npz of the folders is read as it is, which must be right (the truths that are not usual stand below), and
in altered copies: turned to other axes, in other units, at other frame rates, with left and right exchanged. Prints for
each rule a row per truth: how often it was found, found with a warning, found wrong with a warning, and wrong without a
word. NumPy alone.
"""
import concurrent.futures
import itertools
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np

Z_UP_BVH = ("zombie.bvh", "walk1.bvh", "zombieWalk1.bvh", "tpose.bvh")
LEFT_OUT = ("expected", "tpose", "split", "gap_", "nan_", "two_people", "prop", "pickled", "comma", "fps_", "utf16",
            "backstroke", "asleep")
UNIT_OF = {  # how names of BVH begin: what README.md and case.md of ../shared say; all others are in centimetres
    "inches / 0.45": ("cmu_", "neutral_", "old_", "strutting_"), "inches": ("zombie.",),
    "decimetres": ("walk1.", "zombieWalk1.", "zero_toes_dm.")}
UNITS = {"metres": 1.0, "centimetres": 0.01, "millimetres": 0.001, "inches": 0.0254, "inches / 0.45": 0.0254 / 0.45,
         "decimetres": 0.1}
TURNS = {"y": np.eye(3), "z": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]), "-y": np.diag([1.0, -1, -1]),
         "x": np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]])}  # from y up


def info(mimicx, path, *options):
    run = subprocess.run([mimicx, "info", str(path), *options], capture_output=True, text=True, errors="replace")
    return run.stdout + run.stderr if run.returncode == 0 else None


def split_bvh(text):
    head, motion = text.split("MOTION", 1)
    lines = [line for line in motion.splitlines() if line.strip()]
    return head, float(re.split(":", lines[1])[1]), np.array([line.split() for line in lines[2:]], float)


def join_bvh(head, seconds, rows):
    body = "\n".join(" ".join(f"{v:.6f}" for v in row) for row in rows)
    return f"{head}MOTION\nFrames: {len(rows)}\nFrame Time: {seconds:.9g}\n{body}\n"


def position_columns(head):
    channels = re.findall(r"CHANNELS\s+\d+((?:\s+[XYZxyz](?:position|rotation))+)", head, re.I)
    return np.array([c.lower().endswith("position") for group in channels for c in group.split()])


def turned_bvh(text, name):
    """Under a new root that turns the world from y up."""
    about = {"y": "0 0 0", "z": "0 90 0", "-y": "0 180 0", "x": "-90 0 0"}[name]  # Z, X, Y
    head, seconds, rows = split_bvh(text)
    root = re.search(r"ROOT\s", head).start()
    head = (head[:root] + "ROOT World\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT " +
            head[root + 4:].lstrip() + "}\n")
    turn = np.tile(np.array(about.split(), float), (len(rows), 1))
    return join_bvh(head, seconds, np.hstack([turn, rows]))


def scaled_bvh(text, factor):
    head, seconds, rows = split_bvh(text)
    head = re.sub(r"OFFSET\s+(\S+)\s+(\S+)\s+(\S+)",
                  lambda m: "OFFSET " + " ".join(f"{factor * float(v):.8g}" for v in m.groups()), head)
    rows[:, position_columns(head)] *= factor
    return join_bvh(head, seconds, rows)


def timed_bvh(text, factor):
    head, seconds, rows = split_bvh(text)
    return join_bvh(head, seconds / factor, rows)


def mirrored_bvh(text):
    head, rest = text.split("MOTION", 1)
    swap = {"left": "right", "right": "left", "Left": "Right", "Right": "Left", "LEFT": "RIGHT", "RIGHT": "LEFT"}
    changed = re.sub(r"left|right|Left|Right|LEFT|RIGHT", lambda m: swap[m.group(0)], head)
    if changed == head:
        letters = {"l": "r", "r": "l", "L": "R", "R": "L"}
        changed = re.sub(r"((?:JOINT|ROOT)\s+(?:\w+:)?)([lrLR])(?=[A-Z])",
                         lambda m: m.group(1) + letters[m.group(2)], head)
        changed = re.sub(r"(_)([LR])(?=\s)", lambda m: m.group(1) + letters[m.group(2)], changed)
    return changed + "MOTION" + rest


def altered_npz(path, turn=None, scale=1.0, rate=1.0, exchanged=False):
    from_vector = lambda v: rotation(np.asarray(v, float))
    data = {k: v for k, v in np.load(path, allow_pickle=True).items()
            if v.dtype != object and k not in ("root_orient", "pose_body")}  # read in place of the poses
    poses, trans = np.array(data["poses"], float), np.array(data["trans"], float)
    if turn is not None:
        j0 = np.array([-.002, -.223, .028])
        roots = [turn @ from_vector(v) for v in poses[:, :3]]
        poses[:, :3] = [vector(m) for m in roots]
        trans = (trans + j0) @ turn.T - j0
    if exchanged:
        joints = poses[:, :66].reshape(-1, 22, 3)
        left = np.array([1, 4, 7, 10, 13, 16, 18, 20])
        joints[:, [*left, *left + 1]] = joints[:, [*left + 1, *left]]
        poses[:, :66] = joints.reshape(-1, 66)
    data["poses"], data["trans"] = poses, trans * scale
    key = "mocap_framerate" if "mocap_framerate" in data else "mocap_frame_rate"
    data[key] = np.array(float(data[key]) * rate)
    return data


def rotation(v):
    angle = np.linalg.norm(v)
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = v / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def vector(m):
    w, v = np.linalg.eig(m)
    angle = np.arccos(np.clip((np.trace(m) - 1) / 2, -1, 1))
    axis = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    if np.linalg.norm(axis) < 1e-9:  # none, or half a turn
        axis = np.real(v[:, np.argmin(abs(w - 1))])
    return angle * axis / np.linalg.norm(axis)


def jobs_of(path):
    """(rule, truth, factor of the rate, content) of a file; content: text, members, or the path of the file itself."""
    skip = any(word in path.name for word in LEFT_OUT)
    if path.suffix == ".bvh" and not skip:
        text = path.read_text(errors="replace").replace("\r", "")
        try:
            head, _, rows = split_bvh(text)
        except (ValueError, IndexError):
            return
        if rows.shape[1] != len(position_columns(head)):  # they are wrapped
            return
        z_up = path.name in Z_UP_BVH
        yield "up", "z" if z_up else "y", None, path
        if not z_up:
            for name in ("z", "-y", "x"):
                yield "up", name, None, turned_bvh(text, name)
        unit = next((u for u, names in UNIT_OF.items() if path.name.startswith(names)), "centimetres")
        yield "unit", unit, None, path
        for name in UNITS:
            yield "unit", name, None, scaled_bvh(text, UNITS[unit] / UNITS[name])
        for factor in (0.5, 1, 2, 4):
            yield "rate", f"{factor:g} times", factor, timed_bvh(text, factor)
        yield "sides", "right", None, path
        yield "sides", "exchanged", None, mirrored_bvh(text)
    elif path.suffix == ".npz" and not skip:
        with np.load(path, allow_pickle=True) as data:
            if "poses" not in data or "trans" not in data or data["poses"].ndim != 2:
                return
            if not {"mocap_framerate", "mocap_frame_rate"} & set(data.keys()):
                return
        y_up = "y_up" in path.name or path.parent.name[:2] in ("31", "33")
        yield "up (npz)", "y" if y_up else "z", None, path
        if not y_up:
            for name in ("y", "-y", "x"):
                yield "up (npz)", name, None, altered_npz(path, turn=TURNS[name] @ TURNS["z"].T)
            for name, unit in (("metres", 1.0), ("centimetres", .01), ("millimetres", .001), ("decimetres", .1),
                               ("inches", .0254), ("feet", .3048)):
                yield "unit (npz)", name, None, altered_npz(path, scale=1 / unit)
        for factor in (0.5, 1, 2, 4):
            yield "rate (npz)", f"{factor:g} times", factor, altered_npz(path, rate=factor)
        yield "sides (npz)", "right", None, path
        yield "sides (npz)", "exchanged", None, altered_npz(path, exchanged=True)


def judge(mimicx, path, rule, truth, factor, content):
    """(rule, truth, right, warned, words) of a file or a copy; None: it cannot be read."""
    if isinstance(content, Path):
        text = info(mimicx, content)
    else:
        with tempfile.NamedTemporaryFile(suffix=path.suffix) as file:
            if isinstance(content, str):
                file.write(content.encode())
            else:
                np.savez(file, **content)
            file.flush()
            text = info(mimicx, file.name)
    if text is None:
        return None
    warned, found = False, ""
    if rule.startswith("up"):
        m = re.search(r"up axis:? (upside down|-?[xyz])", text)
        found = {"upside down": "-z"}.get(m.group(1), m.group(1)) if m else "none"
        warned = "is not sure" in text
    elif rule == "unit":
        m = re.search(r"unit (.+?): legs are", text)
        found, warned = m.group(1) if m else "none", "the unit may also be" in text or "no usual unit" in text
    elif rule == "unit (npz)":
        m = re.search(r"translation is taken to be in (\w+)", text)
        found, warned = m.group(1) if m else "metres", "the translation may be in" in text
    elif rule.startswith("rate"):
        m = re.search(r"frame rate: ([\d.]+) fps, not", text)
        found = "changed" if m else "kept"
        warned = "the frame rate may be" in text
        wanted = "kept" if factor == 1 else "changed"
        flew = "flight" in text
        truth = f"{truth}, {'flights' if flew else 'no flights'}"
        return rule, truth, found == wanted, warned, f"{path.name} {found}"
    elif rule.startswith("sides"):
        found = "exchanged" if "left and right exchanged" in text else "right"
    return rule, truth, found == truth, warned, f"{path.name}: {truth} taken for {found}"


def main():
    mimicx, folders = sys.argv[1], sys.argv[2:]
    verbose = bool(os.environ.get("VERBOSE"))
    files = sorted(p for folder in folders for p in Path(folder).rglob("*") if p.is_file())
    table = defaultdict(Counter)
    of_file = lambda path: [judge(mimicx, path, *job) for job in jobs_of(path)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for rule, truth, right, warned, words in filter(None, itertools.chain.from_iterable(pool.map(of_file, files))):
            table[rule, truth][right, warned] += 1
            if verbose and (not right or warned):
                print("right, warned" if right else "wrong, warned" if warned else "WRONG", rule, words, file=sys.stderr)
    print("| rule | truth | right | right, warned | wrong, warned | wrong |\n|---|---|---|---|---|---|")
    for (rule, truth), count in sorted(table.items()):
        print(f"| {rule} | {truth} | {count[True, False]} | {count[True, True]} | {count[False, True]} | "
              f"{count[False, False]} |")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Draws a motion before and after cleaning, as an SVG: the same moments of both, above each other.

    tools/demo                                         # leaves out/demo/motions
    tools/picture.py data/synthetic/test/noisy/jump_1.npz out/demo/motions/jump_1.npz \
        docs/figures/before_after.svg --frames 6,38,49,55,66,78,105

A camera far away, at the height of the floor, looks at the body's right side, a little from behind; it sees the floor
as a line and capsules as strokes with round ends. Moments stand beside each other, whatever way the body goes between
them. Both rows show the body of the cleaned file: its bone lengths come from `joints`. A foot of the input is red
under the floor and orange in the air where the cleaned body stands. An arrow is the force of the floor on a foot, from
`ground_wrenches`. Needs NumPy alone; equal files give equal bytes.
"""
import argparse

import numpy as np

PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19]
FEET = [(7, 10), (8, 11)]  # ankle, ball of the foot: left, right
LEFT = {1, 4, 7, 10, 13, 16, 18, 20}
TRUNK = {0, 3, 6, 9, 12, 15}
SOLE = 0.022  # the ball's joint stands so high over the sole, m

# What is drawn: from joint, to joint (or -1: to `tip` in the body's frame, y up and z forward), radius, m.
BONES = [(0, 3, 0.105, None), (3, 6, 0.10, None), (6, 9, 0.105, None), (9, 12, 0.085, None), (12, 15, 0.045, None),
         (15, -1, 0.085, (0, 0.09, 0.01)),
         (1, 4, 0.064, None), (4, 7, 0.045, None), (7, 10, 0.032, None), (10, -1, 0.02, (0, -0.002, 0.05)),
         (7, -1, 0.03, (0, -0.045, -0.025)),
         (2, 5, 0.064, None), (5, 8, 0.045, None), (8, 11, 0.032, None), (11, -1, 0.02, (0, -0.002, 0.05)),
         (8, -1, 0.03, (0, -0.045, -0.025)),
         (13, 16, 0.05, None), (16, 18, 0.042, None), (18, 20, 0.034, None), (20, -1, 0.03, (0.09, -0.01, 0)),
         (14, 17, 0.05, None), (17, 19, 0.042, None), (19, 21, 0.034, None), (21, -1, 0.03, (-0.09, -0.01, 0))]

TURN = np.radians(20)   # how far the camera stands behind the body's side
SCALE = 185             # pixels per metre
WIDTH, ROW, FLOOR = 940, 392, 360
TOUCH = 0.005           # a foot so near to the floor stands on it, m
INK = {"before": ("#8d6e63", "#bcaaa4"), "after": ("#1f5fa8", "#7ba7d9")}  # near side, far side
BAD, HIGH, GOOD, FORCE = "#d32f2f", "#f57c00", "#2e9d3a", "#2e9d3a"


def matrices(vectors):
    """Rotation vectors (…, 3), rad → matrices (…, 3, 3), by Rodrigues' formula."""
    angle = np.linalg.norm(vectors, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(vectors / np.maximum(angle[..., 0], 1e-12), -1, 0)
    o = np.zeros_like(x)
    k = np.stack([o, -z, y, z, o, -x, -y, x, o], -1).reshape(vectors.shape[:-1] + (3, 3))
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def orientations(motion):
    """World orientations of the 22 bodies, (T, 22, 3, 3)."""
    turns = matrices(motion["poses"][:, :66].reshape(-1, 22, 3))
    for body in range(1, 22):
        turns[:, body] = turns[:, PARENTS[body]] @ turns[:, body]
    return turns


def body_of(cleaned):
    """Offsets of the joints from their parents (22, 3), and of the pelvis from `trans` (3,), m."""
    turns, joints = orientations(cleaned)[0], cleaned["joints"][0]
    offsets = np.zeros((22, 3))
    for body in range(1, 22):
        offsets[body] = turns[PARENTS[body]].T @ (joints[body] - joints[PARENTS[body]])
    return offsets, joints[0] - cleaned["trans"][0]


def play(motion, offsets, pelvis):
    """Orientations (T, 22, 3, 3) and joint positions (T, 22, 3) of a motion on that body, m."""
    turns = orientations(motion)
    joints = np.zeros(turns.shape[:2] + (3,))
    joints[:, 0] = motion["trans"] + pelvis
    for body in range(1, 22):
        joints[:, body] = joints[:, PARENTS[body]] + turns[:, PARENTS[body]] @ offsets[body]
    return turns, joints


def lowest_of_feet(turns, joints, offsets):
    """Height of the lowest of heel, ball and toe of each foot, (T, 2), m."""
    heights = []
    for ankle, ball in FEET:
        points = [joints[:, ankle] + turns[:, ankle] @ (0, offsets[ball][1] - SOLE, -0.052),
                  joints[:, ball] + turns[:, ball] @ (0, -SOLE, 0),
                  joints[:, ball] + turns[:, ball] @ (0, -SOLE, 0.065)]
        heights.append(np.min([p[:, 2] for p in points], axis=0))
    return np.stack(heights, 1)


class View:
    """Where a place in the world, m, stands in a slot of a row, px; greater depth is farther away."""

    def __init__(self, facing):
        ahead = facing[:2] / np.linalg.norm(facing[:2])
        aside = np.array([ahead[1], -ahead[0]])  # to the right of the body, towards the camera
        self.across = np.cos(TURN) * ahead + np.sin(TURN) * aside
        self.away = np.sin(TURN) * ahead - np.cos(TURN) * aside
        self.x, self.origin = 0.0, np.zeros(2)

    def put(self, x, origin):
        """From now on the place `origin` of the world stands at x."""
        self.x, self.origin = x, origin[:2]

    def place(self, p):
        return self.x + SCALE * ((p[:2] - self.origin) @ self.across), FLOOR - SCALE * p[2]

    def depth(self, p):
        return p[:2] @ self.away


def line(a, b, width, colour):
    """A stroke with round ends is what a capsule looks like from far away."""
    return f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}" stroke="{colour}" stroke-width="{width:.1f}"/>'


def figure(view, turns, joints, ink, feet):
    """One body. @param feet  colours of the left and the right foot"""
    strokes = []
    for body, other, radius, tip in BONES:
        a = joints[body]
        b = joints[other] if other >= 0 else a + turns[body] @ np.array(tip)
        colour = ink[1] if body in LEFT else ink[0]
        if body in (7, 8, 10, 11):
            colour = feet[0 if body in (7, 10) else 1] or colour
        depth = view.depth(joints[0] if body in TRUNK else (a + b) / 2)  # the trunk's strokes keep their order
        strokes.append((depth, view.place(a), view.place(b), 2 * radius * SCALE, colour))
    parts = []
    for _, a, b, width, colour in sorted(strokes, key=lambda s: -s[0]):
        parts += [line(a, b, width + 2.4, "#fff"), line(a, b, width, colour)]
    return parts


def arrow(view, foot, force, weight):
    """The floor's force on a foot: as long as a leg where it is twice the weight."""
    a = np.array(view.place(foot))
    b = np.array(view.place(foot + 0.45 * force / weight))
    along = (b - a) / np.linalg.norm(b - a)
    aside = np.array([-along[1], along[0]])
    tip = [b + 10 * along, b + 5.5 * aside, b - 5.5 * aside]
    head = "L".join(f"{x:.1f} {y:.1f}" for x, y in tip)
    return [line(a, b, 6, "#fff"), line(a, b, 3, FORCE), f'<path d="M{head}Z" fill="{FORCE}" stroke="#fff"/>']


def note(x, text, colour):
    return f'<text x="{x:.1f}" y="{FLOOR + 20}" fill="{colour}" text-anchor="middle">{text}</text>'


def ground(title):
    return [f'<rect y="{FLOOR}" width="{WIDTH}" height="{ROW - FLOOR}" fill="#eceff1"/>',
            f'<path d="M0 {FLOOR}H{WIDTH}" stroke="#455a64" stroke-width="1.5"/>',
            f'<text x="14" y="26" font-size="17" fill="#263238">{title}</text>']


def body_before(view, turns, joints, heights, cleaned):
    """The input at one moment. @param heights, cleaned  of its feet and of the cleaned body's, m"""
    stands = cleaned < TOUCH
    colours = [BAD if h < -TOUCH else HIGH if s and h > TOUCH else None for h, s in zip(heights, stands)]
    parts = figure(view, turns, joints, INK["before"], colours)
    if heights.min() < -TOUCH:
        parts.append(note(view.x, f"{-100 * heights.min():.0f} cm too deep", BAD))
    elif stands.any() and heights[stands].min() > TOUCH:
        parts.append(note(view.x, f"{100 * heights[stands].min():.0f} cm in the air", HIGH))
    return parts


def body_after(view, turns, joints, heights, wrenches, weight):
    """The cleaned motion at one moment. @param wrenches  of the floor on every body, (22, 6)"""
    parts = figure(view, turns, joints, INK["after"], [GOOD if h < TOUCH else None for h in heights])
    for ankle, ball in FEET:
        force = wrenches[ankle, 3:] + wrenches[ball, 3:]
        if force[2] > 0.05 * weight:
            parts += arrow(view, (joints[ankle] + joints[ball]) / 2 * (1, 1, 0), force, weight)
    return parts


def picture(before, after, frames):
    offsets, pelvis = body_of(after)
    motions = []
    for motion in (before, after):
        turns, joints = play(motion, offsets, pelvis)
        motions.append((turns, joints, lowest_of_feet(turns, joints, offsets)))
    (turns_b, joints_b, heights_b), (turns_a, joints_a, heights_a) = motions
    wrenches = after["ground_wrenches"]
    weight = wrenches[1:, :, 5].sum(1).mean()  # the floor carries the weight on average
    view = View(turns_a[0, 0] @ (0, 0, 1))
    upper, lower = ground("before: a motion with the errors of a video estimator"), ground(
        "after: the same motion, simulated; arrows are the forces of the floor")
    for k, t in enumerate(frames):
        view.put(WIDTH * (k + 0.5) / len(frames), joints_a[t, 0])
        upper += body_before(view, turns_b[t], joints_b[t], heights_b[t], heights_a[t])
        lower += body_after(view, turns_a[t], joints_a[t], heights_a[t], wrenches[t], weight)
        lower.append(note(view.x, f"{t / float(after['mocap_framerate']):.1f} s", "#455a64"))
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {2 * ROW}" '
                      'font-family="sans-serif" font-size="14" stroke-linecap="round">',
                      "<title>A motion with the errors of a video estimator, and the same motion simulated</title>",
                      f'<rect width="{WIDTH}" height="{2 * ROW}" fill="#fff"/>', *upper,
                      f'<g transform="translate(0 {ROW})">', *lower, "</g>", "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before", help="the input, .npz")
    parser.add_argument("after", help="the cleaned motion, motions/NAME.npz of a run")
    parser.add_argument("out", help="the picture, .svg")
    parser.add_argument("--frames", help="the moments to draw, as frames from 0 on; without it seven, evenly spread")
    arguments = parser.parse_args()
    with np.load(arguments.before) as before, np.load(arguments.after) as after:
        frames = np.linspace(0, len(after["joints"]) - 1, 7).astype(int)
        if arguments.frames:
            frames = [int(t) for t in arguments.frames.split(",")]
        text = picture(before, after, frames)
    with open(arguments.out, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


if __name__ == "__main__":
    main()

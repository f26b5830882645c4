#!/usr/bin/env python3
"""Results of video estimators to files that mimicx reads.

    convert_video_results.py RESULTS OUT.npz             one result
    convert_video_results.py RESULTS RESULTS ... FOLDER  several, each into FOLDER under its own name

RESULTS, recognised by what is in it (docs/formats.md, "Results of video estimators"):

    GVHMR (hmr4d_results.pt), GEM (smpl_params.pt), WHAM (wham_output.pkl), PromptHMR (results.pkl), VIBE (.pkl),
    TRAM (a folder with camera.npy and hps/), SLAHMR (..._world_results.npz), TRACE (.npz), ROMP (video_results.npz),
    4DHumans and PHALP (tracks, .pkl), PHC and AIST++ (.pkl), Multi-HMR and SAM 3D Body
    (pickled lists), MDM (results.npy)

Every person gets a file, and every piece of a person's track that has no gap: OUT.npz where there is but one, else
OUT_person2.npz or OUT_person2_from310.npz (frame of the video). All people of a result are in one world: same origin,
same axes, same floor. Of several people or pieces those shorter than --shortest frames are left out. A file that is
there is never overwritten.

Needs NumPy alone, and pickled_arrays.py beside it, which never runs what is in a pickle. GVHMR, GEM and WHAM tell no
camera, but where the motion is in the world (y up) and where in front of the camera. What takes one to the other is the
camera of a frame, with all errors of both; the keypoint fit needs better. --static makes one camera of all frames,
--slam lays the camera's path, which the estimators leave beside their results, through them; --moving takes them as
they are. TRAM, PromptHMR and SLAHMR tell their camera. WHAM keeps no focal length: --size gives the picture's diagonal, which
is what it assumes. ROMP, PHALP, Multi-HMR and SAM 3D Body tell places in front of the camera alone: it is taken to
stand level and still.
"""
import argparse
import glob
import os
import re
import sys

import numpy as np

from pickled_arrays import load

J0 = {"smplx": np.array([0.003, -0.351, 0.012]), "smpl": np.array([-0.002, -0.223, 0.028])}  # rest pelvis, m
J0["smplh"] = J0["smpl"]
MID_HIP = np.array([-0.001, -0.086, -0.016])  # of SMPL at rest, from its pelvis, m
DOWN_TO_UP = np.diag([1.0, -1, -1])  # of a camera's axes (y down, z forward) to y up
Y_TO_Z = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])
COCO17 = ["nose"] + [side + part for part in ("eye", "ear", "shoulder", "elbow", "wrist", "hip", "knee", "ankle")
                     for side in ("left_", "right_")]


def matrices(r):
    """Rotation vectors (T, 3) to matrices (T, 3, 3)."""
    angle = np.linalg.norm(r, axis=1, keepdims=True)
    x, y, z = (r / np.maximum(angle, 1e-12)).T
    o, a = np.zeros_like(x), angle[:, :, None]
    k = np.stack([o, -z, y, z, o, -x, -y, x, o], 1).reshape(-1, 3, 3)
    return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k


def vectors(m):
    """Rotation matrices (..., 3, 3) to rotation vectors, through the quaternion's largest entry."""
    shape, m = m.shape[:-2], m.reshape(-1, 3, 3)
    d = np.einsum("tii->ti", m)
    squares = np.stack([1 + d.sum(1), *(1 + 2 * d - d.sum(1, keepdims=True)).T], 1)  # 4 w², 4 x², 4 y², 4 z²
    x, y, z = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    xy, xz, yz = m[:, 0, 1] + m[:, 1, 0], m[:, 0, 2] + m[:, 2, 0], m[:, 1, 2] + m[:, 2, 1]
    rows = np.stack([squares[:, 0], x, y, z, x, squares[:, 1], xy, xz, y, xy, squares[:, 2], yz, z, xz, yz,
                     squares[:, 3]], 1).reshape(-1, 4, 4)
    q = rows[np.arange(len(m)), squares.argmax(1)]
    q *= np.where(q[:, :1] < 0, -1.0, 1.0) / np.linalg.norm(q, axis=1, keepdims=True)
    sine = np.linalg.norm(q[:, 1:], axis=1, keepdims=True)
    return (q[:, 1:] * 2 * np.arctan2(sine, q[:, :1]) / np.maximum(sine, 1e-12)).reshape(*shape, 3)


class Wrong(Exception):
    """Which file is wrong, what was expected in it, what was found."""

    def __init__(self, path, expected, found):
        super().__init__(f"{path}: expected {expected}, found {found}")


def kind_of(data):
    if isinstance(data, dict):
        return "a dictionary of " + (", ".join(str(key) for key in list(data)[:6]) or "nothing")
    return f"an array of shape {np.shape(data)}" if isinstance(data, np.ndarray) else f"a {type(data).__name__}"


def read(path, what):
    """The data in a file. `what` is expected of it, in words."""
    if not os.path.isfile(path):
        raise Wrong(path, what, "a folder" if os.path.isdir(path) else "no such file")
    try:
        return load(path)
    except Exception as error:  # whatever a damaged pickle or archive leads to
        raise Wrong(path, what, f"a file that cannot be read ({type(error).__name__}: {error})") from error


class Track:
    """One person: rotation vectors (T, 3J) and pelvis (T, 3) in the world (y up), and in front of the camera."""

    def __init__(self, model, pose, root_camera, pelvis, pelvis_camera, betas, intrinsics=None, frames=None,
                 tells_camera=False):
        self.model, self.intrinsics, self.tells_camera = model, intrinsics, tells_camera
        self.pose, self.root_camera, self.pelvis, self.pelvis_camera = (
            np.asarray(x, float) for x in (pose, root_camera, pelvis, pelvis_camera))
        self.betas = np.asarray(betas, float).reshape(-1, np.shape(betas)[-1])
        self.frames = np.arange(len(self.pose)) if frames is None else np.asarray(frames, int).reshape(-1)

    def pieces(self):
        """First and last + 1 of every run of frames without a gap."""
        gaps = np.diff(self.frames) != 1
        breaks = np.flatnonzero(gaps) + 1
        return list(zip([0, *breaks], [*breaks, len(self.frames)]))


class Positions(Track):
    """One person of whom joint positions (T, 22, 3) are known, y up."""

    def __init__(self, positions, frames=None, fps=None):
        self.positions, self.model, self.fps = np.asarray(positions, float), "joint positions", fps
        self.frames = np.arange(len(self.positions)) if frames is None else np.asarray(frames, int).reshape(-1)


def turned(root, pelvis, turn):
    """Rotation vectors and places in a world that is turned."""
    return vectors(turn @ matrices(np.asarray(root, float))), np.asarray(pelvis, float) @ turn.T


def before_camera(model, pose, pelvis, betas, intrinsics=None, frames=None):
    """A track of a person whose place is known in front of the camera alone, which stands level and still."""
    pose, pelvis = np.asarray(pose, float), np.asarray(pelvis, float)
    root, place = turned(pose[:, :3], pelvis, DOWN_TO_UP)
    return Track(model, np.hstack([root, pose[:, 3:]]), pose[:, :3], place, pelvis, betas, intrinsics, frames)


def gvhmr(data):
    kind = "smpl_params" if "smpl_params_global" in data else "body_params"  # GVHMR's and GEM's
    world, camera = data[kind + "_global"], data[kind + "_incam"]
    pose = np.hstack([world["global_orient"], world["body_pose"]])
    return Track("smplx", pose, camera["global_orient"], world["transl"] + J0["smplx"], camera["transl"] + J0["smplx"],
                 world["betas"], data.get("K_fullimg"))


def wham(data):
    """WHAM's trans is SMPL's, but its trans_world is where the middle of the hips is."""
    pose = np.asarray(data["pose_world"], float)
    pelvis = data["trans_world"] - matrices(pose[:, :3]) @ MID_HIP
    return Track("smpl", pose, data["pose"][:, :3], pelvis, data["trans"] + J0["smpl"], data["betas"],
                 frames=data.get("frame_ids"))


def tram(data, camera):
    """Poses in front of the camera, and the camera's own place in a world that is y up."""
    if "world_cam_R" not in camera:
        raise ValueError("camera.npy without world_cam_R: an older TRAM, which does not say where up is")
    frames, rotations = np.asarray(data["frame"], int), np.asarray(data["pred_rotmat"], float)
    turn, place = (np.asarray(camera[key], float)[frames] for key in ("world_cam_R", "world_cam_T"))
    pelvis = np.asarray(data["pred_trans"], float).reshape(-1, 3) + J0["smpl"]
    pose = np.hstack([vectors(turn @ rotations[:, 0]), vectors(rotations[:, 1:]).reshape(len(frames), -1)])
    focal, (u, v) = float(camera["img_focal"]), np.asarray(camera["img_center"], float).reshape(2)
    return Track("smpl", pose, vectors(rotations[:, 0]), np.einsum("tij,tj->ti", turn, pelvis) + place, pelvis,
                 np.asarray(data["pred_shape"], float).mean(0), np.array([[focal, 0, u], [0, focal, v], [0, 0, 1]]),
                 frames, tells_camera=True)


def phc(data):
    """PHC's motions: z up, SMPL's trans."""
    pose = np.asarray(data["pose_aa"], float).reshape(len(data["pose_aa"]), -1)
    root, pelvis = turned(pose[:, :3], np.asarray(data["trans_orig"], float) + J0["smpl"], Y_TO_Z.T)
    pose = np.hstack([root, pose[:, 3:]])
    track = Track("smpl", pose, root, pelvis, pelvis, np.ravel(data.get("beta", np.zeros(10)))[:10])
    track.fps = float(data["fps"]) if "fps" in data else None
    return track


def aist(data):
    """AIST++'s motions: y up; smpl_trans is in the unit of smpl_scaling; 60 fps."""
    pose = np.asarray(data["smpl_poses"], float).reshape(len(data["smpl_poses"]), -1)
    scale = float(np.ravel(data.get("smpl_scaling", 1.0))[0])
    pelvis = np.asarray(data["smpl_trans"], float) / scale + J0["smpl"]
    track = Track("smpl", pose, pose[:, :3], pelvis, pelvis, np.zeros(10))
    track.fps = 60.0
    return track


def vibe(data, size):
    """Poses in front of the camera; orig_cam (s_x, s_y, t_x, t_y) is of a weak perspective in the picture, whose size and
    diagonal as focal length give the depth."""
    if not size:
        raise ValueError("VIBE's camera needs the size of the picture: --size W H")
    pose, camera = np.asarray(data["pose"], float), np.asarray(data["orig_cam"], float)
    depth = np.hypot(*size) / (camera[:, 0] * size[0] / 2)
    place = np.stack([camera[:, 2], camera[:, 3], depth], 1)
    return before_camera("smpl", pose, place + J0["smpl"], np.asarray(data["betas"], float)[:, :10],
                         frames=data.get("frame_ids"))


def prompthmr(data):
    """{person: Track}. World y up; smplx_world and smplx_cam hold pose (T, 165), shape and SMPL-X's trans."""
    out = {}
    for name, person in data["people"].items():
        world, camera = person["smplx_world"], person.get("smplx_cam", person["smplx_world"])
        calibration = data.get("camera", {})
        intrinsics = None
        if "img_focal" in calibration:
            focal, center = float(np.ravel(calibration["img_focal"])[0]), np.ravel(calibration["img_center"])
            intrinsics = np.array([[focal, 0, center[0]], [0, focal, center[1]], [0, 0, 1]])
        out[name] = Track("smplx", world["pose"], np.asarray(camera["pose"])[:, :3], world["trans"] + J0["smplx"],
                          camera["trans"] + J0["smplx"], world["shape"], intrinsics, person.get("frames"),
                          tells_camera="smplx_cam" in person)
    return out


def slahmr(data):
    """{person: Track}. SMPL-H, (P, T, ...), in the world of the first camera; the floor plane, where there is one,
    tells up, else the camera's y axis points down. track_mask (P, T): in which frames a person is there, all is 0 in the
    others. cam_R, cam_t: from that world to the camera of a frame; intrins: its focal lengths and centre."""
    trans = np.asarray(data["trans"], float)
    people, frames = trans.shape[:2]
    there = np.reshape(data.get("track_mask", np.ones((people, frames))), (people, frames)) > 0
    pose = np.concatenate([np.reshape(data["root_orient"], (people, frames, 3)),
                           np.reshape(data["pose_body"], (people, frames, -1))], 2).astype(float)
    turn = DOWN_TO_UP
    if "floor_plane" in data and np.size(data["floor_plane"]) >= 3:
        normal = np.ravel(data["floor_plane"])[:3] / np.linalg.norm(np.ravel(data["floor_plane"])[:3])
        heads = np.einsum("tij,j->ti", matrices(pose[there][:, :3]), [0, 1.0, 0]).mean(0)
        normal = normal if normal @ heads > 0 else -normal
        side = np.cross(normal, [0, 0, 1.0])
        side /= np.linalg.norm(side)
        turn = np.stack([side, normal, np.cross(side, normal)])
    to_camera, to_place = np.tile(np.eye(3), (people, frames, 1, 1)), np.zeros((people, frames, 3))
    tells = "cam_R" in data and "cam_t" in data
    if tells:
        to_camera, to_place = (np.broadcast_to(np.asarray(data[key], float), like.shape)
                               for key, like in (("cam_R", to_camera), ("cam_t", to_place)))
    intrinsics = None
    if "intrins" in data:
        fx, fy, u, v = np.reshape(data["intrins"], (-1, 4))[0]
        intrinsics = np.array([[fx, 0, u], [0, fy, v], [0, 0, 1]])
    betas = np.reshape(data["betas"], (-1, np.shape(data["betas"])[-1])) if "betas" in data else np.zeros((1, 10))
    out = {}
    for p in range(people):
        rows = np.flatnonzero(there[p])
        if not len(rows):
            continue
        place = trans[p, rows] + J0["smpl"]
        root, pelvis = turned(pose[p, rows, :3], place, turn)
        root_camera = vectors(to_camera[p, rows] @ matrices(pose[p, rows, :3]))
        pelvis_camera = np.einsum("tij,tj->ti", to_camera[p, rows], place) + to_place[p, rows]
        out[p + 1] = Track("smplh", np.hstack([root, pose[p, rows, 3:66]]), root_camera, pelvis, pelvis_camera,
                           betas[min(p, len(betas) - 1)], intrinsics, rows, tells_camera=tells)
    return out


def trace(data):
    """{person: Track}: a row per person and frame. World: that of the first camera, y down."""
    who = np.ravel(data["track_ids"]).astype(int)
    frames = np.array([np.sum(who[:k] == one) for k, one in enumerate(who)])  # where the rows do not say theirs
    if "reorganize_idx" in data:
        frames = np.ravel(data["reorganize_idx"]).astype(int)
    thetas = np.asarray(data["smpl_thetas"], float).reshape(len(who), -1)
    out = {}
    for person in sorted(set(who.tolist())):
        rows = np.flatnonzero(who == person)
        rows = rows[np.argsort(frames[rows], kind="stable")]
        root, pelvis = turned(np.asarray(data["world_global_rots"], float)[rows].reshape(-1, 3),
                              np.asarray(data["world_trans"], float)[rows].reshape(-1, 3) + J0["smpl"], DOWN_TO_UP)
        out[person] = Track("smpl", np.hstack([root, thetas[rows, 3:]]), thetas[rows, :3], pelvis,
                            np.asarray(data["cam_trans"], float)[rows].reshape(-1, 3) + J0["smpl"],
                            np.asarray(data["smpl_betas"], float)[rows][:, :10], frames=frames[rows])
    return out


def followed(seen):
    """{person: [(frame, thing)]} of {frame: [(place, thing)]}: each thing follows the nearest of the frame before."""
    out, last = {}, {}
    for frame in sorted(seen):
        free = dict(last)
        for place, thing in seen[frame]:
            near = min(free, key=lambda k: np.linalg.norm(free[k] - place), default=None)
            if near is None or np.linalg.norm(free[near] - place) > 1.0:  # m
                near = len(out) + 1
                out[near] = []
            free.pop(near, None)
            out[near].append((frame, thing))
            last[near] = place
    return out


def numbered(names):
    """[(frame, name)] in the order of the frames. Names that are numbers, or files that have one, are those of frames
    (from 1 on where the first is 1); other names count in their order."""
    def number(name):
        found = re.findall(r"\d+", os.path.splitext(os.path.basename(str(name)))[0])
        return int(found[-1]) if found else None

    numbers = {name: number(name) for name in names}
    if None in numbers.values() or len(set(numbers.values())) < len(numbers):
        return list(enumerate(sorted(names)))
    files = any(isinstance(name, str) for name in names)
    begin = 1 if files and min(numbers.values(), default=0) == 1 else 0
    return sorted((n - begin, name) for name, n in numbers.items())


def to_diagonal(place, size):
    """Brings the depth of a camera whose focal length is the picture's longer side to that of its diagonal, which is
    nearer to real ones."""
    return place * [1.0, 1.0, np.hypot(*size) / max(size)] if size is not None else place


def romp(data, size):
    """{person: Track} of a video's frames, {name: arrays of its people}, or lists of people; the names are those of
    simple-romp and of ROMP's first version. People without track_ids are followed. Places are those of a camera whose
    focal length is the picture's longer side."""
    def together(people):
        """The arrays of a frame's people, where each stands for itself."""
        if isinstance(people, dict):
            return people
        return {name: np.stack([np.asarray(one[name]) for one in people]) for name in (people[0] if people else {})}

    frames_people = {name: together(people) for name, people in data.items()}
    seen, named = {}, all("track_ids" in one for one in frames_people.values() if one)
    for frame, name in numbered(frames_people):
        one = frames_people[name]
        if not one:
            continue
        thetas = np.asarray(one.get("smpl_thetas", one.get("poses")), float).reshape(-1, 72)
        places = to_diagonal(np.asarray(one.get("cam_trans", one.get("trans")), float).reshape(-1, 3), size)
        betas = np.asarray(one.get("smpl_betas", one.get("betas")), float).reshape(len(thetas), -1)[:, :10]
        ids = np.ravel(one["track_ids"]) if named else [None] * len(thetas)
        seen[frame] = [(places[k], (ids[k], thetas[k], places[k], betas[k])) for k in range(len(thetas))]
    tracks = {}
    if named:
        for frame, people in seen.items():
            for _, thing in people:
                tracks.setdefault(int(thing[0]), []).append((frame, thing))
    else:
        tracks = followed(seen)
    return {person: before_camera("smpl", np.stack([t[1] for _, t in rows]),
                                  np.stack([t[2] for _, t in rows]) + J0["smpl"], np.stack([t[3] for _, t in rows]),
                                  frames=[f for f, _ in rows]) for person, rows in tracks.items()}


def phalp(data, size):
    """{person: Track} of {frame: lists by person}. The place is that of a camera of 5000/256 of the longer side of the
    picture (`size`) as focal length. A person who is not seen (tracked_time > 0) stands there as last seen: left out."""
    rows = {}
    for frame, name in numbered(data):
        one = data[name]
        ids = np.ravel(one.get("tid", one.get("tracked_ids", []))).astype(int).tolist()
        unseen = np.ravel(one.get("tracked_time", np.zeros(len(ids))))
        for k, person in enumerate(ids):
            if unseen[k] > 0:
                continue
            body, place = one["smpl"][k], np.asarray(one["camera"][k], float).reshape(3)
            if not isinstance(body, dict):
                continue
            picture = size or one.get("size")
            if np.ndim(picture) == 2:
                picture = picture[k]
            if np.size(picture) != 2:
                raise ValueError("PHALP's camera needs the size of the picture: --size W H")
            place = to_diagonal(place / [1.0, 1.0, 5000 / 256], picture)
            turns = np.concatenate([np.reshape(body[part], (-1, 3, 3)) for part in ("global_orient", "body_pose")])
            rows.setdefault(person, []).append((frame, vectors(turns).reshape(-1), place, np.ravel(body["betas"])[:10]))
    return {person: before_camera("smpl", np.stack([r[1] for r in seen]), np.stack([r[2] for r in seen]) + J0["smpl"],
                                  np.stack([r[3] for r in seen]), frames=[r[0] for r in seen])
            for person, seen in rows.items()}


def frames_of(data):
    """{frame: [people]} of a list of frames, or of a dictionary by frames; a single person may stand without a list."""
    items = enumerate(data) if isinstance(data, list) else [(frame, data[name]) for frame, name in numbered(data)]
    return {frame: list(one) if isinstance(one, (list, tuple)) else [one] for frame, one in items}


def multihmr(data):
    """{person: Track}: rotvec (53, 3) without eyes, shape, transl_pelvis; people are followed from frame to frame."""
    tracks = followed({frame: [(np.ravel(one["transl_pelvis"])[:3].astype(float), one) for one in people]
                       for frame, people in frames_of(data).items()})
    out = {}
    for person, rows in tracks.items():
        pose = np.stack([np.reshape(one["rotvec"], (-1, 3))[:22].reshape(-1) for _, one in rows])
        pelvis = np.stack([np.ravel(one["transl_pelvis"])[:3] for _, one in rows])
        betas = np.stack([np.ravel(one["shape"])[:10] for _, one in rows])
        out[person] = before_camera("smplx", pose, pelvis, betas, frames=[frame for frame, _ in rows])
    return out


def sam3d(data):
    """{person: Positions} from the 70 keypoints of MHR; joints of the trunk lie on the line between hips and neck."""
    def joints(one):
        p = (np.asarray(one["pred_keypoints_3d"], float).reshape(70, 3) + np.ravel(one["pred_cam_t"])) @ DOWN_TO_UP.T
        mid = lambda *k: p[list(k)].mean(0)
        pelvis, neck = mid(9, 10), p[69]
        line = lambda share: pelvis + share * (neck - pelvis)
        collars = [0.6 * line(0.9) + 0.4 * p[shoulder] for shoulder in (5, 6)]
        return np.stack([line(0.1), p[9], p[10], line(0.3), p[11], p[12], line(0.55), p[13], p[14], line(0.75),
                         mid(15, 16), mid(18, 19), neck, *collars, mid(3, 4), p[5], p[6], p[7], p[8], p[62], p[41]])
    seen = {frame: [(joints(one)[0], joints(one)) for one in people] for frame, people in frames_of(data).items()}
    return {person: Positions(np.stack([j for _, j in rows]), [f for f, _ in rows])
            for person, rows in followed(seen).items()}


def mdm(data):
    """{sample, from 0: Positions} of motion (N, 22, 3, T), each cut to its length; 20 fps."""
    motion, lengths = np.asarray(data["motion"], float), np.ravel(data["lengths"]).astype(int)
    if motion.ndim != 4 or motion.shape[1:3] != (22, 3):
        raise ValueError(f"motion of shape {motion.shape}: joint positions (N, 22, 3, T) are read")
    return {k: Positions(one.transpose(2, 0, 1)[:max(1, min(n, one.shape[2]))], fps=20.0)
            for k, (one, n) in enumerate(zip(motion, lengths))}


RESULTS = ("results of GVHMR, GEM, WHAM, VIBE, PromptHMR, TRAM (the folder of a video), SLAHMR, TRACE, ROMP, PHALP, PHC, AIST++, "
           "Multi-HMR, SAM 3D Body or MDM")


def checked(path, make, *data):
    """make(*data), or what is missing in the file."""
    try:
        return make(*data)
    except KeyError as error:
        raise Wrong(path, f"a member {error} in {RESULTS}", kind_of(data[0])) from error
    except (IndexError, TypeError, AttributeError, ValueError) as error:
        raise Wrong(path, RESULTS, f"{kind_of(data[0])} ({error})") from error


def unwrapped(data):
    """What is in an archive: objects of no dimension as they are, and a single one for itself."""
    if not isinstance(data, dict):
        return data
    inner = {name: one.item() if isinstance(one, np.ndarray) and one.dtype == object and one.ndim == 0 else one
             for name, one in data.items()}
    for name in ("outputs", "results"):
        if set(inner) <= {name, "imgpaths", "sequence_results"} and isinstance(inner.get(name), dict):
            return inner[name]
    return inner


def is_about(data, *names):
    """Whether the people of a list of frames, or of a dictionary by frames, have these members."""
    try:
        people = next((one for one in frames_of(data).values() if one), [])
    except TypeError:
        return False
    return bool(people) and all(isinstance(one, dict) and set(names) <= set(one) for one in people)


def tracks_of(path, size=None):
    """{person: Track}"""
    if os.path.isdir(path):
        files = sorted(glob.glob(os.path.join(path, "hps", "*.npy")), key=lambda f: (len(f), f))
        if not files:
            raise Wrong(path, RESULTS, "a folder without hps/*.npy")
        camera = read(os.path.join(path, "camera.npy"), "TRAM's camera")
        return {os.path.basename(f)[:-4].split("_")[-1]: checked(f, tram, read(f, "TRAM's person"), camera)
                for f in files}
    data = unwrapped(read(path, RESULTS))
    if isinstance(data, list) and is_about(data, "rotvec", "transl_pelvis", "shape"):
        return checked(path, multihmr, data)
    if isinstance(data, list) and is_about(data, "pred_keypoints_3d", "pred_cam_t"):
        return checked(path, sam3d, data)
    if not isinstance(data, dict):
        raise Wrong(path, RESULTS, kind_of(data) + (
            ": keypoints? They go behind --keypoints" if np.ndim(data) == 3 and np.shape(data)[2] == 3 else ""))
    if "smpl_params_global" in data or "body_params_global" in data:
        return {0: checked(path, gvhmr, data)}
    if "pose_world" in data:
        return {0: checked(path, wham, data)}
    if "smpl_poses" in data and "smpl_trans" in data:
        return {0: checked(path, aist, data)}
    for make, names in ((prompthmr, ("people",)), (mdm, ("motion", "lengths")),
                        (trace, ("smpl_thetas", "world_trans", "track_ids")), (slahmr, ("trans", "root_orient", "pose_body"))):
        if set(names) <= set(data) and (make is not slahmr or np.ndim(data["trans"]) == 3):
            return checked(path, make, data)
    if is_about(data, "rotvec", "transl_pelvis", "shape"):
        return checked(path, multihmr, data)
    if is_about(data, "pred_keypoints_3d", "pred_cam_t"):
        return checked(path, sam3d, data)
    if is_about(data, "smpl_thetas", "cam_trans") or is_about(data, "poses", "trans", "betas"):
        return checked(path, lambda d: romp(d, size), data)
    if not data or not all(isinstance(one, dict) for one in data.values()):
        raise Wrong(path, RESULTS, kind_of(data))
    first = next(iter(data.values()))
    if "pose_aa" in first and "trans_orig" in first:
        return {person: checked(path, phc, one) for person, one in data.items()}
    if "smpl" in first and "camera" in first:
        return checked(path, lambda d: phalp(d, size), data)
    if "orig_cam" in first and "pose" in first:
        return {person: checked(path, lambda one: vibe(one, size), one) for person, one in data.items()}
    if "pose_world" not in first:
        raise Wrong(path, RESULTS, "dictionaries of " + (", ".join(str(key) for key in list(first)[:6]) or "nothing"))
    return {person: checked(path, wham, one) for person, one in data.items()}


def keypoints_of(path, data, person, frames):
    """(T, K, 3) of a track's frames. `data`: of the track, of the whole video, or by person as WHAM's tracker has it;
    a frame that has none gets zeros."""
    expected, at = "keypoints (T, K, 3): u, v in pixels and confidence", None
    if isinstance(data, dict):
        if "keypoints" not in data and person not in data:
            raise Wrong(path, f"{expected}, or a person {person}", kind_of(data))
        data = data if "keypoints" in data else data[person]
        if not isinstance(data, dict) or "keypoints" not in data:
            raise Wrong(path, expected + " of a person", kind_of(data))
        data, at = data["keypoints"], data.get("frame_id")
    points = np.asarray(data)
    if points.ndim != 3 or points.shape[2] != 3 or points.dtype.kind not in "fiu":
        raise Wrong(path, expected, kind_of(points))
    points = points.astype(float)
    if at is None and len(points) == len(frames):
        return points
    at = np.arange(len(points)) if at is None else np.asarray(at, int).reshape(-1)
    if len(at) != len(points):
        raise Wrong(path, f"a frame_id for each of {len(points)} frames", str(len(at)))
    seen = np.isin(frames, at)
    if not seen.any() or (len(at) == at[-1] + 1 and not seen[-1]):
        raise Wrong(path, f"keypoints of the {len(frames)} frames of the track (frames {frames[0]} to {frames[-1]} of "
                    "the video), or of the whole video", f"{len(points)} frames")
    out = np.zeros((len(frames), *points.shape[1:]))
    out[seen] = points[np.searchsorted(at, frames[seen])]
    return out


def slam_of(path, frames):
    """Turns (T, 3, 3), camera to SLAM's world, and places (T, 3) up to a scale: DPVO's x y z, quaternion x y z w.
    GVHMR's SimpleVO has matrices (T, 4, 4), world to camera, and estimates their turns alone: no places."""
    expected = "a camera's path: (T, 7), place and quaternion x y z w, or (T, 4, 4)"
    rows = read(path, "a camera's path")
    matrix = np.ndim(rows) == 3 and np.shape(rows)[1:] == (4, 4)
    if not matrix and (np.ndim(rows) != 2 or np.shape(rows)[1] < 7):
        raise Wrong(path, expected, kind_of(rows))
    if len(rows) <= frames.max():
        raise Wrong(path, f"{expected} for {frames.max() + 1} frames", f"{len(rows)}")
    rows = np.asarray(rows, float)[frames]
    if matrix:
        return rows[:, :3, :3].transpose(0, 2, 1), None
    x, y, z, w = (rows[:, 3:7] / np.linalg.norm(rows[:, 3:7], axis=1, keepdims=True)).T
    half = np.arctan2(np.sqrt(x * x + y * y + z * z), w)
    return matrices(np.stack([x, y, z], 1) * (2 * half / np.maximum(np.sin(half), 1e-12))[:, None]), rows[:, :3]


def mean_turn(turns):
    u, _, v = np.linalg.svd(turns.sum(0))
    return u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v


def frame_by_frame(turn, pelvis, pelvis_camera):
    """World to camera, (T, 4, 4): in every frame what puts the pelvis where it was estimated in front of it."""
    out = np.tile(np.eye(4), (len(turn), 1, 1))
    out[:, :3, :3] = turn
    out[:, :3, 3] = pelvis_camera - np.einsum("tij,tj->ti", turn, pelvis)
    return out


def camera_path(turn, pelvis, pelvis_camera, slam_turn, slam_place):
    """World to camera, (T, 4, 4), by one turn, one scale and one place of SLAM's world in ours: those under which the
    pelvis is where it was estimated in front of the camera, distances counted once, not squared (outliers). Where SLAM
    has no places, its turns alone."""
    whole = mean_turn(slam_turn @ turn)
    if slam_place is None:
        return frame_by_frame(slam_turn.transpose(0, 2, 1) @ whole, pelvis, pelvis_camera)
    gap = (np.einsum("ij,tj->ti", whole, pelvis) - np.einsum("tij,tj->ti", slam_turn, pelvis_camera)).reshape(-1)
    columns = np.hstack([slam_place.reshape(-1, 1), np.tile(np.eye(3), (len(turn), 1))])
    weight = np.ones(len(turn))
    for _ in range(10):
        w = np.repeat(np.sqrt(weight), 3)
        found = np.linalg.lstsq(columns * w[:, None], gap * w, rcond=None)[0]
        weight = 1 / np.maximum(np.linalg.norm((columns @ found - gap).reshape(-1, 3), axis=1), 0.01)
    out = np.tile(np.eye(4), (len(turn), 1, 1))
    out[:, :3, :3] = slam_turn.transpose(0, 2, 1) @ whole
    out[:, :3, 3] = -np.einsum("tji,tj->ti", slam_turn, (columns @ found).reshape(-1, 3))
    return out


def cameras(turn, pelvis, pelvis_camera, frames, options):
    """World to camera, (T, 4, 4), or (4, 4) of one that stood still."""
    if options.static:
        still = np.tile(np.eye(3), (len(turn), 1, 1)), np.zeros((len(turn), 3))
        return camera_path(turn, pelvis, pelvis_camera, *still)[0]
    if options.slam:
        return camera_path(turn, pelvis, pelvis_camera, *slam_of(options.slam, frames))
    return frame_by_frame(turn, pelvis, pelvis_camera)


def rate_of(track, options):
    """Frames per second: those asked for, those of the results, or 30."""
    return options.fps or getattr(track, "fps", None) or 30.0


def motion_of(track, first, last, points, intrinsics, options):
    """Members of the npz for a piece of a track."""
    pose, model = track.pose[first:last], track.model
    root, pelvis = matrices(pose[:, :3]), track.pelvis[first:last] @ Y_TO_Z.T
    out = {"poses": np.hstack([vectors(Y_TO_Z @ root), pose[:, 3:]]), "trans": pelvis - J0[model],
           "betas": track.betas[0], "mocap_framerate": rate_of(track, options), "body_model": model, "gender": "neutral"}
    if points is None:
        return out
    turn = matrices(track.root_camera[first:last]) @ root.transpose(0, 2, 1) @ Y_TO_Z.T
    out.update(keypoints_2d=points[first:last], camera_intrinsics=intrinsics,
               camera_extrinsics=cameras(turn, pelvis, track.pelvis_camera[first:last],
                                         track.frames[first:last], options))
    if points.shape[1] == len(COCO17):  # of other numbers mimicx says what it takes them for
        out["keypoint_names"] = np.array(COCO17)
    return out


def intrinsics_of(track, size, parser):
    if track.intrinsics is not None:
        return np.asarray(track.intrinsics, float).reshape(-1, 3, 3)[0]
    if not size:
        parser.error("--size W H is needed: the results hold no focal length")
    focal = np.hypot(*size)
    return np.array([[focal, 0, size[0] / 2], [0, focal, size[1] / 2], [0, 0, 1]])


def a_rate(text):
    rate = float(text)
    if not 0.1 <= rate <= 2000:  # false for nan
        raise argparse.ArgumentTypeError(f"{text}: frames per second, 0.1 to 2000, are expected")
    return rate


def files_of(results, base, options, parser):
    """[(file, what is in it, members or positions)] of one result; no file for what is left out."""
    tracks = tracks_of(results, options.size)
    if options.person is not None:
        tracks = {person: track for person, track in tracks.items() if str(person) == options.person}
    data = read(options.keypoints, "keypoints (T, K, 3)") if options.keypoints else None
    if data is not None and len(tracks) > 1 and (not isinstance(data, dict) or "keypoints" in data):
        parser.error("--keypoints are of one person: --person " + " or ".join(str(person) for person in tracks))
    files = []
    for person, track in tracks.items():
        positions = isinstance(track, Positions)
        if options.keypoints and positions:
            parser.error("--keypoints are for results with SMPL's parameters")
        if options.keypoints and not (options.static or options.slam or options.moving or track.tells_camera):
            parser.error("--keypoints needs a camera: --static where it stood still, --slam FILE, or else --moving")
        points = keypoints_of(options.keypoints, data, person, track.frames) if options.keypoints else None
        intrinsics = intrinsics_of(track, options.size, parser) if options.keypoints else None
        assumed = "" if options.fps or getattr(track, "fps", None) else ", 30 fps assumed (--fps)"
        pieces = track.pieces()
        for first, last in pieces:
            begin, end = track.frames[first], track.frames[last - 1]
            what = f"person {person}, frames {begin} to {end}"
            if last - first < options.shortest and (len(tracks) > 1 or len(pieces) > 1) and not (positions and track.fps):
                files.append(("", f"{what}: left out, shorter than {options.shortest} frames", None))
                continue
            name = base + (f"_person{person}" if len(tracks) > 1 else "") + (
                f"_from{begin}" if len(pieces) > 1 else "") + (".npy" if positions else ".npz")
            if positions:
                fps = rate_of(track, options)
                hint = "" if fps == 20.0 else f"; read it with: mimicx ... --fps {fps:g}"
                files.append((name, f"{what}, {track.model}{assumed}{hint}", track.positions[first:last]))
            else:
                keypoints = ", with keypoints" if options.keypoints else ""
                files.append((name, f"{what}, {track.model}{keypoints}{assumed}",
                              motion_of(track, first, last, points, intrinsics, options)))
    if not any(name for name, _, _ in files):
        raise Wrong(results, "a person" + (f" called {options.person}" if options.person is not None else ""), "none")
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+")
    parser.add_argument("out", help="a file; a folder for several results")
    parser.add_argument("--keypoints", help="(T, K, 3): u, v, confidence, of one person's track or of the whole video; "
                        ".npy, .npz, .pt or pickle; or WHAM's tracking_results.pth")
    parser.add_argument("--size", nargs=2, type=float, metavar=("W", "H"), help="of the picture, pixels")
    parser.add_argument("--person", "--subject", help="one of several, by its name in the results")
    camera = parser.add_mutually_exclusive_group()
    camera.add_argument("--static", action="store_true", help="the camera stood still")
    camera.add_argument("--slam", metavar="FILE", help="its path: GVHMR's slam_results.pt, WHAM's slam_results.pth")
    camera.add_argument("--moving", action="store_true", help="it moved, and nothing else is known")
    parser.add_argument("--shortest", type=int, default=30, metavar="FRAMES", help="pieces that are shorter are left "
                        "out (default: 30)")
    parser.add_argument("--fps", type=a_rate, help="of the video (default: that of the results, or 30, which is said)")
    a = parser.parse_args()
    if a.keypoints and len(a.results) > 1:
        parser.error("--keypoints belong to one result")
    into_folder = len(a.results) > 1 or os.path.isdir(a.out)
    files = []
    for results in a.results:
        stem = os.path.splitext(os.path.basename(os.path.abspath(results)))[0]
        base = os.path.join(a.out, stem) if into_folder else a.out.removesuffix(".npz").removesuffix(".npy")
        files += files_of(results, base, a, parser)
    names = [name for name, _, _ in files if name]
    for name in names:
        if os.path.exists(name) or names.count(name) > 1:
            raise Wrong(name, "a name that is free", "a file, which is not overwritten" if os.path.exists(name)
                        else "two results of that name")
    if into_folder:
        os.makedirs(a.out, exist_ok=True)
    for name, what, content in files:
        if content is None:
            print(what)
            continue
        if isinstance(content, dict):
            np.savez(name, **content)
        else:
            np.save(name, content.astype(np.float32))
        print(f"{name}: {what}")


if __name__ == "__main__":
    try:
        main()
    except Wrong as wrong:
        sys.exit(f"convert_video_results.py: {wrong}")
    except Exception as error:  # whatever else a damaged file leads to: one line
        sys.exit(f"convert_video_results.py: {' '.join(sys.argv[1:3])}: {type(error).__name__}: {error}")

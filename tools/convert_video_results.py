#!/usr/bin/env python3
"""Results of video estimators to the npz that mimicx reads: GVHMR, WHAM and TRAM, with keypoints (ViTPose's COCO-17).

    convert_video_results.py hmr4d_results.pt OUT.npz [--keypoints vitpose.pt --static]                    GVHMR
    convert_video_results.py wham_output.pkl OUT.npz [--keypoints tracking_results.pth --slam slam_results.pth
                                                      --size W H]                                          WHAM
    convert_video_results.py results/VIDEO OUT.npz [--keypoints K.npy]      TRAM: a folder with camera.npy and hps/

Every person gets a file, and every piece of a person's track that has no gap: OUT.npz where there is but one, else
OUT_person2.npz or OUT_person2_from310.npz (frame of the video). Pieces shorter than --shortest frames are left out.

Needs NumPy alone, and pickled_arrays.py beside it, which never runs what is in a pickle. GVHMR and WHAM tell no camera,
but where the motion is in the world (y up) and where in front of the camera. What takes one to the other is the camera
of a frame, with all errors of both; the keypoint fit needs better. --static makes one camera of all frames, --slam
lays the camera's path, which both estimators leave beside their results, through them; --moving takes them as they are.
TRAM tells its camera. WHAM keeps no focal length: --size gives the picture's diagonal, which is what it assumes.
"""
import argparse
import glob
import os
import sys

import numpy as np

from pickled_arrays import load

J0 = {"smplx": np.array([0.003, -0.351, 0.012]), "smpl": np.array([-0.002, -0.223, 0.028])}  # rest pelvis, m
MID_HIP = np.array([-0.001, -0.086, -0.016])  # of SMPL at rest, from its pelvis, m
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

    def __init__(self, model, pose, root_camera, pelvis, pelvis_camera, betas, intrinsics=None, frames=None):
        self.model, self.intrinsics = model, intrinsics
        self.pose, self.root_camera, self.pelvis, self.pelvis_camera = (
            np.asarray(x, float) for x in (pose, root_camera, pelvis, pelvis_camera))
        self.betas = np.asarray(betas, float).reshape(-1, np.shape(betas)[-1])
        self.frames = np.arange(len(self.pose)) if frames is None else np.asarray(frames, int).reshape(-1)

    def pieces(self):
        """First and last + 1 of every run of frames without a gap."""
        breaks = np.flatnonzero(np.diff(self.frames) != 1) + 1
        return list(zip([0, *breaks], [*breaks, len(self.frames)]))


def gvhmr(data):
    world, camera = data["smpl_params_global"], data["smpl_params_incam"]
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
                 frames)


RESULTS = "results of GVHMR (hmr4d_results.pt), WHAM (wham_output.pkl) or TRAM (the folder of a video)"


def checked(path, make, *data):
    """make(*data), or what is missing in the file."""
    try:
        return make(*data)
    except KeyError as error:
        raise Wrong(path, f"{error} in {RESULTS}", kind_of(data[0])) from error
    except (IndexError, TypeError, AttributeError, ValueError) as error:
        raise Wrong(path, RESULTS, f"{kind_of(data[0])} ({error})") from error


def tracks_of(path):
    """{person: Track}"""
    if os.path.isdir(path):
        files = sorted(glob.glob(os.path.join(path, "hps", "*.npy")), key=lambda f: (len(f), f))
        if not files:
            raise Wrong(path, RESULTS, "a folder without hps/*.npy")
        camera = read(os.path.join(path, "camera.npy"), "TRAM's camera")
        return {os.path.basename(f)[:-4].split("_")[-1]: checked(f, tram, read(f, "TRAM's person"), camera)
                for f in files}
    data = read(path, RESULTS)
    if not isinstance(data, dict):
        raise Wrong(path, RESULTS, kind_of(data) + (
            ": keypoints? They go behind --keypoints" if np.ndim(data) == 3 and np.shape(data)[2] == 3 else ""))
    if "smpl_params_global" in data:
        return {0: checked(path, gvhmr, data)}
    if "pose_world" in data:
        return {0: checked(path, wham, data)}
    if not data or not all(isinstance(one, dict) for one in data.values()):
        raise Wrong(path, RESULTS, kind_of(data))
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
    """Turns (T, 3, 3), camera to SLAM's world, and places (T, 3) up to a scale: DPVO's x y z, quaternion x y z w."""
    expected, rows = "a camera's path (T, 7): place and quaternion x y z w", read(path, "a camera's path")
    if np.ndim(rows) != 2 or np.shape(rows)[1] < 7:
        raise Wrong(path, expected, kind_of(rows))
    if len(rows) <= frames.max():
        raise Wrong(path, f"{expected} for {frames.max() + 1} frames", f"{len(rows)}")
    rows = np.asarray(rows, float)[frames]
    x, y, z, w = (rows[:, 3:7] / np.linalg.norm(rows[:, 3:7], axis=1, keepdims=True)).T
    half = np.arctan2(np.sqrt(x * x + y * y + z * z), w)
    return matrices(np.stack([x, y, z], 1) * (2 * half / np.maximum(np.sin(half), 1e-12))[:, None]), rows[:, :3]


def mean_turn(turns):
    u, _, v = np.linalg.svd(turns.sum(0))
    return u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v


def camera_path(turn, pelvis, pelvis_camera, slam_turn, slam_place):
    """World to camera, (T, 4, 4), by one turn, one scale and one place of SLAM's world in ours: those under which the
    pelvis is where it was estimated in front of the camera, distances counted once, not squared (outliers)."""
    whole = mean_turn(slam_turn @ turn)
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
    out = np.tile(np.eye(4), (len(turn), 1, 1))
    out[:, :3, :3] = turn
    out[:, :3, 3] = pelvis_camera - np.einsum("tij,tj->ti", turn, pelvis)
    return out


def motion_of(track, first, last, points, intrinsics, options):
    """Members of the npz for a piece of a track."""
    pose, model = track.pose[first:last], track.model
    root, pelvis = matrices(pose[:, :3]), track.pelvis[first:last] @ Y_TO_Z.T
    out = {"poses": np.hstack([vectors(Y_TO_Z @ root), pose[:, 3:]]), "trans": pelvis - J0[model],
           "betas": track.betas[0], "mocap_framerate": options.fps, "body_model": model, "gender": "neutral"}
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results")
    parser.add_argument("out")
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
    parser.add_argument("--fps", type=float, default=30.0, help="of the video")
    a = parser.parse_args()
    tracks = tracks_of(a.results)
    if a.person is not None:
        tracks = {person: track for person, track in tracks.items() if str(person) == a.person}
    if a.keypoints and not (a.static or a.slam or a.moving or os.path.isdir(a.results)):
        parser.error("--keypoints needs a camera: --static where it stood still, --slam FILE, or else --moving")
    data, written = read(a.keypoints, "keypoints (T, K, 3)") if a.keypoints else None, 0
    for person, track in tracks.items():
        points = keypoints_of(a.keypoints, data, person, track.frames) if a.keypoints else None
        intrinsics = intrinsics_of(track, a.size, parser) if a.keypoints else None
        pieces = track.pieces()
        for first, last in pieces:
            begin, end = track.frames[first], track.frames[last - 1]
            what = f"person {person}, frames {begin} to {end}"
            if last - first < a.shortest and (len(tracks) > 1 or len(pieces) > 1):
                print(f"{what}: left out, shorter than {a.shortest} frames")
                continue
            name = a.out.removesuffix(".npz") + (f"_person{person}" if len(tracks) > 1 else "") + (
                f"_from{begin}" if len(pieces) > 1 else "") + ".npz"
            np.savez(name, **motion_of(track, first, last, points, intrinsics, a))
            written += 1
            print(f"{name}: {what}, {track.model}" + (", with keypoints" if a.keypoints else ""))
    if not written:
        raise Wrong(a.results, "a person" + (f" called {a.person}" if a.person is not None else ""), "none")


if __name__ == "__main__":
    try:
        main()
    except Wrong as wrong:
        sys.exit(f"convert_video_results.py: {wrong}")
    except Exception as error:  # whatever else a damaged file leads to: one line
        sys.exit(f"convert_video_results.py: {' '.join(sys.argv[1:3])}: {type(error).__name__}: {error}")

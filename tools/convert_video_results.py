#!/usr/bin/env python3
"""Results of video estimators to the npz that mimicx reads: GVHMR and WHAM, with ViTPose keypoints (COCO-17).

    convert_video_results.py hmr4d_results.pt OUT.npz [--keypoints vitpose.pt]
    convert_video_results.py wham_output.pkl OUT.npz [--subject 0] [--keypoints K.npy --size W H]

Needs NumPy alone. Pickles run code when they are read carelessly: here only arrays, numbers, text, lists and
dictionaries are made, anything else is refused. Plain pickles, joblib's uncompressed ones and torch's zip files (.pt)
are read, without torch or joblib, and .npz/.npy. The camera of a frame is what takes the motion in the world (y up) to
the same motion in front of the camera. WHAM keeps no focal length: with keypoints, --size gives the picture's diagonal,
which is what WHAM assumes.
"""
import argparse
import pickle
import sys
import zipfile

import numpy as np

J0 = {"smplx": np.array([0.003, -0.351, 0.012]), "smpl": np.array([-0.002, -0.223, 0.028])}  # rest pelvis, m
Y_TO_Z = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])
COCO17 = ["nose"] + [side + part for part in ("eye", "ear", "shoulder", "elbow", "wrist", "hip", "knee", "ankle")
                     for side in ("left_", "right_")]
STORAGES = {"FloatStorage": "<f4", "DoubleStorage": "<f8", "LongStorage": "<i8", "BoolStorage": "?"}


class JoblibArray:
    """Stands for joblib's NumpyArrayWrapper: the elements follow in the file."""

    def read(self, file):
        if self.dtype.hasobject:
            raise pickle.UnpicklingError("an array of objects is not read")
        if getattr(self, "numpy_array_alignment_bytes", None) is not None:
            file.read(file.read(1)[0])
        size = int(np.prod(self.shape, dtype=np.int64)) * self.dtype.itemsize
        return np.frombuffer(file.read(size), self.dtype).reshape(self.shape, order=self.order)


def tensor(storage, offset, size, stride, *_):
    step = storage.dtype.itemsize
    if any(s < 0 for s in stride) or offset + sum((n - 1) * s for n, s in zip(size, stride)) >= max(storage.size, 1):
        raise pickle.UnpicklingError("a tensor outside its storage")
    return np.lib.stride_tricks.as_strided(storage[offset:], size, [s * step for s in stride]).copy()


class Unpickler(pickle._Unpickler):  # the one in Python: joblib's arrays stand between the opcodes
    def __init__(self, file, storages=None):
        super().__init__(file)
        self.file, self.storages = file, storages

    def find_class(self, module, name):
        if module in ("numpy.core.multiarray", "numpy._core.multiarray") and name in ("_reconstruct", "scalar"):
            return getattr(getattr(np, "_core", None) or np.core, "multiarray").__dict__[name]
        known = {("numpy", "ndarray"): np.ndarray, ("numpy", "dtype"): np.dtype, ("builtins", "dict"): dict,
                 ("collections", "OrderedDict"): dict, ("collections", "defaultdict"): lambda *_: {},
                 ("_codecs", "encode"): lambda text, coding: text.encode("latin1"),
                 ("joblib.numpy_pickle", "NumpyArrayWrapper"): JoblibArray,
                 ("torch._utils", "_rebuild_tensor_v2"): tensor}
        if module == "torch" and name in STORAGES:
            return np.dtype(STORAGES[name])
        if (module, name) not in known:
            raise pickle.UnpicklingError(f"{module}.{name} is not data: refused")
        return known[module, name]

    def persistent_load(self, pid):
        if self.storages is None or pid[0] != "storage":
            raise pickle.UnpicklingError("a reference outside the file")
        return np.frombuffer(self.storages(pid[2]), pid[1])

    def load_build(self):
        super().load_build()
        if isinstance(self.stack[-1], JoblibArray):
            self.stack[-1] = self.stack[-1].read(self.file)

    dispatch = {**pickle._Unpickler.dispatch, pickle.BUILD[0]: load_build}


def load(path):
    if path.endswith((".npz", ".npy")):
        data = np.load(path, allow_pickle=False)
        return dict(data) if path.endswith(".npz") else data
    if not zipfile.is_zipfile(path):
        with open(path, "rb") as file:
            return Unpickler(file).load()
    archive = zipfile.ZipFile(path)
    index = next(n for n in archive.namelist() if n.endswith("data.pkl"))
    return Unpickler(archive.open(index), lambda key: archive.read(f"{index[:-8]}data/{key}")).load()


def matrices(r):
    """Rotation vectors (T, 3) to matrices (T, 3, 3)."""
    angle = np.linalg.norm(r, axis=1, keepdims=True)
    x, y, z = (r / np.maximum(angle, 1e-12)).T
    o, a = np.zeros_like(x), angle[:, :, None]
    k = np.stack([o, -z, y, z, o, -x, -y, x, o], 1).reshape(-1, 3, 3)
    return np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * k @ k


def y_to_z(r):
    """Rotation vectors (T, 3) after a quarter turn about x: the product of the quaternions."""
    half = np.linalg.norm(r, axis=1) / 2
    w, (x, y, z) = np.cos(half), (r * (np.sinc(half / np.pi) / 2)[:, None]).T
    q = np.sqrt(0.5) * np.stack([w - x, x + w, y - z, z + y], 1)
    q *= np.where(q[:, :1] < 0, -1.0, 1.0)
    sine = np.linalg.norm(q[:, 1:], axis=1)
    return q[:, 1:] * (2 * np.arctan2(sine, q[:, 0]) / np.maximum(sine, 1e-12))[:, None]


def motion_of(data, subject):
    """Body model, poses in the world and in the camera, translations in both, betas, intrinsics or None."""
    if "smpl_params_global" in data:
        world, camera = data["smpl_params_global"], data["smpl_params_incam"]
        pose = [np.hstack([p["global_orient"], p["body_pose"]]) for p in (world, camera)]
        return "smplx", *pose, world["transl"], camera["transl"], world["betas"], data.get("K_fullimg")
    d = data if "pose_world" in data else data[subject]
    return "smpl", d["pose_world"], d["pose"], d["trans_world"], d["trans"], d["betas"], None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results")
    parser.add_argument("out")
    parser.add_argument("--keypoints", help="(T, 17, 3): u, v, confidence; .npy, .npz, .pt or pickle")
    parser.add_argument("--size", nargs=2, type=float, metavar=("W", "H"), help="of the picture, pixels")
    parser.add_argument("--subject", type=int, default=0, help="which person of WHAM's results")
    parser.add_argument("--fps", type=float, default=30.0, help="of the video")
    a = parser.parse_args()
    model, *arrays, intrinsics = motion_of(load(a.results), a.subject)
    world, camera, trans, trans_camera, betas = (np.asarray(x, float) for x in arrays)
    root, j0 = matrices(world[:, :3]), J0[model]
    out = {"poses": np.hstack([y_to_z(world[:, :3]), world[:, 3:]]), "trans": (trans + j0) @ Y_TO_Z.T - j0,
           "betas": betas.reshape(-1, betas.shape[-1])[0], "mocap_framerate": a.fps, "body_model": model,
           "gender": "neutral"}
    if a.keypoints:
        points = load(a.keypoints)
        points = np.asarray(points["keypoints"] if isinstance(points, dict) else points, float)
        if intrinsics is None:
            if not a.size:
                parser.error("--size W H is needed: the results hold no focal length")
            focal = np.hypot(*a.size)
            intrinsics = np.array([[focal, 0, a.size[0] / 2], [0, focal, a.size[1] / 2], [0, 0, 1]])
        turn = matrices(camera[:, :3]) @ root.transpose(0, 2, 1) @ Y_TO_Z.T
        extrinsics = np.tile(np.eye(4), (len(turn), 1, 1))
        extrinsics[:, :3, :3] = turn
        extrinsics[:, :3, 3] = trans_camera + j0 - np.einsum("tij,tj->ti", turn, out["trans"] + j0)
        out.update(keypoints_2d=points, keypoint_names=np.array(COCO17), camera_extrinsics=extrinsics,
                   camera_intrinsics=np.asarray(intrinsics, float).reshape(-1, 3, 3)[0])
    np.savez(a.out, **out)
    print(f"{a.out}: {len(world)} frames, {model}" + (", with keypoints" if a.keypoints else ""))


if __name__ == "__main__":
    try:
        main()
    except Exception as error:  # whatever a damaged file leads to: one line
        sys.exit(f"convert_video_results.py: {sys.argv[1] if len(sys.argv) > 1 else ''}: {error}")

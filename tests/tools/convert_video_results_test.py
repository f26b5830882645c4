#!/usr/bin/env python3
"""tools/convert_video_results.py on results made here: values, cameras, containers, refusals.

    convert_video_results_test.py TOOL        exit status 77: no NumPy here, skipped
"""
import io
import os
import pickle
import subprocess
import sys
import tempfile
import types
import zipfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

TOOL = sys.argv[1]
FRAMES = 7
J0 = np.array([0.003, -0.351, 0.012])
random = np.random.default_rng(5)


def rotation(r):
    angle = np.linalg.norm(r)
    x, y, z = r / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def vector(m):
    """Only for angles well inside (0, pi)."""
    angle = np.arccos((np.trace(m) - 1) / 2)
    return angle / (2 * np.sin(angle)) * np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])


# A motion in a y-up world, and what a tilted camera sees of it.
CAMERA, PLACE = rotation(np.array([2.5, 0.3, -0.2])), np.array([0.4, 1.2, 5.0])
GLOBAL = {"global_orient": 0.4 * random.normal(size=(FRAMES, 3)), "body_pose": 0.3 * random.normal(size=(FRAMES, 63)),
          "transl": random.normal(size=(FRAMES, 3)), "betas": np.tile(random.normal(size=10), (FRAMES, 1))}
INCAM = dict(GLOBAL, global_orient=np.array([vector(CAMERA @ rotation(r)) for r in GLOBAL["global_orient"]]),
             transl=(GLOBAL["transl"] + J0) @ CAMERA.T + PLACE - J0)
K = np.array([[900.0, 0, 480], [0, 900, 270], [0, 0, 1]])
GVHMR = {"smpl_params_global": GLOBAL, "smpl_params_incam": INCAM, "K_fullimg": np.tile(K, (FRAMES, 1, 1))}
POINTS = random.uniform(size=(FRAMES, 17, 3))


def convert(results, *more):
    run = subprocess.run([sys.executable, TOOL, results, "out.npz", *more], capture_output=True, text=True)
    return run.returncode, run.stderr, dict(np.load("out.npz")) if run.returncode == 0 else None


def check_gvhmr(path):
    np.save("points.npy", POINTS)
    status, complaint, out = convert(path, "--keypoints", "points.npy")
    assert status == 0, complaint
    y_to_z = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    pelvis = out["trans"] + J0
    assert np.allclose(pelvis, (GLOBAL["transl"] + J0) @ y_to_z.T, atol=1e-6)
    for t in range(FRAMES):
        root = rotation(out["poses"][t, :3])
        assert np.allclose(root, y_to_z @ rotation(GLOBAL["global_orient"][t]), atol=1e-6)
        seen = out["camera_extrinsics"][t] @ np.append(pelvis[t], 1)
        assert np.allclose(seen[:3], INCAM["transl"][t] + J0, atol=1e-6)
        assert np.allclose(out["camera_extrinsics"][t][:3, :3] @ root, rotation(INCAM["global_orient"][t]), atol=1e-6)
    assert np.allclose(out["poses"][:, 3:], GLOBAL["body_pose"], atol=1e-6)
    assert np.allclose(out["camera_intrinsics"], K) and np.allclose(out["keypoints_2d"], POINTS)
    assert list(out["keypoint_names"])[5:9] == ["left_shoulder", "right_shoulder", "left_elbow", "right_elbow"]
    assert out["body_model"] == "smplx" and np.allclose(out["betas"], GLOBAL["betas"][0], atol=1e-6)


def check_plain_pickle():
    with open("results.pkl", "wb") as file:
        pickle.dump(GVHMR, file)
    check_gvhmr("results.pkl")


def check_torch_zip():
    """A .pt file by the layout that torch.save writes: data.pkl and one file per storage."""
    class FloatStorage:
        pass

    def _rebuild_tensor_v2():
        pass

    torch, utils = types.ModuleType("torch"), types.ModuleType("torch._utils")
    FloatStorage.__module__, FloatStorage.__qualname__ = "torch", "FloatStorage"
    _rebuild_tensor_v2.__module__, _rebuild_tensor_v2.__qualname__ = "torch._utils", "_rebuild_tensor_v2"
    torch.FloatStorage, utils._rebuild_tensor_v2, torch._utils = FloatStorage, _rebuild_tensor_v2, utils
    sys.modules.update({"torch": torch, "torch._utils": utils})
    storages = []

    class Storage:
        def __init__(self, array):
            self.key = str(len(storages))
            storages.append(np.ascontiguousarray(array, "<f4").tobytes())

    class Tensor:
        def __init__(self, array):
            self.array, self.storage = array, Storage(array)

        def __reduce__(self):
            stride = tuple(s // self.array.itemsize for s in np.ascontiguousarray(self.array).strides)
            return _rebuild_tensor_v2, (self.storage, 0, self.array.shape, stride, False, {})

    class Pickler(pickle.Pickler):
        def persistent_id(self, value):
            return ("storage", FloatStorage, value.key, "cpu", 0) if isinstance(value, Storage) else None

    def tensors(value):
        return {k: tensors(v) for k, v in value.items()} if isinstance(value, dict) else Tensor(value)

    data = io.BytesIO()
    Pickler(data, 2).dump(tensors(GVHMR))
    with zipfile.ZipFile("results.pt", "w") as archive:
        archive.writestr("archive/data.pkl", data.getvalue())
        for key, storage in enumerate(storages):
            archive.writestr(f"archive/data/{key}", storage)
    check_gvhmr("results.pt")


def wham():
    poses = {name: np.hstack([part["global_orient"], part["body_pose"], np.zeros((FRAMES, 6))])
             for name, part in (("pose_world", GLOBAL), ("pose", INCAM))}
    return {0: dict(poses, trans_world=GLOBAL["transl"], trans=INCAM["transl"], betas=GLOBAL["betas"])}


def check_joblib():
    """As joblib.dump writes it, uncompressed: the elements of an array follow its wrapper in the file."""
    class NumpyArrayWrapper:
        def __init__(self, array):
            self.subclass, self.shape, self.order, self.dtype = np.ndarray, array.shape, "C", array.dtype
            self.allow_mmap, self.numpy_array_alignment_bytes = True, 16

    package, module = types.ModuleType("joblib"), types.ModuleType("joblib.numpy_pickle")
    NumpyArrayWrapper.__module__, NumpyArrayWrapper.__qualname__ = "joblib.numpy_pickle", "NumpyArrayWrapper"
    module.NumpyArrayWrapper, package.numpy_pickle = NumpyArrayWrapper, module
    sys.modules.update({"joblib": package, "joblib.numpy_pickle": module})

    class Pickler(pickle._Pickler):
        def save(self, value, save_persistent_id=True):
            if not isinstance(value, np.ndarray):
                return super().save(value, save_persistent_id)
            super().save(NumpyArrayWrapper(value))
            self.framer.commit_frame(force=True)
            padding = 16 - (self.file.tell() + 1) % 16
            self.file.write(bytes([padding]) + b"\xff" * padding + np.ascontiguousarray(value).tobytes())

    with open("wham_output.pkl", "wb") as file:
        pickler = Pickler(file, 4)
        pickler.file = file
        pickler.dump(wham())
    status, complaint, out = convert("wham_output.pkl")
    assert status == 0, complaint
    assert out["poses"].shape == (FRAMES, 72) and out["body_model"] == "smpl"
    assert np.allclose(out["poses"][:, 3:66], GLOBAL["body_pose"])
    np.save("points.npy", POINTS)
    assert convert("wham_output.pkl", "--keypoints", "points.npy")[0] == 2, "no focal length without a size"
    status, complaint, out = convert("wham_output.pkl", "--keypoints", "points.npy", "--size", "600", "800")
    assert status == 0 and out["camera_intrinsics"][0, 0] == 1000.0, complaint


def check_refusals():
    class Evil:
        def __reduce__(self):
            return os.mkdir, ("evil",)

    for content in (Evil(), {"smpl_params_global": Evil()}, {"something": 1}, [1, 2]):
        with open("bad.pkl", "wb") as file:
            pickle.dump(content, file)
        status, complaint, _ = convert("bad.pkl")
        assert status == 1 and "bad.pkl" in complaint and complaint.count("\n") == 1, complaint
    assert not os.path.exists("evil"), "code in a pickle was run"
    with open("cut.pkl", "wb") as file:
        file.write(pickle.dumps(GVHMR)[:-100])
    assert convert("cut.pkl")[0] == 1 and convert("none.pkl")[0] == 1


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for check in (check_plain_pickle, check_torch_zip, check_joblib, check_refusals):
        check()
        print(check.__name__, "ok")

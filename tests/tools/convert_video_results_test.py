#!/usr/bin/env python3
"""tools/convert_video_results.py on results made here: values, cameras, containers, refusals.

    convert_video_results_test.py TOOL        exit status 77: no NumPy here, skipped
"""
import io
import os
import pickle
import sys
import tempfile
import types
import zipfile

try:
    import numpy as np
    import python_program
except ImportError:
    sys.exit(77)

TOOL = os.path.abspath(sys.argv[1])
FRAMES = 7
J0 = np.array([0.003, -0.351, 0.012])
SMPL_J0, MID_HIP = np.array([-0.002, -0.223, 0.028]), np.array([-0.001, -0.086, -0.016])
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
    if os.path.exists("out.npz"):
        os.remove("out.npz")  # the tool overwrites nothing
    status, _, complaint = python_program.run(TOOL, results, "out.npz", *more)
    return status, complaint, dict(np.load("out.npz")) if status == 0 else None


def check_gvhmr(path):
    np.save("points.npy", POINTS)
    status, complaint, out = convert(path, "--keypoints", "points.npy", "--moving")
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


def check_compressed_pickles():
    import bz2, gzip, lzma, zlib
    for module in (zlib, gzip, bz2, lzma):
        with open("results.pkl", "wb") as file:
            file.write(module.compress(pickle.dumps(GVHMR)))
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


def wham(frames=FRAMES, begin=0):
    """As WHAM's demo stores a person: `trans` is SMPL's, `trans_world` is where the middle of the hips is."""
    pelvis = np.array([p + rotation(r) @ -MID_HIP for p, r in zip(GLOBAL["transl"], GLOBAL["global_orient"])])
    poses = {name: np.hstack([part["global_orient"], part["body_pose"], np.zeros((FRAMES, 6))])
             for name, part in (("pose_world", GLOBAL), ("pose", INCAM))}
    one = dict(poses, trans_world=GLOBAL["transl"], trans=pelvis @ CAMERA.T + PLACE - SMPL_J0, betas=GLOBAL["betas"])
    return dict({key: np.resize(value, (frames, *value.shape[1:])) for key, value in one.items()},
                frame_ids=begin + np.arange(frames)), pelvis


def dump_joblib(value, path):
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

    with open(path, "wb") as file:
        pickler = Pickler(file, 4)
        pickler.file = file
        pickler.dump(value)


def check_joblib():
    one, pelvis = wham()
    dump_joblib({0: one}, "wham_output.pkl")
    status, complaint, out = convert("wham_output.pkl")
    assert status == 0, complaint
    assert out["poses"].shape == (FRAMES, 72) and out["body_model"] == "smpl"
    assert np.allclose(out["poses"][:, 3:66], GLOBAL["body_pose"])
    assert np.allclose(out["trans"] + SMPL_J0, np.stack([pelvis[:, 0], -pelvis[:, 2], pelvis[:, 1]], 1))
    np.save("points.npy", POINTS)
    size = "--size", "600", "800"
    assert convert("wham_output.pkl", "--keypoints", "points.npy", "--moving")[0] == 2, "no focal length without a size"
    assert convert("wham_output.pkl", "--keypoints", "points.npy", *size)[0] == 2, "what of the camera?"
    status, complaint, out = convert("wham_output.pkl", "--keypoints", "points.npy", "--moving", *size)
    assert status == 0 and out["camera_intrinsics"][0, 0] == 1000.0, complaint
    for t in range(FRAMES):
        seen = out["camera_extrinsics"][t] @ np.append(out["trans"][t] + SMPL_J0, 1)
        assert np.allclose(seen[:3], CAMERA @ pelvis[t] + PLACE)


def check_several_people():
    """Person 0 leaves and comes back, person 1 is seen for a moment, person 2 has keypoints in some frames only."""
    people = {np.int64(0): wham(90)[0], np.int64(1): wham(12, 40)[0], np.int64(2): wham(60, 100)[0]}
    people[0]["frame_ids"] = np.r_[5:45, 70:115, 300:305]
    tracker = {person: {"frame_id": p["frame_ids"], "keypoints": person + random.uniform(size=(len(p["pose"]), 17, 3))}
               for person, p in people.items()}
    counted = np.arange(1.0, 41)[:, None, None] * np.ones((17, 3))
    tracker[2] = {"frame_id": np.r_[110:130, 140:160], "keypoints": counted}
    dump_joblib(people, "wham_output.pkl")
    dump_joblib(tracker, "tracking_results.pth")
    more = "--keypoints", "tracking_results.pth", "--moving", "--size", "600", "800"
    for name in os.listdir("."):
        if name.startswith("all"):
            os.remove(name)
    status, out, complaint = python_program.run(TOOL, "wham_output.pkl", "all.npz", *more)
    assert status == 0, complaint
    lines = out.splitlines()
    assert lines == ["all_person0_from5.npz: person 0, frames 5 to 44, smpl, with keypoints, 30 fps assumed (--fps)",
                     "all_person0_from70.npz: person 0, frames 70 to 114, smpl, with keypoints, 30 fps assumed (--fps)",
                     "person 0, frames 300 to 304: left out, shorter than 30 frames",
                     "person 1, frames 40 to 51: left out, shorter than 30 frames",
                     "all_person2.npz: person 2, frames 100 to 159, smpl, with keypoints, 30 fps assumed (--fps)"], lines
    later = np.load("all_person0_from70.npz")
    assert np.allclose(later["poses"][:, 3:], people[0]["pose_world"][40:85, 3:])
    assert np.array_equal(later["keypoints_2d"], tracker[0]["keypoints"][40:85])
    assert later["camera_extrinsics"].shape == (45, 4, 4)
    points = np.load("all_person2.npz")["keypoints_2d"]
    assert not points[:10].any() and not points[30:40].any(), "frames that the tracker does not have"
    assert np.array_equal(points[10:30], counted[:20])
    assert np.array_equal(points[40:], counted[20:])
    assert convert("wham_output.pkl", "--person", "2", *more)[0] == 0
    assert convert("wham_output.pkl", "--person", "9")[0] == 1, "there is no such person"


def dump_tensors(value):
    """A dictionary of tensors as np.save pickles it, each by the bytes of torch.save before its zip files."""
    class FloatStorage:
        pass

    class LongStorage:
        pass

    def _rebuild_tensor_v2():
        pass

    def _load_from_bytes():
        pass

    torch, utils, place = (types.ModuleType(name) for name in ("torch", "torch._utils", "torch.storage"))
    for thing, module in ((FloatStorage, torch), (LongStorage, torch), (_rebuild_tensor_v2, utils),
                          (_load_from_bytes, place)):
        thing.__module__, thing.__qualname__ = module.__name__, thing.__name__
        setattr(module, thing.__name__, thing)
    sys.modules.update({"torch": torch, "torch._utils": utils, "torch.storage": place})

    class Storage:
        def __init__(self, array):
            self.array, self.type = (array.astype("<i8"), LongStorage) if array.dtype.kind == "i" else (
                array.astype("<f4"), FloatStorage)

        def __reduce__(self):
            class Legacy(pickle.Pickler):
                def persistent_id(self, value):
                    size = value.array.size if type(value) is Storage else None
                    return None if size is None else ("storage", value.type, "94", "cpu", size, None)

            file = io.BytesIO()
            for header in (0x1950a86a20f9469cfc6c, 1001, {"protocol_version": 1001, "little_endian": True}):
                pickle.dump(header, file, 2)
            Legacy(file, 2).dump(self)
            pickle.dump(["94"], file, 2)
            file.write(np.int64(self.array.size).tobytes() + self.array.tobytes())
            return _load_from_bytes, (file.getvalue(),)

    class Tensor:
        def __init__(self, array):
            self.array = np.ascontiguousarray(array)

        def __reduce__(self):
            strides = tuple(s // self.array.itemsize for s in self.array.strides)
            return _rebuild_tensor_v2, (Storage(self.array), 0, self.array.shape, strides, False, {})

    return {key: Tensor(array) for key, array in value.items()}


def check_tram():
    """A folder: hps/hps_track_K.npy in front of the camera, camera.npy with the camera's places in a y-up world."""
    frames = np.r_[3:43]
    camera_R = np.array([CAMERA.T @ rotation(np.array([0.1, 0.02 * t, 0.05])) for t in range(50)])
    camera_T = np.array([[0.1 * t, 1.3, 0.2] for t in range(50)])
    rotmat = np.array([[rotation(0.2 * random.normal(size=3)) for _ in range(24)] for _ in frames])
    trans = random.normal(size=(len(frames), 1, 3)) + [0, 0, 5]
    os.makedirs("video/hps")
    np.save("video/hps/hps_track_0.npy", dump_tensors({"pred_rotmat": rotmat, "pred_trans": trans, "frame": frames,
                                                       "pred_shape": random.normal(size=(len(frames), 10))}))
    np.save("video/camera.npy", {"world_cam_R": camera_R, "world_cam_T": camera_T, "img_focal": np.float64(900.0),
                                 "img_center": np.array([480.0, 270.0])})
    np.save("points.npy", random.uniform(size=(50, 17, 3)))
    status, complaint, out = convert("video", "--keypoints", "points.npy")
    assert status == 0, complaint
    assert np.array_equal(out["keypoints_2d"], np.load("points.npy")[3:43])
    y_to_z = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    for t, frame in enumerate(frames):
        pelvis = camera_R[frame] @ (trans[t, 0] + SMPL_J0) + camera_T[frame]
        assert np.allclose(out["trans"][t] + SMPL_J0, y_to_z @ pelvis, atol=1e-5)
        assert np.allclose(rotation(out["poses"][t, :3]), y_to_z @ camera_R[frame] @ rotmat[t, 0], atol=1e-5)
        assert np.allclose(rotation(out["poses"][t, 30:33]), rotmat[t, 10], atol=1e-5)
        seen = out["camera_extrinsics"][t] @ np.append(out["trans"][t] + SMPL_J0, 1)
        assert np.allclose(seen[:3], trans[t, 0] + SMPL_J0, atol=1e-5)
    assert out["camera_intrinsics"][0, 0] == 900.0 and out["camera_intrinsics"][1, 2] == 270.0


def check_a_static_camera():
    """Places in front of the camera that tremble make the camera tremble, unless it is said to stand."""
    trembling = dict(INCAM, transl=INCAM["transl"] + 0.05 * random.normal(size=(FRAMES, 3)))
    with open("results.pkl", "wb") as file:
        pickle.dump(dict(GVHMR, smpl_params_incam=trembling), file)
    np.save("points.npy", POINTS)
    y_to_z = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    _, _, each = convert("results.pkl", "--keypoints", "points.npy", "--moving")
    status, complaint, one = convert("results.pkl", "--keypoints", "points.npy", "--static")
    assert status == 0, complaint
    assert one["camera_extrinsics"].shape == (4, 4)
    assert np.allclose(one["camera_extrinsics"][:3, :3], CAMERA @ y_to_z.T, atol=1e-6)
    errors = np.linalg.norm(each["camera_extrinsics"][:, :3, 3] - PLACE, axis=1)
    assert np.linalg.norm(one["camera_extrinsics"][:3, 3] - PLACE) < errors.mean()
    assert one["camera_extrinsics"][3].tolist() == [0, 0, 0, 1]


def check_a_camera_path():
    """A SLAM's path, in a world of its own turn, place and scale, gives the true cameras; wild frames do not matter."""
    frames = 60
    turns = np.array([rotation(np.array([2.5, 0.3 + 0.01 * t, -0.2])) for t in range(frames)])  # y-up world to camera
    eyes = np.array([[0.05 * t, 1.4 + 0.2 * np.sin(0.1 * t), -4.0] for t in range(frames)])
    roots = np.array([rotation(r) for r in 0.4 * random.normal(size=(frames, 3))])
    pelvis = random.normal(size=(frames, 3))
    seen = np.einsum("tij,tj->ti", turns, pelvis - eyes)
    seen[::7, 2] += 0.5  # far too far away
    part = {"body_pose": np.zeros((frames, 63)), "betas": np.zeros((frames, 10))}
    world = dict(part, global_orient=np.array([vector(r) for r in roots]), transl=pelvis - J0)
    camera = dict(part, global_orient=np.array([vector(c @ r) for c, r in zip(turns, roots)]), transl=seen - J0)
    with open("results.pkl", "wb") as file:
        pickle.dump({"smpl_params_global": world, "smpl_params_incam": camera, "K_fullimg": K[None]}, file)
    other = rotation(np.array([0.3, -0.8, 0.5]))
    rows = []
    for turn, eye in zip(turns, eyes):
        r = vector(other @ turn.T)
        angle = np.linalg.norm(r)
        rows.append([*(0.37 * other @ eye + [3, -2, 1]), *(np.sin(angle / 2) * r / angle), np.cos(angle / 2)])
    np.save("slam.npy", np.array(rows))
    np.save("points.npy", random.uniform(size=(frames, 17, 3)))
    status, complaint, out = convert("results.pkl", "--keypoints", "points.npy", "--slam", "slam.npy")
    assert status == 0, complaint
    y_to_z = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    for E, turn, eye in zip(out["camera_extrinsics"], turns, eyes):
        assert np.allclose(E[:3, :3], turn @ y_to_z.T, atol=1e-6)
        assert np.linalg.norm(-E[:3, :3].T @ E[:3, 3] - y_to_z @ eye) < 0.03


def check_which_file_is_wrong_and_how():
    with open("results.pkl", "wb") as file:
        pickle.dump(GVHMR, file)
    with open("half.pkl", "wb") as file:
        file.write(pickle.dumps(GVHMR)[:999])
    with open("lacking.pkl", "wb") as file:
        pickle.dump({key: value for key, value in GVHMR.items() if key != "smpl_params_incam"}, file)
    np.save("points.npy", POINTS)
    np.save("flat.npy", POINTS[:, :, :2])
    np.save("short.npy", POINTS[:4])
    np.save("path.npy", np.zeros((3, 7)))
    os.makedirs("empty", exist_ok=True)
    points = "--keypoints", "points.npy", "--static"
    for arguments, said in (
            (("points.npy", *points), "points.npy: expected results of GVHMR"),
            (("points.npy", *points), "found an array of shape (7, 17, 3): keypoints? They go behind --keypoints"),
            (("results.pkl", "--keypoints", "results.pkl", "--static"), "results.pkl: expected keypoints (T, K, 3)"),
            (("results.pkl", "--keypoints", "flat.npy", "--static"), "flat.npy: expected keypoints (T, K, 3)"),
            (("results.pkl", "--keypoints", "flat.npy", "--static"), "found an array of shape (7, 17, 2)"),
            (("results.pkl", "--keypoints", "short.npy", "--static"), "short.npy: expected keypoints of the 7 frames"),
            (("results.pkl", "--keypoints", "short.npy", "--static"), "found 4 frames"),
            (("results.pkl", "--keypoints", "none.npy", "--static"), "none.npy: expected keypoints (T, K, 3), found"),
            (("results.pkl", "--keypoints", "points.npy", "--slam", "path.npy"), "path.npy: expected a camera's path"),
            (("half.pkl",), "half.pkl: expected results of GVHMR"),
            (("half.pkl",), "cannot be read (UnpicklingError"),
            (("lacking.pkl",), "lacking.pkl: expected a member 'smpl_params_incam' in results"),
            (("empty",), "empty: expected results of GVHMR"), (("none.pkl",), "found no such file")):
        status, complaint, _ = convert(*arguments)
        assert status == 1 and said in complaint and len(complaint.splitlines()) == 1, (arguments, said, complaint)


# Results of other programs, all of the motion GLOBAL in a y-up world, or before a level camera in the same place.
Y_TO_Z = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
DOWN = np.diag([1.0, -1, -1])
POSE22 = np.hstack([GLOBAL["global_orient"], GLOBAL["body_pose"]])
BELOW = np.array([vector(DOWN @ rotation(r)) for r in GLOBAL["global_orient"]])  # roots before the level camera


def expect_motion(out, j0):
    assert np.allclose(out["trans"] + j0, (GLOBAL["transl"] + J0) @ Y_TO_Z.T, atol=1e-5), "place"
    for t in range(FRAMES):
        assert np.allclose(rotation(out["poses"][t, :3]), Y_TO_Z @ rotation(GLOBAL["global_orient"][t]), atol=1e-5), "root"
    assert np.allclose(out["poses"][:, 3:66], GLOBAL["body_pose"], atol=1e-5), "pose"


def written(content, name, *more):
    """The members that come of a pickled result, saved as its program saves it."""
    if name.endswith(".npz"):
        np.savez(name, **content)
    elif name.endswith(".npy"):
        np.save(name, content)
    else:
        with open(name, "wb") as file:
            pickle.dump(content, file)
    status, complaint, out = convert(name, *more)
    assert status == 0, (name, complaint)
    return out


def place(j0):
    """trans of a model with this J0, in the world and before the camera."""
    pelvis = GLOBAL["transl"] + J0
    return pelvis - j0, pelvis @ DOWN.T - j0


def check_gem():
    expect_motion(written({"body_params_global": GLOBAL, "body_params_incam": INCAM, "K_fullimg": K[None]}, "gem.pkl"), J0)


def check_prompthmr():
    pose = np.hstack([POSE22, np.zeros((FRAMES, 99))])
    person = {"smplx_world": {"pose": pose, "shape": GLOBAL["betas"], "trans": GLOBAL["transl"]},
              "smplx_cam": {"pose": pose, "shape": GLOBAL["betas"], "trans": INCAM["transl"]},
              "frames": np.arange(FRAMES), "track_id": 4}
    out = written({"people": {4: person}, "camera": {"img_focal": 900.0, "img_center": [480, 270]}}, "phmr.pkl")
    expect_motion(out, J0)
    assert out["poses"].shape[1] == 165


def check_slahmr():
    world, _ = place(SMPL_J0)
    world_down = (world + SMPL_J0) @ DOWN.T - SMPL_J0
    one = {"trans": world_down, "root_orient": BELOW, "pose_body": GLOBAL["body_pose"]}
    content = {key: np.stack([value, value]) for key, value in one.items()}
    content["betas"] = np.zeros((2, 16))
    np.savez("slahmr.npz", **content)
    for name in os.listdir("."):
        if name.startswith("out_person"):
            os.remove(name)
    status, _, complaint = python_program.run(TOOL, "slahmr.npz", "out.npz", "--shortest", "1")
    assert status == 0, complaint
    for person in (1, 2):
        expect_motion(dict(np.load(f"out_person{person}.npz")), SMPL_J0)
        os.remove(f"out_person{person}.npz")
    # A tilted floor: its normal is up.
    tilt = rotation(np.array([0.3, 0.0, 0.1]))
    tilted = {"trans": ((world_down + SMPL_J0) @ tilt.T - SMPL_J0)[None], "pose_body": GLOBAL["body_pose"][None],
              "root_orient": np.array([vector(tilt @ rotation(r)) for r in BELOW])[None],
              "floor_plane": (tilt @ [0, -1.0, 0] * 1.5)[None]}
    out = written(tilted, "tilted.npz")
    up = np.array([rotation(r)[2, 1] for r in out["poses"][:, :3]])
    assert np.allclose(up, [rotation(r)[1, 1] for r in GLOBAL["global_orient"]], atol=1e-5), "heads over feet as before"


def check_slahmr_of_people_who_come_and_go():
    """Where track_mask is false, everything is 0: no pose, and no vote on where up is."""
    world, _ = place(SMPL_J0)
    down = (world + SMPL_J0) @ DOWN.T - SMPL_J0
    mask = np.zeros((4, FRAMES), bool)  # the fourth never comes: most poses are none
    mask[0], mask[1, 4:] = True, True
    mask[2, 2:4] = True
    one = {"trans": down, "root_orient": BELOW, "pose_body": GLOBAL["body_pose"]}
    content = {key: np.stack([np.where(seen[:, None], value, 0) for seen in mask]) for key, value in one.items()}
    np.savez("gone.npz", track_mask=mask, floor_plane=np.array([[0, -1.0, 0, 0]]), **content)
    status, told, complaint = python_program.run(TOOL, "gone.npz", "gone_out.npz", "--shortest", "1")
    assert status == 0, complaint
    assert "person 2, frames 4 to 6" in told and "person 3, frames 2 to 3" in told, told
    out = dict(np.load("gone_out_person2.npz"))
    there, seen = (world + SMPL_J0)[4:], out["trans"] + SMPL_J0  # but for a turn about the vertical
    assert np.allclose(seen[:, 2], there[:, 1], atol=1e-5), "height"
    assert np.allclose(np.linalg.norm(seen - seen[0], axis=1), np.linalg.norm(there - there[0], axis=1), atol=1e-5)
    up = np.array([rotation(r)[2, 1] for r in out["poses"][:, :3]])
    assert np.allclose(up, [rotation(r)[1, 1] for r in GLOBAL["global_orient"][4:]], atol=1e-5)


def check_slahmr_tells_its_camera():
    """cam_R, cam_t: world to camera; intrins: focal lengths and centre."""
    world, _ = place(SMPL_J0)
    down = (world + SMPL_J0) @ DOWN.T - SMPL_J0
    turns = np.array([rotation(np.array([0.02 * t + 0.1, 0.1, 0.0])) for t in range(FRAMES)])
    places = np.linspace([0, 0, 1.0], [0.3, 0, 1.2], FRAMES)
    np.savez("seen.npz", trans=down[None], root_orient=BELOW[None], pose_body=GLOBAL["body_pose"][None],
             cam_R=turns[None], cam_t=places[None], intrins=np.array([1000.0, 1010.0, 960.0, 540.0]))
    np.save("points.npy", POINTS)
    status, complaint, out = convert("seen.npz", "--keypoints", "points.npy")
    assert status == 0, complaint
    expect_motion({k: v for k, v in out.items() if not k.startswith(("camera", "keypoint"))}, SMPL_J0)
    assert np.allclose(out["camera_intrinsics"], [[1000, 0, 960], [0, 1010, 540], [0, 0, 1]])
    seen = np.einsum("tij,tj->ti", out["camera_extrinsics"][:, :3, :3], out["trans"] + SMPL_J0) + out["camera_extrinsics"][:, :3, 3]
    assert np.allclose(seen, np.einsum("tij,tj->ti", turns, down + SMPL_J0) + places, atol=1e-6)


def check_trace():
    world, camera = place(SMPL_J0)
    outputs = {"smpl_thetas": np.hstack([BELOW, GLOBAL["body_pose"], np.zeros((FRAMES, 6))]), "cam_trans": camera,
               "world_global_rots": BELOW, "world_trans": camera, "smpl_betas": np.zeros((FRAMES, 11)),
               "track_ids": np.full(FRAMES, 3), "reorganize_idx": np.arange(FRAMES)}
    expect_motion(written({"outputs": np.array(outputs, dtype=object)}, "trace.npz"), SMPL_J0)


def check_romp():
    _, camera = place(SMPL_J0)
    thetas = np.hstack([BELOW, GLOBAL["body_pose"], np.zeros((FRAMES, 6))])
    frames = {f"{t:06d}.jpg": {"smpl_thetas": thetas[t:t + 1], "cam_trans": camera[t:t + 1], "smpl_betas": np.zeros((1, 10)),
                               "track_ids": np.array([7])} for t in range(FRAMES)}
    expect_motion(written({"results": np.array(frames, dtype=object)}, "romp.npz"), SMPL_J0)
    both = {name: np.array(value, dtype=object) for name, value in (("results", frames), ("sequence_results", {}))}
    expect_motion(written(both, "simple_romp.npz"), SMPL_J0)  # as simple-romp writes it
    # Its depth is that of a focal length of the longer side, and brought to that of the diagonal.
    np.save("points.npy", POINTS)
    status, complaint, out = convert("romp.npz", "--keypoints", "points.npy", "--moving", "--size", "1920", "1080")
    assert status == 0 and np.isclose(out["camera_intrinsics"][0, 0], np.hypot(1920, 1080)), complaint
    seen = np.einsum("tij,tj->ti", out["camera_extrinsics"][:, :3, :3], out["trans"] + SMPL_J0) + out["camera_extrinsics"][:, :3, 3]
    assert np.allclose(seen, camera * [1, 1, np.hypot(1920, 1080) / 1920] + SMPL_J0, atol=1e-5)
    # Frames without a person have no entry.
    holes = {name: one for t, (name, one) in enumerate(frames.items()) if t not in (2, 3)}
    np.savez("holes.npz", results=np.array(holes, dtype=object))
    status, told, complaint = python_program.run(TOOL, "holes.npz", "holes_out.npz", "--shortest", "1")
    assert "frames 0 to 1" in told and "frames 4 to 6" in told, told + complaint
    text = {str(9 + t): one for t, one in enumerate(frames.values())}  # "10" is before "9" in the alphabet
    out = written({"results": np.array(text, dtype=object)}, "text.npz")
    expect_motion(out, SMPL_J0)


def check_phalp():
    _, camera = place(SMPL_J0)
    size = np.array([1080, 1920])
    deep = camera.copy()
    deep[:, 2] *= 5000 / 256 * 1920 / np.hypot(*size)
    frames = {f"img/{t:06d}.jpg": {
        "tid": [2], "camera": [deep[t]], "size": [size],
        "smpl": [{"global_orient": rotation(BELOW[t])[None], "betas": np.zeros(10),
                  "body_pose": np.array([rotation(v) for v in GLOBAL["body_pose"][t].reshape(-1, 3)] + [np.eye(3)] * 2)}]}
        for t in range(FRAMES)}
    expect_motion(written(frames, "phalp.pkl"), SMPL_J0)
    given = {name: {k: v for k, v in one.items() if k != "size"} for name, one in frames.items()}
    expect_motion(written(given, "without_size.pkl", "--size", "1920", "1080"), SMPL_J0)
    status, complaint, _ = convert("without_size.pkl")
    assert status == 1 and "--size W H" in complaint and len(complaint.splitlines()) == 1, complaint
    for t, one in enumerate(frames.values()):  # what is lost is kept as it was last seen
        one["tracked_time"] = [max(0, t - 1) if t < 5 else 0]
    with open("lost.pkl", "wb") as file:
        pickle.dump(frames, file)
    status, told, complaint = python_program.run(TOOL, "lost.pkl", "lost.npz", "--shortest", "1")
    assert "frames 0 to 1" in told and "frames 5 to 6" in told, told + complaint


def check_phc():
    world = GLOBAL["transl"] + J0
    roots = np.array([vector(Y_TO_Z @ rotation(r)) for r in GLOBAL["global_orient"]])
    pose = np.hstack([roots, GLOBAL["body_pose"], np.zeros((FRAMES, 6))]).reshape(FRAMES, 24, 3)
    out = written({"0-walk": {"pose_aa": pose, "trans_orig": world @ Y_TO_Z.T - SMPL_J0, "beta": np.zeros(16), "fps": 25}},
                  "phc.pkl")
    expect_motion(out, SMPL_J0)
    assert out["mocap_framerate"] == 25
    assert convert("phc.pkl", "--fps", "50")[2]["mocap_framerate"] == 50, "the given rate wins"


def check_aist_and_vibe():
    world, camera = place(SMPL_J0)
    pose = np.hstack([POSE22, np.zeros((FRAMES, 6))])
    out = written({"smpl_poses": pose, "smpl_trans": 93.0 * world, "smpl_scaling": np.array([93.0])}, "aist.pkl")
    expect_motion(out, SMPL_J0)
    assert out["mocap_framerate"] == 60
    assert convert("aist.pkl", "--fps", "50")[2]["mocap_framerate"] == 50, "the given rate wins"
    size = (1920.0, 1080.0)
    near = camera - camera.min(0) + [0.1, 0.1, 3.0]  # in front of the camera
    scale = np.hypot(*size) / (near[:, 2] * size[0] / 2)
    person = {"pose": np.hstack([BELOW, pose[:, 3:]]), "betas": np.zeros((FRAMES, 10)), "frame_ids": np.arange(FRAMES),
              "orig_cam": np.stack([scale, scale, near[:, 0], near[:, 1]], 1)}
    out = written({1: person}, "vibe.pkl", "--size", "1920", "1080")
    assert np.allclose(out["trans"] + SMPL_J0, (near + SMPL_J0) @ DOWN.T @ Y_TO_Z.T, atol=1e-6)
    assert convert("vibe.pkl")[0] == 1 and "--size" in convert("vibe.pkl")[1]


def check_multihmr():
    pelvis = (GLOBAL["transl"] + J0) @ DOWN.T
    pelvis = np.cumsum(np.diff(pelvis, axis=0, prepend=0) * 0.05, axis=0)  # near enough from frame to frame to be followed
    frames = [[{"rotvec": np.vstack([BELOW[t], GLOBAL["body_pose"][t].reshape(-1, 3), np.zeros((31, 3))]),
                "transl_pelvis": pelvis[t][None], "shape": np.zeros(10)}] for t in range(FRAMES)]
    out = written(frames, "multihmr.pkl")
    assert np.allclose(out["poses"][:, 3:66], GLOBAL["body_pose"], atol=1e-5)
    assert np.allclose(out["trans"] + J0, pelvis @ DOWN.T @ Y_TO_Z.T, atol=1e-5)


def check_positions_of_mdm_and_sam3d():
    motion = random.normal(size=(2, 22, 3, 60))
    np.save("results.npy", {"motion": motion, "lengths": np.array([60, 41]), "text": ["a", "b"], "num_samples": 2})
    status, _, complaint = python_program.run(TOOL, "results.npy", "mdm")
    assert status == 0, complaint
    for sample, length in ((0, 60), (1, 41)):
        assert np.allclose(np.load(f"mdm_person{sample}.npy"), motion[sample].transpose(2, 0, 1)[:length], atol=1e-6)
    _, out, complaint = python_program.run(TOOL, "results.npy", "mdm50", "--fps", "50")
    assert out.count("--fps 50") == 2 and "assumed" not in out, out + complaint
    points, place_ = random.normal(size=(FRAMES, 70, 3)), np.array([0.1, 0.2, 4.0])
    with open("sam3d.pkl", "wb") as file:
        pickle.dump([[{"pred_keypoints_3d": p, "pred_cam_t": place_}] for p in 0.1 * points], file)
    status, _, complaint = python_program.run(TOOL, "sam3d.pkl", "sam3d")
    assert status == 0, complaint
    out = np.load("sam3d.npy")
    for body, point in ((1, 9), (5, 12), (7, 13), (12, 69), (16, 5), (19, 8), (20, 62), (21, 41)):
        assert np.allclose(out[:, body], (0.1 * points[:, point] + place_) @ DOWN.T, atol=1e-6), body


def check_many_results_and_nothing_overwritten():
    for name in ("one.pkl", "two.pkl"):
        with open(name, "wb") as file:
            pickle.dump(GVHMR, file)
    many = TOOL, "one.pkl", "two.pkl", "converted"
    status, out, complaint = python_program.run(*many)
    assert status == 0 and sorted(os.listdir("converted")) == ["one.npz", "two.npz"], complaint
    assert out.count(", 30 fps assumed (--fps)") == 2, out
    status, out, complaint = python_program.run(TOOL, "one.pkl", "fifty.npz", "--fps", "50")
    assert status == 0 and "assumed" not in out, out + complaint
    before = open("converted/one.npz", "rb").read()
    os.remove("converted/two.npz")
    status, _, complaint = python_program.run(*many)
    assert status == 1 and "not overwritten" in complaint and len(complaint.splitlines()) == 1, complaint
    assert open("converted/one.npz", "rb").read() == before and not os.path.exists("converted/two.npz")
    for rate in ("0", "nan", "inf", "-30", "1e9"):
        status, _, complaint = python_program.run(TOOL, "one.pkl", "new.npz", "--fps", rate)
        assert status == 2 and "frames per second" in complaint, (rate, complaint)


def check_keypoints_belong_to_one_person():
    world, _ = place(SMPL_J0)
    down = (world + SMPL_J0) @ DOWN.T - SMPL_J0
    np.savez("two.npz", trans=np.stack([down, down]), root_orient=np.stack([BELOW, BELOW]),
             pose_body=np.stack([GLOBAL["body_pose"]] * 2))
    np.save("points.npy", POINTS)
    ask = TOOL, "two.npz", "two_out.npz", "--keypoints", "points.npy", "--static", "--size", "1920", "1080"
    status, _, complaint = python_program.run(*ask)
    assert status == 2 and "--person" in complaint and not os.path.exists("two_out_person1.npz"), complaint
    status, _, complaint = python_program.run(*ask, "--person", "2")
    assert status == 0, complaint


def check_a_path_of_matrices():
    """GVHMR's SimpleVO keeps (T, 4, 4), world to camera, of which only the turns are estimated."""
    turns = np.array([rotation(np.array([0.02 * t + 0.1, 0.05 * t, 0.01])) for t in range(FRAMES)])
    paths = np.tile(np.eye(4), (FRAMES, 1, 1))
    paths[:, :3, :3] = turns
    paths[:, :3, 3] = 7.0  # means nothing
    np.save("path.npy", paths)
    pelvis = GLOBAL["transl"] + J0
    camera = pelvis @ Y_TO_Z.T  # in a z-up world
    seen = np.einsum("tij,tj->ti", turns, camera) + [0.0, 0.0, 5.0]
    incam = dict(GLOBAL, transl=seen - J0,
                 global_orient=np.array([vector(turns[t] @ Y_TO_Z @ rotation(r)) for t, r in enumerate(GLOBAL["global_orient"])]))
    with open("vo.pkl", "wb") as file:
        pickle.dump({"smpl_params_global": GLOBAL, "smpl_params_incam": incam, "K_fullimg": np.tile(K, (FRAMES, 1, 1))}, file)
    np.save("points.npy", POINTS)
    status, complaint, out = convert("vo.pkl", "--keypoints", "points.npy", "--slam", "path.npy")
    assert status == 0, complaint
    assert np.allclose(out["camera_extrinsics"][:, :3, :3], turns, atol=1e-6)
    assert np.allclose(out["camera_extrinsics"][:, :3, 3], [0.0, 0.0, 5.0], atol=1e-6)


def check_every_protocol_of_pickle():
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        with open("protocol.pkl", "wb") as file:
            pickle.dump(GVHMR, file, protocol)
        status, complaint, out = convert("protocol.pkl")
        assert status == 0 and np.allclose(out["poses"][:, 3:], GLOBAL["body_pose"], atol=1e-6), (protocol, complaint)


def check_refusals():
    class Evil:
        def __reduce__(self):
            return os.mkdir, ("evil",)

    for content in (Evil(), {"smpl_params_global": Evil()}, {"something": 1}, [1, 2]):
        with open("bad.pkl", "wb") as file:
            pickle.dump(content, file)
        status, complaint, _ = convert("bad.pkl")
        assert status == 1 and "bad.pkl" in complaint and complaint.count("\n") == 1, complaint
    np.save("bad.npy", {"pose_world": Evil()})
    assert convert("bad.npy")[0] == 1
    assert not os.path.exists("evil"), "code in a pickle was run"
    with open("cut.pkl", "wb") as file:
        file.write(pickle.dumps(GVHMR)[:-100])
    assert convert("cut.pkl")[0] == 1 and convert("none.pkl")[0] == 1


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for check in (check_plain_pickle, check_compressed_pickles, check_torch_zip, check_joblib, check_several_people, check_tram,
                  check_a_static_camera, check_a_camera_path, check_gem, check_prompthmr, check_slahmr, check_slahmr_of_people_who_come_and_go,
                  check_slahmr_tells_its_camera, check_trace, check_romp, check_keypoints_belong_to_one_person,
                  check_a_path_of_matrices, check_every_protocol_of_pickle,
                  check_phalp, check_phc, check_aist_and_vibe, check_multihmr, check_positions_of_mdm_and_sam3d,
                  check_many_results_and_nothing_overwritten, check_which_file_is_wrong_and_how, check_refusals):
        check()
        print(check.__name__, "ok")

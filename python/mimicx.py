"""mimicx in Python: noisy human motion in, motion of a simulated body and its forces out.

    import mimicx
    result = mimicx.clean(poses, trans, betas, fps=30)     # SMPL: (T, 66) or (T, 22, 3) axis-angle, (T, 3) m
    result["joint_torques"], result.metrics["slip"], result.followed

One file on ctypes and NumPy over libmimicx (include/mimicx.h); docs/python.md has examples. The library is looked for in
$MIMICX_LIBRARY, beside this file, in the lib folder that this file is installed under, and where the system loads
libraries from. Units: m, s, rad, N, N m; z is up; quaternions are w, x, y, z. Arrays of results are copies; those of a
Simulator are its own numbers.
"""
import ctypes
import json
import operator
import os
import pathlib

import numpy as np

__all__ = ["BODIES", "PARENTS", "Error", "Motion", "Result", "Run", "RunMotions", "Simulator", "Stopped", "audit", "clean",
           "load", "version"]

_ABI = 1
_OK, _FAILED, _NOT_FOLLOWED, _STOPPED = range(4)


class Error(RuntimeError):
    """What the library says where something cannot be done."""


class Stopped(Error):
    """The progress function has stopped the work."""


class _Owner:
    """Has a handle of the library, which belongs to one process and one object."""

    def __reduce_ex__(self, _):
        raise TypeError(f"mimicx: a {type(self).__name__} can be neither copied nor pickled: its numbers are in the library")


class _Array(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("type", ctypes.c_char * 8), ("dimensions", ctypes.c_int32),
                ("shape", ctypes.c_int64 * 4)]


_Progress = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p, ctypes.c_void_p)


def _library():
    name, here = f"libmimicx.so.{_ABI}", pathlib.Path(__file__).resolve()
    named = os.environ.get("MIMICX_LIBRARY")
    places = [named] if named else [str(folder / name) for folder in (here.parent, *list(here.parents)[1:4])
                                    if (folder / name).exists()] + [name]
    try:
        library = ctypes.CDLL(places[0])
    except OSError as error:
        raise ImportError(f"{name} is not there; MIMICX_LIBRARY can name it ({error})") from error
    text, handle, status = ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int
    arrays = [handle, text, ctypes.POINTER(_Array)]
    for function, result, arguments in (
            ("abi", ctypes.c_int, []), ("version", text, []), ("body_name", text, [ctypes.c_int]),
            ("body_parent", ctypes.c_int, [ctypes.c_int]),
            ("motion_new", handle, []), ("motion_free", None, [handle]), ("motion_error", text, [handle]),
            ("motion_set", status, [handle, text, text]),
            ("motion_read", status, [handle, text, ctypes.c_size_t, text]),
            ("motion_put", status, arrays),
            ("motion_put_text", status, [handle, text, ctypes.POINTER(text), ctypes.c_int]),
            ("motion_clean", status, [handle, _Progress, ctypes.c_void_p]),
            ("motion_array", status, arrays), ("motion_members", text, [handle]), ("motion_record", text, [handle]),
            ("motion_audit", text, [handle]),
            ("motion_write", status, [handle, text, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(ctypes.c_size_t)]),
            ("simulator_new", handle, [ctypes.c_void_p]), ("simulator_free", None, [handle]),
            ("simulator_error", text, [handle]), ("simulator_set", status, [handle, text, ctypes.c_double]),
            ("simulator_stand", status, [handle]), ("simulator_array", status, arrays),
            ("simulator_step", status, [handle, ctypes.c_int])):
        call = getattr(library, "mimicx_" + function)
        call.restype, call.argtypes = result, arguments
    if library.mimicx_abi() != _ABI:
        raise ImportError(f"{places[0]} has the interface {library.mimicx_abi()}, expected {_ABI}")
    return library


_lib = _library()
BODIES = [_lib.mimicx_body_name(k).decode() for k in range(22)]
PARENTS = [_lib.mimicx_body_parent(k) for k in range(22)]


def version():
    """The library's version and commit."""
    return _lib.mimicx_version().decode()


def _view(array, owner):
    """A NumPy array over a mimicx_array, which keeps its owner."""
    shape = tuple(array.shape[:array.dimensions])
    dtype = np.dtype(array.type.decode())
    size = int(np.prod(shape, dtype=np.int64)) * dtype.itemsize
    if size == 0:
        return np.zeros(shape, dtype)
    buffer = (ctypes.c_char * size).from_address(array.data)
    buffer.owner = owner
    return np.frombuffer(buffer, dtype).reshape(shape)


class Motion(_Owner):
    """A motion in the library: read or put, then cleaned, audited, written. `Motion(path)` reads a file.

    Options, as keywords: threads, fit, as_is, limit_seconds, up, scale, fps, floor, mass (kg), height (m), body, root,
    person; scene: "auto", or {"plates": […]} of docs/scenes.md; and every setting of plans and of the simulation that
    `mimicx config` lists.
    """

    def __init__(self, path=None, **options):
        self._handle = _lib.mimicx_motion_new()
        if not self._handle:
            raise MemoryError("mimicx")
        for name, value in options.items():
            text = (str(int(value)) if isinstance(value, (bool, np.bool_)) else
                    json.dumps(value) if isinstance(value, dict) else str(value))
            self._check(_lib.mimicx_motion_set(self._handle, name.encode(), text.encode()))
        if path is not None:
            data = pathlib.Path(path).read_bytes()
            self._check(_lib.mimicx_motion_read(self._handle, data, len(data), os.fsencode(os.path.basename(path))))

    def __del__(self):
        if getattr(self, "_handle", None):
            _lib.mimicx_motion_free(self._handle)
            self._handle = None

    def _error(self):
        return Error(_lib.mimicx_motion_error(self._handle).decode(errors="replace"))

    def _check(self, status):
        if status == _FAILED:
            raise self._error()
        return status

    def put(self, name, values):
        """Gives the motion a member as an .npz file has it (docs/formats.md): numbers, a text or a list of texts."""
        values = np.asarray(values)
        if values.dtype.kind in "US":
            texts = [text if isinstance(text, bytes) else str(text).encode() for text in np.atleast_1d(values).tolist()]
            self._check(_lib.mimicx_motion_put_text(self._handle, name.encode(),
                                                    (ctypes.c_char_p * len(texts))(*texts), len(texts)))
            return
        kind = "<i8" if values.dtype.kind in "iu" else "<f4" if values.dtype == np.float32 else "<f8"
        values = np.array(values, dtype=kind, order="C", ndmin=0)
        array = _Array(values.ctypes.data, kind.encode(), values.ndim, tuple(values.shape) + (0,) * (4 - values.ndim))
        self._check(_lib.mimicx_motion_put(self._handle, name.encode(), ctypes.byref(array)))

    def clean(self, progress=None):
        """Cleans the motion, which then is the simulated one.
        @param progress  called with a text that says what is done; it stops the work by returning True
        @return whether the body followed the motion to its end
        @raise Stopped where `progress` returned True; what it raises, and KeyboardInterrupt"""
        failure = []

        def tell(doing, _):
            try:
                return int(progress is not None and progress(doing.decode(errors="replace")) is True)
            except BaseException as error:  # an interrupt, too: nothing passes through C
                failure.append(error)
                return 1

        status = self._check(_lib.mimicx_motion_clean(self._handle, _Progress(tell), None))
        if status == _STOPPED:
            raise failure[0] if failure else Stopped("stopped by the progress function")
        return status == _OK

    @property
    def members(self):
        """Names of the arrays."""
        names = _lib.mimicx_motion_members(self._handle)
        if names is None:
            raise self._error()
        return names.decode().split()

    def __getitem__(self, name):
        """A copy of an array."""
        array = _Array()
        if _lib.mimicx_motion_array(self._handle, name.encode(), ctypes.byref(array)) != _OK:
            raise KeyError(str(self._error()))
        return _view(array, self).copy()

    def arrays(self):
        """All arrays of numbers by name; copies."""
        found = {}
        for name in self.members:
            try:
                found[name] = self[name]
            except KeyError:  # texts
                pass
        return found

    @property
    def record(self):
        """What was cleaned and how well, as the entry of manifest.json; {} before."""
        text = _lib.mimicx_motion_record(self._handle)
        return json.loads(text) if text else {}

    def audit(self):
        """Do its forces explain the motion? Could any? Audits as `mimicx audit --json` has them."""
        text = _lib.mimicx_motion_audit(self._handle)
        if text is None:
            raise self._error()
        return json.loads(text)["files"][0]["audits"]

    def bytes(self, suffix):
        """The motion as a file: .npz, .npy, .bvh, .glb, .mot, .sto or .csv."""
        data, size = ctypes.c_void_p(), ctypes.c_size_t()
        self._check(_lib.mimicx_motion_write(self._handle, suffix.encode(), ctypes.byref(data), ctypes.byref(size)))
        return ctypes.string_at(data, size.value)

    def save(self, path):
        """Writes it; the suffix is the format, as for `bytes`."""
        data = self.bytes(pathlib.Path(path).suffix)
        pathlib.Path(path).write_bytes(data)


class Result(dict):
    """The arrays of a cleaned motion by name, at 30 frames per second, and what else is known of it. A copy, and what is
    sent to another process, has no `motion`."""

    def __init__(self, motion, followed):
        super().__init__(motion.arrays())
        self.motion = motion        #: to audit and to save
        self.followed = followed    #: whether the body followed the motion to its end
        self.record = motion.record
        self.metrics = self.record.get("metrics", {})  #: docs/metrics.md, against the prepared reference
        self.notes = self.record.get("notes", [])      #: what was odd: keypoints that were ignored, a body that is unknown

    def __getstate__(self):
        return {**self.__dict__, "motion": None}


def _put(poses, trans, betas, fps, keypoints, camera, body_model, options):
    poses, trans = np.asarray(poses, dtype=np.float64), np.asarray(trans, dtype=np.float64)
    if poses.ndim < 2 or not poses.size:
        raise ValueError(f"poses: expected (T, 66) or (T, 22, 3), found {poses.shape}")
    if keypoints is not None and camera is None:
        raise ValueError("camera: expected (intrinsics, extrinsics) with keypoints, found none")
    motion = Motion(**options)
    motion.put("poses", poses.reshape(len(poses), -1))
    motion.put("trans", trans)
    motion.put("mocap_framerate", float(fps))
    if body_model is not None:
        motion.put("body_model", body_model)
    if betas is not None:
        motion.put("betas", np.asarray(betas, dtype=np.float64).reshape(-1))
    if keypoints is not None:
        names = None
        if isinstance(keypoints, dict):
            names, keypoints = list(keypoints), np.stack([keypoints[name] for name in keypoints], axis=1)
        motion.put("keypoints_2d", np.asarray(keypoints, dtype=np.float64))
        if names is not None:
            motion.put("keypoint_names", names)
        intrinsics, extrinsics = camera
        motion.put("camera_intrinsics", np.asarray(intrinsics, dtype=np.float64))
        motion.put("camera_extrinsics", np.asarray(extrinsics, dtype=np.float64))
    return motion


def clean(poses, trans, betas=None, fps=30, keypoints=None, camera=None, body_model=None, progress=None, **options):
    """Cleans a motion, as `mimicx plan` does.

    @param poses      (T, 66), (T, 22, 3) or more columns, as SMPL, SMPL-H and SMPL-X have them: axis-angle, rad
    @param trans      (T, 3) m    @param fps  frames per second
    @param betas      (10,) of our own body (body_model "mimicx"); those of SMPL have no meaning without its model, and a
                      note says that they are ignored
    @param keypoints  (T, K, 3): u, v in pixels, confidence; or {name: (T, 3)}    @param camera  (3, 3) intrinsics and
                      (4, 4) or (T, 4, 4) extrinsics, world to camera; needed with keypoints
    @param body_model "mimicx" for our own body, "smpl", "smplh" or "smplx"; by default that of the columns
    @param progress   as Motion.clean    @param options  as Motion
    @return Result, at 30 frames per second; result.followed says whether the body followed to the end, result.notes what
            was odd
    @raise Error where no motion could be made"""
    motion = _put(poses, trans, betas, fps, keypoints, camera, body_model, options)
    return Result(motion, motion.clean(progress))


def load(path, **options):
    """A motion file of any format that mimicx reads."""
    return Motion(path, **options)


def audit(poses, trans, betas=None, fps=30, body_model=None, **options):
    """Could any forces of a floor explain these poses? Arguments as `clean`, result as Motion.audit."""
    return _put(poses, trans, betas, fps, None, None, body_model, options).audit()


class Simulator(_Owner):
    """A simulated body. Its arrays are its own numbers: write to them between steps.

    root_position (3,), root_velocity (3,), rotations (22, 4), spins (22, 3), target_rotations (22, 4), target_spins
    (22, 3), push (6,); to read: body_positions (22, 3), body_rotations (22, 4), joint_torques (22, 3), ground_wrenches
    (22, 6), self_contact_wrenches (22, 6). include/mimicx.h says what they are.
    """

    NAMES = ("root_position", "root_velocity", "rotations", "spins", "target_rotations", "target_spins", "push",
             "body_positions", "body_rotations", "joint_torques", "ground_wrenches", "self_contact_wrenches")

    def __init__(self, betas=None, **settings):
        shape = None if betas is None else np.ascontiguousarray(betas, dtype=np.float64)
        if shape is not None and shape.shape != (10,):
            raise ValueError(f"betas: expected 10 numbers, found the shape {shape.shape}")
        self._handle = _lib.mimicx_simulator_new(None if shape is None else shape.ctypes.data)
        if not self._handle:
            raise Error("betas: expected numbers between -5 and 5")
        self._life = _Life(self._handle)
        for name, value in settings.items():
            self.set(name, value)
        for name in self.NAMES:
            array = _Array()
            self._check(_lib.mimicx_simulator_array(self._handle, name.encode(), ctypes.byref(array)))
            self.__dict__[name] = _view(array, self._life)

    def __setattr__(self, name, value):
        if name in self.NAMES:
            getattr(self, name)[...] = value
        else:
            super().__setattr__(name, value)

    def _check(self, status):
        if status != _OK:
            raise Error(_lib.mimicx_simulator_error(self._handle).decode(errors="replace"))

    def set(self, name, value):
        """Changes a setting that `mimicx config` lists: friction, gravity, physics_rate ..."""
        self._check(_lib.mimicx_simulator_set(self._handle, name.encode(), float(value)))

    def stand(self):
        """Puts the body back to where it stood at first."""
        self._check(_lib.mimicx_simulator_stand(self._handle))

    def step(self, steps=1):
        """Does physics steps, 240 a second by default. @raise Error where the simulation fails; it is as before then"""
        if not 1 <= operator.index(steps) < 2**31:
            raise ValueError(f"steps: expected a whole number from 1, found {steps}")
        self._check(_lib.mimicx_simulator_step(self._handle, steps))


class _Life:
    """Frees a simulator when neither it nor an array of it is left."""

    def __init__(self, handle):
        self._handle = handle

    def __del__(self):
        _lib.mimicx_simulator_free(self._handle)


class Run:
    """The folder of a run (`mimicx adapt DIR --out RUN`): iterates over its entries, as dicts of manifest.json."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
        self.settings, self.entries = manifest["run"], manifest["sequences"]

    def __len__(self):
        return len(self.entries)

    def __iter__(self):
        return iter(self.entries)

    def arrays(self, entry):
        """The arrays of an entry's motion. @raise Error where it has none"""
        if not entry["output"]:
            raise Error(f"{entry['name']}: {entry['reason']}")
        with np.load(self.folder / entry["output"], allow_pickle=False) as archive:
            return {name: archive[name] for name in archive.files}

    def motions(self):
        """(entry, arrays) of every motion that was followed, one read at a time."""
        return ((entry, self.arrays(entry)) for entry in self.entries if entry["status"] == "ok")


_WHOLE = "betas", "camera_intrinsics", "rest_joints", "scene_plates"  # members that are never per frame


class RunMotions:
    """Stretches of equal length of all motions of a run that were followed, as a data set for training:
    torch.utils.data.DataLoader takes it as it is. Item k is {member: float32 (frames, ...)}; members that are not per
    frame, such as betas, are whole."""

    def __init__(self, folder, frames=60, stride=None, members=("poses", "trans", "joint_torques", "ground_wrenches")):
        stride = frames if stride is None else stride
        if min(frames, stride) < 1:
            raise ValueError(f"frames, stride: expected at least 1, found {frames}, {stride}")
        self.frames, self.members, self._motions, self._places = frames, tuple(members), [], []
        for entry, arrays in Run(folder).motions():
            if missing := [name for name in self.members if name not in arrays]:
                raise KeyError(f"{entry['name']}: expected the member {missing[0]}, found {', '.join(arrays)}")
            count = len(arrays["poses"])
            motion = {name: (np.asarray(arrays[name], dtype=np.float32),
                             name not in _WHOLE and arrays[name].shape[:1] == (count,)) for name in self.members}
            self._places += [(len(self._motions), start) for start in range(0, count - frames + 1, stride)]
            self._motions.append(motion)
        if not self._places:
            raise ValueError(f"{folder}: expected a motion of {frames} frames or more that was followed, found none")

    def __len__(self):
        return len(self._places)

    def __getitem__(self, k):
        motion, start = self._places[k]
        return {name: values[start:start + self.frames] if per_frame else values
                for name, (values, per_frame) in self._motions[motion].items()}

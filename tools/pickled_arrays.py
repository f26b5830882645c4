"""Reads arrays out of pickles without running what is in them: only arrays, numbers, text, lists and dictionaries are
made, anything else is refused. Plain pickles, joblib's, compressed or not, pickles in .npy and torch's zip files (.pt),
without torch or joblib; .npz and .npy too. Needs NumPy alone. Used by convert_video_results.py.
"""
import bz2
import gzip
import io
import lzma
import pickle
import zipfile
import zlib

import numpy as np

MOST_BYTES = 1 << 31  # of a compressed file, and of what is in it
STORAGES = {"FloatStorage": "<f4", "DoubleStorage": "<f8", "HalfStorage": "<f2", "LongStorage": "<i8",
            "IntStorage": "<i4", "ByteStorage": "u1", "BoolStorage": "?"}


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


def storage(content):
    """The elements of a tensor in a plain pickle: bytes of torch.save, as it was before its zip files."""
    file, types = io.BytesIO(content), {}
    for _ in range(3):  # a magic number, the protocol, the machine
        Unpickler(file).load()
    key = Unpickler(file, lambda key, dtype: types.setdefault(key, dtype) and key).load()
    if [key] != Unpickler(file).load():
        raise pickle.UnpicklingError("a storage of several parts is not read")
    count = int(np.frombuffer(file.read(8), "<i8")[0])
    return np.frombuffer(file.read(count * types[key].itemsize), types[key])


def array_in_buffer(buffer, dtype, shape, order):
    if dtype.hasobject:
        raise pickle.UnpicklingError("an array of objects in a buffer")
    return np.frombuffer(buffer, dtype).reshape(shape, order=order).copy()


class Unpickler(pickle._Unpickler):  # the one in Python: joblib's arrays stand between the opcodes
    def __init__(self, file, storages=None):
        super().__init__(file)
        self.file, self.storages = file, storages

    def find_class(self, module, name):
        if module in ("numpy.core.multiarray", "numpy._core.multiarray") and name in ("_reconstruct", "scalar"):
            return getattr(getattr(np, "_core", None) or np.core, "multiarray").__dict__[name]
        known = {("numpy", "ndarray"): np.ndarray, ("numpy", "dtype"): np.dtype, ("builtins", "dict"): dict,
                 ("collections", "OrderedDict"): dict, ("collections", "defaultdict"): lambda *_: {},
                 ("numpy.core.numeric", "_frombuffer"): array_in_buffer,
                 ("numpy._core.numeric", "_frombuffer"): array_in_buffer,
                 ("_codecs", "encode"): lambda text, coding: text.encode("latin1"),
                 ("joblib.numpy_pickle", "NumpyArrayWrapper"): JoblibArray,
                 ("torch._utils", "_rebuild_tensor_v2"): tensor, ("torch.storage", "_load_from_bytes"): storage}
        if module == "torch" and name in STORAGES:
            return np.dtype(STORAGES[name])
        if (module, name) not in known:
            raise pickle.UnpicklingError(f"{module}.{name} is not data: refused")
        return known[module, name]

    def persistent_load(self, pid):
        if self.storages is None or pid[0] != "storage":
            raise pickle.UnpicklingError("a reference outside the file")
        return self.storages(pid[2], pid[1])

    def load_build(self):
        super().load_build()
        if isinstance(self.stack[-1], JoblibArray):
            self.stack[-1] = self.stack[-1].read(self.file)

    dispatch = {**pickle._Unpickler.dispatch, pickle.BUILD[0]: load_build}


def is_pickled(file):
    """Whether an array in .npy format is a pickle; the file then stands at it."""
    version = np.lib.format.read_magic(file)
    read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    return read(file)[2].hasobject


def load_npy(path):
    """An array, or the dictionary or list that np.save pickled into one."""
    with open(path, "rb") as file:
        if not is_pickled(file):
            return np.load(path, allow_pickle=False)
        array = Unpickler(file).load()
        return array.item() if array.ndim == 0 else list(array)


def load_npz(path):
    """{name: array, or what np.savez pickled into one}"""
    out = {}
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            if not name.endswith(".npy"):
                continue
            content = archive.read(name)
            file = io.BytesIO(content)
            array = Unpickler(file).load() if is_pickled(file) else np.lib.format.read_array(io.BytesIO(content))
            out[name[:-4]] = array.item() if array.dtype == object and array.ndim == 0 else array
    return out


def unpacked(file):
    """The file, or what joblib has compressed into it."""
    start = file.read(6)
    file.seek(0)
    for magic, module in ((b"x\x01", zlib), (b"x\x5e", zlib), (b"x\x9c", zlib), (b"x\xda", zlib), (b"\x1f\x8b", gzip), (b"BZh", bz2),
                          (b"\xfd7zXZ", lzma), (b"\x5d\0\0", lzma)):
        if start.startswith(magic):
            content = module.decompress(file.read(MOST_BYTES))
            if len(content) > MOST_BYTES:
                raise pickle.UnpicklingError(f"more than {MOST_BYTES} bytes")
            return io.BytesIO(content)
    return file


def load(path):
    if path.endswith(".npz"):
        return load_npz(path)
    if path.endswith(".npy"):
        return load_npy(path)
    if not zipfile.is_zipfile(path):
        with open(path, "rb") as file:
            return Unpickler(unpacked(file)).load()
    archive = zipfile.ZipFile(path)
    index = next(n for n in archive.namelist() if n.endswith("data.pkl"))
    return Unpickler(archive.open(index),
                     lambda key, dtype: np.frombuffer(archive.read(f"{index[:-8]}data/{key}"), dtype)).load()

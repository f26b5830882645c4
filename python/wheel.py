#!/usr/bin/env python3
"""Makes a wheel of mimicx.py and the built libmimicx, without a network: also what `pip wheel ./python` calls.
  python/wheel.py [OUT]      default: the working folder
The library is $MIMICX_LIBRARY, or that of build/release.
"""
import base64
import hashlib
import os
import pathlib
import re
import sys
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent


def version():
    return re.search(r'^version = "(.*)"', (HERE / "pyproject.toml").read_text(encoding="utf-8"), re.M)[1]


def library():
    name = os.environ.get("MIMICX_LIBRARY")
    path = pathlib.Path(name) if name else HERE.parent / "build/release/src/c_interface/libmimicx.so"
    if not path.exists():
        sys.exit(f"wheel: there is no {path}: build it (cmake --build --preset release --target mimicx_c)")
    return path.resolve()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517."""
    name, tag = f"mimicx-{version()}", "py3-none-" + sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"{name}.dist-info"
    abi = re.search(r"^_ABI = (\d+)", (HERE / "mimicx.py").read_text(encoding="utf-8"), re.M)[1]
    files = {
        "mimicx.py": (HERE / "mimicx.py").read_bytes(),
        f"libmimicx.so.{abi}": library().read_bytes(),
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: mimicx\nVersion: {version()}\nLicense: MIT\n"
                            f"Requires-Python: >=3.8\nRequires-Dist: numpy\n".encode(),
        f"{info}/LICENSE": (HERE.parent / "LICENSE").read_bytes(),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: mimicx\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    rows = []
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{path},sha256={digest},{len(data)}\n")
    files[f"{info}/RECORD"] = ("".join(rows) + f"{info}/RECORD,,\n").encode()
    wheel = f"{name}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path), data, zipfile.ZIP_DEFLATED)  # a fixed time: equal bytes
    return wheel


if __name__ == "__main__":
    print(build_wheel(sys.argv[1] if len(sys.argv) > 1 else "."))

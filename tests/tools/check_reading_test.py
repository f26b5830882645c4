#!/usr/bin/env python3
"""tools/check_reading.py with a program that says the same of every file: the truth is not what the program says.

    check_reading_test.py TOOL

Exit status 77: no NumPy here, skipped.
"""
import os
import pathlib
import resource
import sys
import tempfile

try:
    import python_program
except ImportError:
    sys.exit(77)

TOOL = os.path.abspath(sys.argv[1])
ONE_BONE = """HIERARCHY
ROOT LeftHip
{
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 -40 0
}
}
MOTION
Frames: 2
Frame Time: 0.0333333
"""
ROWS = "0 80 0 0 0 0\n" * 2
WRAPPED = "0 80 0\n0 0 0\n" * 2

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    motions = folder / "motions"
    motions.mkdir()
    for file, rows in (("dance.bvh", ROWS), ("cmu_1.bvh", ROWS), ("wrapped.bvh", WRAPPED)):
        (motions / file).write_text(ONE_BONE + rows)
    program = folder / "program"
    program.write_text("#!/bin/sh\necho 'unit centimetres: legs are 80 units, 0.80 m long'\n")
    program.chmod(0o755)
    resource.setrlimit(resource.RLIMIT_NOFILE, (32, 32))  # fewer than there are copies
    status, table, complaint = python_program.run(TOOL, program, motions)
assert status == 0, complaint
for row in ("| unit | centimetres | 3 | 0 | 0 | 0 |",  # the dance, and a copy of either in this unit
            "| unit | inches / 0.45 | 0 | 0 | 0 | 3 |", "| unit | metres | 0 | 0 | 0 | 2 |",
            "| sides | right | 2 | 0 | 0 | 0 |"):
    assert row in table, table
print("check_reading_test: ok")

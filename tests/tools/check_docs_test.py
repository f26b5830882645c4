#!/usr/bin/env python3
"""tools/check_docs on a copy of the project with one mistake at a time: every kind of mistake is named.

    check_docs_test.py TOOL
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve().parent.parent
MISTAKES = [  # what is added to which file, what the check says of it
    ("docs/usage.md", "word " * 24 + "w", "121 columns, at most 120"),
    ("docs/usage.md", "[a page](no_such_page.md)", "links to no_such_page.md"),
    ("docs/usage.md", "`src/core/no_such_file.h`", "there is no src/core/no_such_file.h"),
    ("docs/usage.md", "`no_such_file.cpp`", "there is no file no_such_file.cpp"),
    ("docs/usage.md", "`Aba.NoSuchTest`", "there is no test Aba.NoSuchTest"),
    ("docs/usage.md", "`Aba.NoSuch*`", "there is no test Aba.NoSuch*"),
    ("docs/usage.md", "[method.md](method.md) §99", "docs/method.md has no §99"),
    ("docs/usage.md", "[method.md](method.md), §7", "no comma before the first §"),
    ("docs/usage.md", '[method.md](method.md), "No such title"', 'docs/method.md has no "No such title"'),
    ("docs/answers.md", "`121`, not 7, and `−1,234.5`", "the program of §8 does not print −1,234.5 (tour/expected.txt)"),
    ("docs/physics.md", "as §99 says", "this page has no §99"),
    ("src/core/error.h", "/// docs/method.md §8,\n/// §99", "docs/method.md has no §99"),
    ("src/core/error.h", "/// docs/physics.md §4, (99)", "docs/physics.md has no (99) in §4"),
    ("src/core/error.h", "/// docs/physics.md §3, (8)", "docs/physics.md has no (8) in §3"),
    ("src/core/error.h", "/// docs/no_such_page.md", "there is no docs/no_such_page.md"),
    ("src/core/error.h", "/// as §7 says", "§7 of which page?"),
    ("src/core/error.h", "/// METHOD", "METHOD is no page"),
]
RIGHT = [
    ("docs/usage.md", "| " + "cell " * 30 + "|"),
    ("docs/usage.md", '[method.md](method.md) §8 and §9, [physics.md](physics.md) §4, (8), `Aba.*`, "any words"'),
    ("src/core/error.h", "/// docs/physics.md §2,\n/// (2), docs/method.md §8, §9 and Ericson (2005), §5.1.9"),
]


def complaints(folder):
    run = subprocess.run([sys.executable, folder / "tools" / "check_docs"], stdout=subprocess.PIPE, text=True, check=False)
    found = {line for line in run.stdout.splitlines() if " pages; every link" not in line}
    assert (run.returncode == 0) == (not found), run.stdout
    return found


def append(folder, name, text):
    """@return  the lines of the file that the text is on, counted from 1"""
    path = folder / name
    kept = path.read_text(encoding="utf-8")
    path.write_text(kept + "\n" + text + "\n", encoding="utf-8")
    first = len(kept.splitlines()) + 2
    return range(first, first + len(text.splitlines()))


with tempfile.TemporaryDirectory() as temporary:
    copy = pathlib.Path(temporary)
    for name in ("src", "docs", "tests", "tools", "tour", "cmake"):
        shutil.copytree(ROOT / name, copy / name)
    for name in ("README.md", "CMakeLists.txt"):
        shutil.copy(ROOT / name, copy / name)
    os.symlink(ROOT / "data", copy / "data")
    before = complaints(copy)
    for name, text in RIGHT:
        append(copy, name, text)
    assert complaints(copy) == before, complaints(copy) - before
    places = [(name, append(copy, name, text), complaint) for name, text, complaint in MISTAKES]
    rooms = copy / "tools" / "check_layers"
    rooms.write_text(rooms.read_text(encoding="utf-8").replace('"nn": "core"', '"nn": "character"'), encoding="utf-8")
    found = complaints(copy) - before
    assert len(found) == len(MISTAKES) + 1, found
    for name, lines, complaint in places:
        of_lines = [c for c in found if c.startswith(tuple(f"docs: {name}:{line}: " for line in lines))]
        assert len(of_lines) == 1 and complaint in of_lines[0], (name, complaint, found)
    assert any("picture of the rooms" in c for c in found), found
print(f"{len(MISTAKES) + 1} mistakes named")

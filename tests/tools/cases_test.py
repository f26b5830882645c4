#!/usr/bin/env python3
"""Every check of ../shared/cases, files that people have, where that folder is there.

    cases_test.py MIMICX CASES [NUMBER...]

A row per check: PASS or FAIL, the number of the case, the file, what was found. What is right stands in the README and
the case.md of each; its own checkers judge motions. Exit status 77: no cases or no NumPy here, skipped.
"""
import hashlib
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import python_program
except ImportError:  # no NumPy, which the checkers need
    sys.exit(77)

MIMICX, CASES, ONLY = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
CONVERTER = pathlib.Path(__file__).resolve().parents[2] / "tools" / "convert_video_results.py"
if not CASES.is_dir():
    sys.exit(77)
folder = tempfile.TemporaryDirectory()  # removed at the end
OUT = pathlib.Path(folder.name)
failed = 0


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace")
    return done.returncode, done.stdout + done.stderr


def run_python(*command):
    status, out, error = python_program.run(*command)
    return status, out + error


def row(path, good, text):
    global failed
    failed += not good
    text = " | ".join(text.strip().splitlines())
    print("PASS" if good else "FAIL", path, text[:160] if good else text[:900])


def wanted(case):
    return not ONLY or case[:2] in ONLY


def says(text, words):
    return all(re.search(word, text, re.I) for word in words)


def motion(path, expected, *options, checker="check_limbs.py", rate=None, never=(), words=(), hips=None):
    """The file converts, and the case's checker agrees."""
    if not wanted(path):
        return
    out = OUT / (path.replace("/", "_") + ".npz")
    status, text = run(MIMICX, "convert", CASES / path, out, "--force", *options)
    if status != 0:
        return row(path, False, text)
    status, check = run_python(CASES / "tools" / checker, CASES / expected, out,
                        *(["--fps", rate] if rate else []))
    high = re.search(r"hips over the lower ankle: ([-\d.]+)", check)
    good = status == 0 and says(text, words) and not any(re.search(word, text) for word in never)
    if hips:
        good = good and hips[0] <= float(high.group(1)) <= hips[1]
    row(path, good, check.strip().splitlines()[-1] + " || " + text + ("" if good else check))


def smpl(path, expected, *options, **more):
    motion(path, expected, *options, checker="check_smpl.py", **more)


def line(path, *words, options=(), status=1, never=()):
    """`info` ends with this status and says all words."""
    if not wanted(path):
        return
    got, text = run(MIMICX, "info", CASES / path, *options)
    row(path, got == status and says(text, words) and not any(re.search(word, text) for word in never), text[-700:])


def files(folder, pattern):
    return sorted(f"{folder}/{path.name}" for path in (CASES / folder).glob(pattern))


motion(d := "01-mixamo-fingers/walk.bvh", d.replace(".bvh", ".expected.npz"))
motion(d := "01-mixamo-fingers/numbered_namespace.bvh", d.replace(".bvh", ".expected.npz"))
motion(d := "02-rokoko-100fps/dance.bvh", d.replace(".bvh", ".expected.npz"))
motion(d := "04-z-up-walk-inches/zombie.bvh", d.replace(".bvh", ".expected.npz"))
for name in ("walk1", "zombieWalk1"):
    motion(d := f"05-makehuman-decimetres/{name}.bvh", d.replace(".bvh", ".expected.npz"), hips=(.70, .85))
d = "06-makehuman-split-limbs/"
motion(d + "tpose.bvh", d + "tpose.expected.npz", "--joint-map", CASES / d / "names.txt")
d = "08-bvh-in-a-txt/"
motion(d + "motion.txt", d + "motion.expected.npz")
if wanted(d):
    status, text = run(MIMICX, "audit", "--poses", CASES / d / "in_a_folder")
    row(d + "in_a_folder", status == 0 and "motion" in text, text)
d = "09-bvh-text-variants/"
motion(d + "a_original_crlf_tabs.bvh", d + "expected.npz")
first = None
for path in files(d[:-1], "?_*.bvh") if wanted(d) else []:
    out = OUT / "spelling.npz"
    status, text = run(MIMICX, "convert", CASES / path, out, "--force")
    digest = hashlib.sha256(out.read_bytes()).hexdigest() if status == 0 else None
    first = first or digest
    row(path, digest == first or (path[len(d)] not in "abcj" and status == 1 and says(text, ["line |UTF-16"])), text)
d = "10-comma-decimals/"
line(d + "comma.bvh", "line .*,")
line(d + "comma_rows_only.bvh", "line .*,")
motion(d + "point.bvh", d + "expected.npz")
d = "11-frame-times/"
for name, rate in (("59.94", "59.94"), ("29.97", "29.97"), ("23.976", "23.976"), ("60_as_0.016667", "60"),
                   ("30_as_0.033", "30"), ("60_as_0.017", "60"), ("30_as_0.0333", "30"), ("120_as_0.0083", "120")):
    line(f"{d}fps_{name}.bvh", rf"frames +\d+ at {rate}\d* fps", status=0)
motion(d + "fps_1_ganimator.bvh", d + "fps_1_ganimator.expected.npz", "--fps", 30)
line(d + "fps_1_ganimator.bvh", "warning.*1 fps is odd", status=0)
for name in ("zero", "zero_0.000000", "nan", "rate_not_time", "missing_number"):
    motion(f"{d}fps_{name}.bvh", d + "mocapbank60.expected.npz", "--fps", 30, rate=30)
    line(f"{d}fps_{name}.bvh", "line 119", "--fps")
d = "15-bones-along-x-rest/"
motion(d + "lafan_like.bvh", d + "expected.npz", never=["may be"])
d = "17-zero-length-toes/"
for unit in ("cm", "dm"):
    motion(f"{d}zero_toes_{unit}.bvh", d + "expected.npz", hips=(.71, .80))
d = "19-duplicate-names-two-roots/"
for name in ("toe_called_as_foot", "fingers_of_one_name", "person_and_a_prop", "prop_first"):
    motion(f"{d}{name}.bvh", d + "expected.npz", never=["may be"])
line(d + "two_people_two_roots.bvh", "2 skeletons", "--root")
motion(d + "two_people_two_roots.bvh", d + "expected_second.npz", "--root", 2)
d = "21-nan-gaps"
for path in files(d, "gap_*"):
    line(path, "line|row|frame")
line(d + "/nan_in_a_finger_only.npz", status=0)
line(d + "/nan_in_unused_beta.npz", status=0)
d = "23-lying-and-swimming/"
smpl(d + "backstroke_z_up.npz", d + "expected_backstroke_smpl.npz")
smpl(d + "backstroke_y_up.npz", d + "expected_backstroke_smpl.npz", "--up", "y")
smpl(d + "asleep_along_x_z_up.npz", d + "expected_asleep_smpl.npz")
motion(d + "backstroke_y_up.bvh", d + "expected_backstroke.npz", "--up", "y")
d = "24-stairs-treadmill-turntable/"
smpl(d + "stairs_z_up.npz", d + "expected_stairs_smpl.npz")
smpl(d + "treadmill_run_z_up.npz", d + "expected_treadmill_smpl.npz")
motion(d + "three_channel_root.bvh", d + "expected_turntable.npz", rate=120, never=["may be"], words=["position"])
d = "27-mdm-results/"
for letter in "aefjkbcdhi":
    for path in files(d[:-1], letter + "_*.npy"):
        motion(path, d + "expected.npz")
line(d + "g_T_66.npy", "shape")
line(d + "results.npy", "convert_video_results")
if wanted(d):
    for name in ("results", "results_three"):
        status, text = run_python(CONVERTER, CASES / d / f"{name}.npy", OUT / name)
        row(d + name + ", converted", status == 0, text)
    out = OUT / "second.npz"
    run(MIMICX, "convert", OUT / "results_three_person2.npy", out)
    status, text = run_python(CASES / "tools/check_limbs.py", CASES / d / "expected_three_2.npz", out)
    row(d + "results_three, the second", status == 0, text)
d = "28-humanml3d-features/"
for letter in "aec":
    for path in files(d[:-1], letter + "_*.npy"):
        motion(path, d + "expected.npz")
for letter in "bdfg":
    for path in files(d[:-1], letter + "_*.npy"):
        line(path, "shape|normalised")
d = "29-smpl-under-other-names/"
for path in files(d[:-1], "[abcdfgj]_*.npz"):
    smpl(path, d + "expected_smpl.npz")
for path in files(d[:-1], "[ei]_*.npz"):
    smpl(path, d + "expected_smpl.npz", "--fps", 30)
    line(path, "expected a frame rate")
for path in files(d[:-1], "[hkl]_*.npz"):
    line(path, "expected .*, found .*")
d = "31-motionx-to-amass-recipe/"
smpl(d + "converted.npz", d + "expected_smpl.npz", "--fps", 30, rate=30)
line(d + "converted.npz", "up axis: y", "warning.*number of frames", status=0)
d = "33-still-person-y-up/"
for name in ("a_one_frame", "b_constant_60", "c_jitter_60", "d_two_frames"):
    for suffix in (".npz", "_motionx.npy"):
        smpl(d + name + suffix, f"{d}{name}.expected.npz")
smpl(d + "e_seated_talking_y_up.npz", d + "e_seated_talking.expected.npz")
d = "34-pickled-results/"
smpl(d + "amass_with_pickled_labels.npz", d + "expected_smpl.npz", words=["pickle"])
for name in ("trace_like.npz", "romp_like.npz", "phc_like.pkl", "phalp_like.pkl"):
    line(d + name, "pickle", "convert_video_results", never=["frame rate"])
for name, expected, words, options in (
        ("trace_like.npz", 1, "expected a member 'world_global_rots'", []), ("romp_like.npz", 0, "frames 0 to 39", []),
        ("phc_like.pkl", 0, "frames 0 to 39", []), ("phalp_like.pkl", 0, "frames 0 to 39", ["--size", 1920, 1080]),
        ("phalp_like.pkl", 1, "--size W H", [])):  # its depths need the picture's size, which is not in it
    if wanted(d):
        status, text = run_python(CONVERTER, CASES / d / name, OUT / (name + ".npz"), *options)
        row(d + name + ", converted", status == expected and words in text and len(text.splitlines()) == 1, text)
d = "39-mjcf-extreme-bodies/"
if wanted(d):
    models = [("betas " + one, ["--betas", one]) for one in (CASES / d / "betas.txt").read_text().split()]
    models += [(one, ["--motion", CASES / d / one]) for one in ("toddler_cm.bvh", "giant.bvh")]
    for name, options in models:
        status, text = run(MIMICX, "export-mjcf", OUT / "model.xml", "--force", *options)
        if status == 0:
            status, text = run_python(CASES / "tools/check_mjcf.py", OUT / "model.xml")
        row(d + name, status == 0, text)
print(f"{failed} failed")
sys.exit(failed > 0)

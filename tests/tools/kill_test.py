#!/usr/bin/env python3
"""Kills `mimicx` with SIGKILL at random moments, again and again, and compares what it ends in with a run that was
left alone: pretrain, adapt, plan, run and merge, every byte of every file but timing.json.

    kill_test.py MIMICX DATA [--kills N] [--seed S] [--only COMMAND]

DATA holds motions (data/synthetic/train/truth). A command is started, killed after a random time, and started again in
the same folder until it ends by itself; then its files are compared, and it begins anew in an empty folder, until N
kills have hit a living process. Exit status 77: no NumPy here, skipped.
"""
import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError:
    sys.exit(77)

FRAMES = 20
CLIPS = ("stand_101", "squat_101", "walk_101")
# Networks and roll-outs so small that a whole training takes a fraction of a second.
SMALL = "characters=64 group_size=16 hidden_1=16 hidden_2=16 horizon=8 minibatch=256 pass_rows=64 evaluate_iterations=2"
ENCODER = "--clusters 3 --no-encoder"
TEACH = "teach_hidden=16 teach_rounds=2 teach_least_steps=20"


def settings(names):
    return " ".join("--set " + name for name in names.split())


def make_clips(data, folder):
    """Short pieces of three motions: few frames, the same members."""
    for name in CLIPS:
        whole = np.load(data / (name + ".npz"), allow_pickle=False)
        frames = len(whole["poses"])
        folder.mkdir(exist_ok=True)
        np.savez(folder / (name + ".npz"),
                 **{key: whole[key][:FRAMES] if whole[key].shape[:1] == (frames,) else whole[key] for key in whole})


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != "timing.json"}


class Job:
    """A command line with OUT in the place of its folder, and what stands there before it begins."""

    def __init__(self, mimicx, line, begin=None):
        self.mimicx, self.line, self.begin = mimicx, line.split(), begin

    def start(self, out):
        words = [self.mimicx] + [word.replace("OUT", str(out)) for word in self.line]
        return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def prepare(self, out):
        shutil.rmtree(out, ignore_errors=True)
        if self.begin:
            shutil.copytree(self.begin, out)

    def undisturbed(self, out):
        """@return the seconds that it takes"""
        self.prepare(out)
        begun = time.monotonic()
        process = self.start(out)
        message = process.communicate()[1].decode()
        if process.returncode != 0:
            sys.exit(f"{' '.join(self.line)}: status {process.returncode}\n{message}")
        return time.monotonic() - begun


def ended_or_killed(process, seconds):
    """@return its status where it ended in time, else None: killed"""
    try:
        process.communicate(timeout=seconds)
        return process.returncode
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return None


def kill_and_compare(name, job, scratch, kills, draw):
    whole, killed = scratch / (name + "-whole"), scratch / (name + "-killed")
    seconds = job.undisturbed(whole)
    expected = files_of(whole)
    done = ends = tries = 0
    while done < kills or tries:
        if not tries:
            job.prepare(killed)
        tries += 1
        # On average in the middle; the longer it has been at it, the later, so that it gets to its end at all.
        status = ended_or_killed(job.start(killed), draw.uniform(0.0, seconds * (1.0 + 0.2 * tries)))
        if status is None:
            done += 1
            continue
        if status != 0:
            sys.exit(f"{name}: status {status} after {done} kills")
        found = files_of(killed)
        wrong = sorted(path for path in set(expected) | set(found) if expected.get(path) != found.get(path))
        if wrong:
            sys.exit(f"{name}: after {done} kills these files differ: {', '.join(wrong)}")
        ends, tries = ends + 1, 0
    print(f"{name}: {done} kills, {ends} times to the end, {len(expected)} files of the same bytes "
          f"({seconds:.2f} s undisturbed)", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mimicx")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only")
    arguments = parser.parse_args()
    mimicx = str(pathlib.Path(arguments.mimicx).resolve())
    with tempfile.TemporaryDirectory(prefix="mimicx-kill-") as name:
        scratch = pathlib.Path(name)
        clips, parts, options = scratch / "clips", scratch / "parts", scratch / "options"
        make_clips(arguments.data, clips)
        plan = f"plan {clips} --threads 1 --floor 0 --out OUT"
        pretrain = f"pretrain {clips} --samples 3000 --threads 1 {ENCODER} --out OUT {settings(SMALL)}"
        jobs = {"plan": Job(mimicx, plan), "pretrain": Job(mimicx, pretrain)}
        if arguments.only in (None, "adapt"):
            jobs["pretrain"].undisturbed(options)
        for part in ("0/2", "1/2") if arguments.only in (None, "merge") else ():
            Job(mimicx, f"{plan} --shard {part}").start(parts).communicate()
        jobs["adapt"] = Job(mimicx, f"adapt {clips} --budget-samples 1500 --threads 1 --floor 0 --options {options} "
                                    f"--out OUT {settings(SMALL + ' ' + TEACH)}")
        # No --set here: networks of the usual size, a single iteration each.
        jobs["run"] = Job(mimicx, f"run {clips} --pretrain-samples 1 --budget-samples 1 --clusters 2 --threads 1 "
                                  "--floor 0 --out OUT")
        jobs["merge"] = Job(mimicx, "merge OUT", parts)
        if arguments.only is not None and arguments.only not in jobs:
            parser.error(f"--only: expected one of {', '.join(jobs)}")
        for k, (command, job) in enumerate(jobs.items()):
            if arguments.only in (None, command):
                kill_and_compare(command, job, scratch, arguments.kills, random.Random(1000 * arguments.seed + k))


if __name__ == "__main__":
    main()

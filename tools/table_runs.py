"""What tools/paper and tools/results share: runs of mimicx that are made once, and the cells of their tables."""
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile


FOLLOWS = "plan", "adapt", "imitate"  # status 1: a motion was not followed, which is a result


def call(*arguments, statuses=(0, 1)):
    """Runs a program and returns its seconds of processor time."""
    print(*(pathlib.Path(arguments[0]).name, *arguments[1:]), file=sys.stderr)
    process = subprocess.Popen(list(map(str, arguments)), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    words = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) not in statuses:
        sys.exit(f"{words}{arguments[1]} ended with status {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime + usage.ru_stime


def spread(values, digits=None):
    """Mean±standard error."""
    values = [math.inf if v is None else v for v in values]
    if any(map(math.isinf, values)):
        return "never" if all(map(math.isinf, values)) else ", ".join("never" if math.isinf(v) else f"{v:.0f}" for v in values)
    mean, error = statistics.mean(values), statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0
    if mean == error == 0.0:
        return "0"
    if digits is None:
        digits = 1 if abs(mean) >= 10 else 2 if abs(mean) >= 0.01 else 4
        if error > 0.0:  # at least one digit of it
            digits = max(digits, min(4, -math.floor(math.log10(error))))
    return f"{mean:.{digits}f}" + (f"±{error:.{digits}f}" if len(values) > 1 else "")


def markdown(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|"] + ["| " + " | ".join(r) + " |" for r in rows])


class Runs:
    """A folder of runs that are made once. The file `versions` in it names every program that made one of them."""

    def __init__(self, program, out):
        self.program, self.out = program, out
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
        out.mkdir(parents=True, exist_ok=True)
        file = out / "versions"
        versions = file.read_text().splitlines() if file.exists() else []
        if version not in versions:
            versions.append(version)
            file.write_text("\n".join(versions) + "\n")
        self.version = " and ".join(versions)

    def run(self, out, *arguments):
        """Runs mimicx into the folder unless it is made, and leaves its seconds of processor time and its command beside it.
        Where it is made again, the scores beside it are removed."""
        done, made_by = (out.parent / (out.name + end) for end in (".seconds", ".command"))
        command = " ".join(map(str, arguments)) + "\n"
        if not done.exists() or not out.exists():
            out.parent.mkdir(parents=True, exist_ok=True)
            for old in (done, *out.parent.glob(f"{out.name}.*scores.json")):
                old.unlink(missing_ok=True)
            made_by.write_text(command)
            statuses = (0, 1) if arguments[0] in FOLLOWS else (0,)
            done.write_text(f"{call(self.program, *arguments, '--out', out, statuses=statuses):.2f}\n")
        elif not made_by.exists() or made_by.read_text() != command:
            sys.exit(f"{out} was made by another command than mimicx {command.strip()}: remove it, or give another --out")
        return out

    def scores(self, truth, motions, table=None):
        """{name: {metric: value}} of the motions in a folder, by `mimicx evaluate`; in the table, made once (default: beside
        the folder)."""
        table = table or motions.with_suffix(".scores.json")
        if not table.exists():
            call(self.program, "evaluate", "--truth", truth, "--motions", motions, "--json", table)
        return {m["name"]: {k: v["value"] for k, v in m["metrics"].items()}
                for m in json.loads(table.read_text())["motions"] if m["status"] == "ok"}

    def needs(self, folder):
        """{name: summary} of what `mimicx audit --poses` finds of the motions in a folder."""
        with tempfile.TemporaryDirectory() as there:
            table = pathlib.Path(there, "audit.json")
            call(self.program, "audit", "--poses", folder, "--json", table)
            files = json.loads(table.read_text())["files"]
        return {pathlib.Path(f["file"]).stem: f["summary"] for f in files if f.get("summary")}

    @staticmethod
    def link(target, folder, name=None):
        """A link in the folder that is the target, under its own name or another."""
        link = folder / (name or target.name)
        if not link.exists():
            link.symlink_to(target.resolve())
        return link

    @staticmethod
    def entries(run):
        """{name: entry} of a run's manifest."""
        return {e["name"]: e for e in json.loads((run / "manifest.json").read_text())["sequences"]}

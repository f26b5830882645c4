"""tools/steps: how a script ends that begins commands beside its steps.

  steps_test.py tools/steps
"""
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

STEPS = sys.argv.pop(1)


def run(script):
    return subprocess.run(["bash", "-c", f"set -euo pipefail\nsource {STEPS}\n{script}"], capture_output=True, text=True,
                          timeout=60)


class Beside(unittest.TestCase):
    def test_script_succeeds_where_both_commands_did(self):
        done = run("beside echo one; joined; beside echo two; joined; echo end")
        self.assertEqual((done.returncode, done.stdout), (0, "one\ntwo\nend\n"))

    def test_script_fails_where_the_command_did_and_says_what_it_said(self):
        done = run("beside bash -c 'echo why; exit 3'; joined; echo not reached")
        self.assertEqual((done.returncode, done.stdout), (3, "why\n"))

    def test_script_that_fails_keeps_its_status_and_ends_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            begun = pathlib.Path(folder) / "id"
            done = run(f"beside bash -c 'echo $$ >{begun}; exec sleep 50'; until [[ -s {begun} ]]; do sleep .1; done; "
                       "(exit 4)")
            self.assertEqual(done.returncode, 4)
            status = pathlib.Path(f"/proc/{int(begun.read_text())}/status")
            for _ in range(100):
                if not status.exists() or "zombie" in status.read_text():
                    return
                time.sleep(0.1)
            self.fail("the command still runs")


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""tools/paper: its means, and what it says of a training; tools/results: what it writes into a page; runs made once.

    paper_test.py TOOLS
"""
import contextlib
import io
import pathlib
import re
import sys
import tempfile
import unittest

from loaded_script import loaded

TOOLS = pathlib.Path(sys.argv.pop(1))
sys.path.insert(0, str(TOOLS))
paper, results = loaded(TOOLS / "paper"), loaded(TOOLS / "results")
table_runs = sys.modules["table_runs"]


class Means(unittest.TestCase):
    def test_spread_is_the_mean_and_its_standard_error(self):
        self.assertEqual(paper.spread([1.0, 2.0, 3.0]), "2.00±0.58")  # 1 / √3
        self.assertEqual(paper.spread([0.030, 0.031, 0.032]), "0.0310±0.0006")
        self.assertEqual(paper.spread([0.0, 0.0]), "0")
        self.assertEqual(paper.spread([12.34]), "12.3")
        self.assertEqual(paper.spread([float("inf"), None]), "never")
        self.assertEqual(paper.spread([5.0, None]), "5, never")

    def test_failures_are_part_of_means_and_counted(self):
        seeds = [[{"MPJPE": 10.0, "followed": True}, {"MPJPE": 30.0, "followed": False}, {"MPJPE": None, "followed": False}]]
        self.assertEqual(paper.Paper.means(seeds, "MPJPE"), "20.0")
        self.assertEqual(paper.Paper.followed(seeds), "1 of 3")

    def test_scratch_trains_with_its_own_settings(self):
        commands, made = [], paper.Paper.__new__(paper.Paper)
        made.size, made.out = paper.SIZES[False], pathlib.Path("out")
        made.run = lambda out, *arguments: commands.append(list(map(str, arguments))) or out
        made.cleaned(1, "everyday", "scratch")
        scratch = commands[-1]
        self.assertEqual(scratch[0], "imitate")
        changed = {scratch[i + 1].split("=")[0] for i, word in enumerate(scratch) if word == "--set"}
        self.assertEqual(changed, {"stop_reward", "stall_evaluations", "evaluate_iterations"})  # when it ends, what is logged

    def test_samples_count_to_the_first_roll_out_within_the_threshold(self):
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder)
            (run / "training").mkdir()
            (run / "training/walk.csv").write_text("samples,rollout_position_error_mm\n1000,50\n2000,\n3000,19\n4000,18\n")
            samples = paper.Paper.samples_to_threshold
            self.assertEqual(samples(run, {"name": "walk", "metrics_before": {"gMPJPE": 60}}), 3000)
            self.assertEqual(samples(run, {"name": "walk", "metrics_before": {"gMPJPE": 15}}), 0)
            self.assertIsNone(samples(run, {"name": "jump", "metrics_before": {}}))

    def test_every_row_of_the_paper_has_a_number_per_column(self):
        for rows in paper.PAPER_1.values():
            self.assertEqual({len(row.split()) for row in rows.values()}, {len(paper.COLUMNS_1)})
        self.assertEqual({len(row.split()) for row in paper.ROWS_2.values()}, {len(paper.COLUMNS_2) + 1})
        self.assertEqual({len(row.split()) for rows in paper.PAPER_3.values() for row in rows}, {len(paper.COLUMNS_3) - 2})

    def test_the_truth_of_files_is_planned_once_for_all_seeds(self):
        with tempfile.TemporaryDirectory() as folder:
            scores = ", ".join(f'"{k}": {{"value": 1.0}}' for k in (*paper.COLUMNS_1, "FS_gt", "Jitter"))
            program = pathlib.Path(folder, "program")
            program.write_text(f"""#!/bin/sh
                for last; do :; done
                case $1 in
                --version) echo one ;;
                evaluate) echo '{{"motions": [{{"name": "walk", "status": "ok", "metrics": {{{scores}}}}}]}}' > "$last" ;;
                *) mkdir -p "$last"
                   echo '{{"sequences": [{{"name": "walk", "status": "ok", "feasibility": {{}}}}]}}' > "$last/manifest.json" ;;
                esac""")
            program.chmod(0o755)
            out, argv = pathlib.Path(folder, "out"), sys.argv
            sys.argv = ["paper", "spread", "a walk.bvh", "--seeds", "2", "3", "--out", str(out), "--mimicx", str(program)]
            try:
                with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as commands:
                    paper.main()
            finally:
                sys.argv = argv
            table = (out / "spread.md").read_text()
        self.assertEqual(len(re.findall(r"^program plan \S+/truth ", commands.getvalue(), re.MULTILINE)), 1)
        self.assertIn("`tools/paper spread 'a walk.bvh' --seeds 2 3`", table)
        self.assertIn("independent, keypoints: 1 of 1, 1 of 1", table)


class Results(unittest.TestCase):
    def written(self, page, **tables):
        with tempfile.TemporaryDirectory() as folder:
            for name, table in tables.items():
                pathlib.Path(folder, f"{name}.md").write_text(table)
            return results.in_marks(page, [pathlib.Path(folder)])

    def test_tables_are_written_between_their_marks_again_and_again(self):
        page = "a\n<!-- table1.md -->\nold\n<!-- end of table1.md -->\nb\n"
        for _ in range(2):
            page = self.written(page, table1="`command`\n\n| x |\n|---|\n")
            self.assertEqual(page, "a\n<!-- table1.md -->\n`command`\n\n| x |\n|---|\n<!-- end of table1.md -->\nb\n")

    def test_the_output_of_a_program_keeps_its_lines(self):
        output = "```\n" + 50 * "ab  " + "\nc\n```"
        page = self.written("<!-- speed.md -->\n<!-- end of speed.md -->\n", speed=output)
        self.assertEqual(page, f"<!-- speed.md -->\n{output}\n<!-- end of speed.md -->\n")

    def test_a_missing_table_stays_and_a_quick_one_is_refused(self):
        page = "<!-- table1.md -->\nold\n<!-- end of table1.md -->\n"
        with contextlib.redirect_stderr(io.StringIO()) as words:
            self.assertEqual(self.written(page), page)
        self.assertIn("table1.md is not made", words.getvalue())
        with self.assertRaises(SystemExit):
            self.written(page, table1="tools/paper 1 --quick")

    def test_tables_of_real_motions_stay_where_a_folder_of_them_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            shared, out = pathlib.Path(folder, "shared"), pathlib.Path(folder, "out")
            for name in list(results.REAL.values())[1:]:
                (shared / "motions" / name).mkdir(parents=True)
            program = pathlib.Path(folder, "program")
            program.write_text("#!/bin/sh\n")
            program.chmod(0o755)
            words, before, argv = io.StringIO(), [page.read_text() for page in results.PAGES], sys.argv
            sys.argv = ["results", *results.OF_REAL, "--shared", str(shared), "--out", str(out), "--paper", folder,
                        "--mimicx", str(program)]
            try:
                with contextlib.redirect_stderr(words):
                    results.main()
            finally:
                sys.argv = argv
            self.assertEqual([page.read_text() for page in results.PAGES], before)
            self.assertIn("real stays as it is", words.getvalue())
            self.assertEqual(list(out.glob("*.md")), [])

    def test_every_table_between_marks_can_be_made(self):
        made = {*results.TABLES, "table1", "table2", "table3"}
        for page in results.PAGES:
            self.assertLessEqual(set(re.findall(r"<!-- (\w+)\.md -->", page.read_text())), made)
        for table in results.TABLES:
            self.assertTrue(callable(getattr(results.Results, table)))


class MadeOnce(unittest.TestCase):
    @staticmethod
    def runs(folder, script):
        """Runs in folder/out by a program that is this shell script."""
        program = pathlib.Path(folder, "program")
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        return table_runs.Runs(program, pathlib.Path(folder, "out"))

    def test_a_run_is_made_once_and_every_version_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "out")
            for version in ("one", "two"):
                runs = self.runs(folder, f'if [ "$1" = --version ]; then echo {version}; else mkdir -p "$3"; echo {version} >> "$3/made"; fi')
                with contextlib.redirect_stderr(io.StringIO()):
                    runs.run(out / "plan", "plan", "--out", out / "plan")
            self.assertEqual((out / "plan/made").read_text(), "one\n")
            self.assertEqual(runs.version, "one and two")

    def test_a_run_by_another_command_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            runs = self.runs(folder, '[ "$1" = --version ] || mkdir "$5"')
            with contextlib.redirect_stderr(io.StringIO()):
                runs.run(runs.out / "plan", "plan", "--clips", 1)
                runs.run(runs.out / "plan", "plan", "--clips", 1)
                with self.assertRaisesRegex(SystemExit, "another command than mimicx plan --clips 8"):
                    runs.run(runs.out / "plan", "plan", "--clips", 8)

    def test_a_removed_run_is_made_again_and_its_scores_are_removed(self):
        with tempfile.TemporaryDirectory() as folder:
            runs = self.runs(folder, '[ "$1" = --version ] || mkdir "$5"')
            with contextlib.redirect_stderr(io.StringIO()):
                plan = runs.run(runs.out / "plan", "plan", "--clips", 1)
                for name in ("plan.scores.json", "plan.noisy.scores.json", "planned.scores.json"):
                    (runs.out / name).write_text("{}")
                plan.rmdir()
                self.assertTrue(runs.run(plan, "plan", "--clips", 8).exists())
            self.assertEqual((runs.out / "plan.command").read_text(), "plan --clips 8\n")
            self.assertEqual([path.name for path in runs.out.glob("*.scores.json")], ["planned.scores.json"])

    def test_only_motions_that_are_not_followed_are_a_result(self):
        with tempfile.TemporaryDirectory() as folder:
            runs = self.runs(folder, '[ "$1" = --version ] && exit 0\necho full disk >&2\nexit 1')
            with contextlib.redirect_stderr(io.StringIO()):
                runs.run(runs.out / "plan", "plan")
                for _ in range(2):  # it is not taken for made
                    with self.assertRaisesRegex(SystemExit, "full disk"):
                        runs.run(runs.out / "set", "synth")


unittest.main()

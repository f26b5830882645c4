#!/usr/bin/env python3
"""tools/paper: its means, and what it says of a training; tools/results: what it writes into a page.

    paper_test.py TOOLS
"""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(sys.argv.pop(1))
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("paper", str(TOOLS / "paper"))
paper = importlib.util.module_from_spec(importlib.util.spec_from_loader("paper", loader))
loader.exec_module(paper)


class Means(unittest.TestCase):
    def test_spread_is_the_mean_and_its_standard_error(self):
        self.assertEqual(paper.spread([1.0, 2.0, 3.0]), "2.00 ± 0.58")  # 1 / √3
        self.assertEqual(paper.spread([12.34]), "12.3")
        self.assertEqual(paper.spread([float("inf"), None]), "never")
        self.assertEqual(paper.spread([5.0, None]), "5, never")

    def test_failures_are_part_of_means_and_counted(self):
        seeds = [[{"MPJPE": 10.0, "followed": True}, {"MPJPE": 30.0, "followed": False}, {"MPJPE": None, "followed": False}]]
        self.assertEqual(paper.Paper.means(seeds, "MPJPE"), "20.0")
        self.assertEqual(paper.Paper.followed(seeds), "1 of 3")

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


class Results(unittest.TestCase):
    def results(self, text, **tables):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "page.md")
            page.write_text(text)
            for name, table in tables.items():
                pathlib.Path(folder, f"{name}.md").write_text(table)
            done = subprocess.run([TOOLS / "results", folder, page], capture_output=True, text=True, check=False)
            return done, page.read_text()

    def test_tables_are_written_between_their_marks_again_and_again(self):
        page = "a\n<!-- table1.md -->\nold\n<!-- end of table1.md -->\nb\n"
        for _ in range(2):
            done, page = self.results(page, table1="`command`\n\n| x |\n|---|\n")
            self.assertEqual(done.returncode, 0)
            self.assertEqual(page, "a\n<!-- table1.md -->\n`command`\n\n| x |\n|---|\n<!-- end of table1.md -->\nb\n")

    def test_a_missing_table_stays_and_a_quick_one_is_refused(self):
        page = "<!-- table1.md -->\nold\n<!-- end of table1.md -->\n"
        done, text = self.results(page)
        self.assertEqual((done.returncode, text), (0, page))
        self.assertIn("table1.md is missing", done.stderr)
        done, text = self.results(page, table1="tools/paper 1 --quick")
        self.assertEqual((done.returncode, text), (1, page))


unittest.main()

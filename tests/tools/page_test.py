#!/usr/bin/env python3
"""tools/page --npm never writes over the folder that it copies.

    page_test.py TOOL
"""
import pathlib
import sys
import tempfile
import unittest

from loaded_script import loaded

page = loaded(sys.argv.pop(1))


class Package(unittest.TestCase):
    def test_refuses_its_source_and_what_is_above_it(self):
        with tempfile.TemporaryDirectory() as folder:
            page.MODULE = pathlib.Path(folder).resolve() / "above/javascript"
            page.MODULE.mkdir(parents=True)
            for package in (page.MODULE, page.MODULE.parent):
                (package / "mimicx.mjs").write_text("source")
            for out in (page.MODULE, page.MODULE.parent, page.MODULE / "../../above"):
                with self.assertRaisesRegex(SystemExit, "has the source of the package"):
                    page.write_package(out, page.MODULE / "glue.js", page.MODULE / "program.wasm")
            self.assertEqual((page.MODULE / "mimicx.mjs").read_text(), "source")


unittest.main()

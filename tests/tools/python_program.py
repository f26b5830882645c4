"""Runs Python programs in forks of this process, which has loaded NumPy: a start takes milliseconds, not a tenth of a
second.
"""
import os
import runpy
import sys
import tempfile
import traceback

import numpy  # noqa: F401  for the programs

LOADED = set(sys.modules)


def ended(path, arguments):
    """@return the exit status of the program, run in this process"""
    for name in set(sys.modules) - LOADED:
        del sys.modules[name]
    sys.argv = [str(path), *map(str, arguments)]
    sys.path[0] = os.path.dirname(path)
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def run(path, *arguments):
    """@return exit status, standard output, standard error"""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as error:
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(error.fileno(), 2)
            status = ended(path, arguments)
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (out, error):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
        return status, *texts

"""Loads a Python program, whose file has no suffix, as a module; leaves no compiled file beside it."""
import importlib.machinery
import importlib.util
import pathlib
import sys

sys.dont_write_bytecode = True


def loaded(path):
    name = pathlib.Path(path).name
    loader = importlib.machinery.SourceFileLoader(name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module

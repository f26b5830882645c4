#!/usr/bin/env python3
"""The clean copies of a run stand where the simulated body does, for whoever loads them as SMPL, SMPL-H or SMPL-X.

    clean_bodies_test.py MIMICX MOTION

MOTION (a motion of data/synthetic) is written here as another program would write it, with each body model, and
planned. Each copy in clean/ must have its model's name, columns and betas, and its pelvis, trans + J0 of that model,
must be that of motions/. Exit status 77: no NumPy here, skipped.
"""
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

J0 = {"mimicx": [.003, -.351, .012], "smplx": [.003, -.351, .012], "smplh": [-.002, -.223, .028],
      "smpl": [-.002, -.223, .028]}  # rest pelvis of the models, m
COLUMNS = {"smpl": 72, "smplh": 156, "smplx": 165}
FRAMES = 40

mimicx, motion = sys.argv[1], np.load(sys.argv[2])
pelvis = motion["trans"][:FRAMES] + J0["mimicx"]
random = np.random.default_rng(1)
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    betas = {model: random.normal(size=16 if model == "smplh" else 10) for model in COLUMNS}
    hands = {model: 0.1 * random.normal(size=(FRAMES, columns - 66)) for model, columns in COLUMNS.items()}
    for model in COLUMNS:
        np.savez(folder / f"{model}.npz", poses=np.hstack([motion["poses"][:FRAMES, :66], hands[model]]),
                 trans=pelvis - J0[model], betas=betas[model], mocap_framerate=30.0, gender="male", body_model=model)
    files = [str(folder / f"{model}.npz") for model in COLUMNS]
    run = subprocess.run([mimicx, "plan", *files, "--out", str(folder / "run")], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    for model, columns in COLUMNS.items():
        ours, clean = (np.load(folder / "run" / part / f"{model}.npz") for part in ("motions", "clean"))
        assert str(ours["body_model"]) == "mimicx" and str(clean["body_model"]) == model, model
        apart = np.abs(clean["trans"] + J0[model] - (ours["trans"] + J0["mimicx"])).max()
        assert apart < 1e-9, (model, apart)
        assert np.abs(ours["joints"][:, 0] - (ours["trans"] + J0["mimicx"])).max() < 1e-9, model
        assert np.abs(clean["joints"][:, 0] - ours["joints"][:, 0]).max() < 1e-9, model
        assert clean["poses"].shape == (FRAMES, columns), (model, clean["poses"].shape)
        assert np.array_equal(clean["poses"][:, 66:], hands[model]), model
        assert np.allclose(clean["betas"], betas[model], atol=0), (model, clean["betas"])
        assert str(clean["gender"]) == "male", model
        print(f"{model}: {columns} columns, pelvis {1e3 * apart:.1e} mm from the simulated one")

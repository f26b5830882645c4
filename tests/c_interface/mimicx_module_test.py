#!/usr/bin/env python3
"""python/mimicx.py over the built library.
  mimicx_module_test.py MODULE LIBRARY PROGRAM MOTION.npz      status 77 where NumPy is not there
"""
import copy
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("mimicx module: Skipped: no NumPy here")
    sys.exit(77)

MODULE, LIBRARY, PROGRAM, MOTION = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:5])
os.environ["MIMICX_LIBRARY"] = LIBRARY
sys.path.insert(0, str(pathlib.Path(MODULE).parent))
sys.dont_write_bytecode = True
import mimicx  # noqa: E402

FILE = dict(np.load(MOTION))
N = 30


def beginning(**more):
    return mimicx.clean(FILE["poses"][:N], FILE["trans"][:N], FILE["betas"], fps=30, body_model="mimicx", **more)


class Cleaning(unittest.TestCase):
    def test_a_file_gives_the_bytes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            small = pathlib.Path(folder, "small.npz")
            np.savez(small, poses=FILE["poses"][:N], trans=FILE["trans"][:N], betas=FILE["betas"], mocap_framerate=30.0,
                     body_model="mimicx")
            subprocess.run([PROGRAM, "plan", str(small), "--out", folder + "/run", "--quiet"], check=True)
            motion = mimicx.load(small)
            self.assertTrue(motion.clean())
            self.assertEqual(motion.bytes(".npz"), pathlib.Path(folder, "run/motions/small.npz").read_bytes())
            run = mimicx.Run(folder + "/run")
            (entry, arrays), = run.motions()
            np.testing.assert_array_equal(arrays["poses"], motion["poses"])
            self.assertEqual(entry["metrics"], motion.record["metrics"])
            stretches = mimicx.RunMotions(folder + "/run", frames=10, stride=5)
            self.assertEqual(len(stretches), 5)
            self.assertEqual(stretches[4]["ground_wrenches"].shape, (10, 22, 6))
            np.testing.assert_array_equal(stretches[1]["trans"], arrays["trans"][5:15].astype(np.float32))
            shaped = mimicx.RunMotions(folder + "/run", frames=5, members=("betas", "poses"))
            self.assertEqual(len(shaped), N // 5)
            np.testing.assert_array_equal(shaped[1]["betas"], arrays["betas"].astype(np.float32))
            for wrong in ({"frames": N + 1}, {"stride": -1}):
                with self.assertRaises(ValueError):
                    mimicx.RunMotions(folder + "/run", **wrong)
            with self.assertRaisesRegex(KeyError, "wings"):
                mimicx.RunMotions(folder + "/run", members=("wings",))
            with self.assertRaisesRegex(mimicx.Error, "lost"):
                run.arrays({"name": "lost", "output": "", "reason": "fell"})

    def test_betas_of_a_motion_of_ten_frames_are_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            small = pathlib.Path(folder, "small.npz")
            np.savez(small, poses=FILE["poses"][:10], trans=FILE["trans"][:10], betas=FILE["betas"], mocap_framerate=30.0,
                     body_model="mimicx")
            subprocess.run([PROGRAM, "plan", str(small), "--out", folder + "/run", "--quiet"], check=True)
            stretches = mimicx.RunMotions(folder + "/run", frames=5, members=("betas", "poses"))
            self.assertEqual((stretches[1]["betas"].shape, stretches[1]["poses"].shape[0]), ((10,), 5))

    def test_arrays_are_cleaned_and_outlive_the_motion(self):
        told = []
        result = beginning(progress=told.append, threads=1)
        self.assertTrue(result.followed)
        self.assertTrue(told and all(isinstance(text, str) for text in told))
        torques = result["joint_torques"]
        self.assertEqual(torques.shape, (N, 55))
        del result
        self.assertTrue(np.isfinite(torques).all())
        other = mimicx.clean(FILE["poses"][:N].reshape(N, 22, 3), FILE["trans"][:N], FILE["betas"], body_model="mimicx")
        np.testing.assert_array_equal(other["joint_torques"], torques)
        self.assertLess(other.metrics["slip"], 1.0)

    def test_keypoints_by_name_are_fitted(self):
        names, points = FILE["keypoint_names"], FILE["keypoints_2d"][:N]
        extrinsics = FILE["camera_extrinsics"]
        camera = (FILE["camera_intrinsics"], extrinsics if extrinsics.ndim == 2 else extrinsics[:N])
        result = beginning(keypoints={str(n): points[:, k] for k, n in enumerate(names)}, camera=camera)
        self.assertIn("residual_after_percent", result.record["fit"])
        in_bytes = beginning(keypoints={str(n).encode(): points[:, k] for k, n in enumerate(names)}, camera=camera)
        np.testing.assert_array_equal(in_bytes["poses"], result["poses"])
        unknown = beginning(keypoints={f"tentacle{k}": points[:, k] for k in range(len(names))}, camera=camera)
        self.assertRegex(" ".join(unknown.notes), "keypoints")
        with self.assertRaisesRegex(ValueError, "camera"):
            beginning(keypoints=points)
        self.assertNotIn("residual_after_percent", beginning(fit=False).record.get("fit", {}))

    def test_progress_stops_it_and_its_errors_come_out(self):
        with self.assertRaises(mimicx.Stopped):
            beginning(progress=lambda doing: True)
        self.assertTrue(beginning(progress=len).followed)  # what a stream's write returns stops nothing

        def broken(doing):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            beginning(progress=broken)

    def test_errors_have_the_library_s_words(self):
        with self.assertRaisesRegex(mimicx.Error, "colour"):
            mimicx.Motion(colour=1)
        with self.assertRaisesRegex(mimicx.Error, "trans"):
            mimicx.clean(FILE["poses"][:N], FILE["trans"][:N - 1])
        with self.assertRaisesRegex(KeyError, "wings"):
            mimicx.load(MOTION)["wings"]
        with self.assertRaisesRegex(ValueError, "poses"):
            mimicx.clean(FILE["poses"][:0], FILE["trans"][:0])

    def test_results_are_copied_and_sent_and_handles_are_not(self):
        result = beginning()
        for copied in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
            np.testing.assert_array_equal(copied["poses"], result["poses"])
            self.assertEqual((copied.metrics, copied.motion), (result.metrics, None))
        for handle in (result.motion, mimicx.Simulator()):
            for copier in (copy.copy, copy.deepcopy, pickle.dumps):
                with self.assertRaises(TypeError):
                    copier(handle)

    def test_scene_and_mass_are_as_the_program_has_them(self):
        plate = {"centre": [0, 0], "half_extents": [9, 9], "height": 0.3}
        raised = FILE["trans"][:N] + [0, 0, 0.3]
        high = mimicx.clean(FILE["poses"][:N], raised, FILE["betas"], body_model="mimicx", scene={"plates": [plate]}, fit=False)
        self.assertEqual(high["scene_plates"].shape, (1, 8))
        self.assertGreater(high["trans"][:, 2].min(), 0.9)
        self.assertNotIn("scene_plates", mimicx.clean(FILE["poses"][:N], FILE["trans"][:N], FILE["betas"], body_model="mimicx",
                                                      scene="auto", fit=False))
        with self.assertRaisesRegex(mimicx.Error, "mass"):
            mimicx.Motion(mass=-3)
        with self.assertRaisesRegex(mimicx.Error, "[.]glb"):
            mimicx.load(MOTION).bytes(".fbx")

    def test_forces_of_another_body_are_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "cleaned.npz")
            file.write_bytes(beginning().motion.bytes(".npz"))
            as_it_is, heavier = mimicx.load(file), mimicx.load(file, mass=100)
            self.assertEqual(as_it_is["joint_torques"].shape, (N, 55))
            with self.assertRaises(KeyError):
                heavier["joint_torques"]
            self.assertIn(b"torque", as_it_is.bytes(".csv").split(b"\n")[0])
            self.assertNotIn(b"torque", heavier.bytes(".csv").split(b"\n")[0])
            with self.assertRaisesRegex(mimicx.Error, "mass=100"):
                heavier.bytes(".mot")
            other_rate = mimicx.load(file, fps=60)  # the motion keeps its own
            np.testing.assert_array_equal(other_rate["joint_torques"], as_it_is["joint_torques"])
            self.assertEqual(other_rate.bytes(".mot"), as_it_is.bytes(".mot"))

    def test_poses_are_audited(self):
        found = mimicx.audit(FILE["poses"][:N], FILE["trans"][:N], FILE["betas"], body_model="mimicx")
        self.assertEqual(found[0]["evidence"], "poses alone")


class Simulating(unittest.TestCase):
    def test_it_stands_and_is_pushed(self):
        body = mimicx.Simulator()
        height = body.root_position[2]
        body.step(24)
        self.assertAlmostEqual(body.root_position[2], height, delta=0.02)
        self.assertGreater(body.ground_wrenches[:, 5].sum(), 300)
        body.push[3] = 200
        x = body.root_position[0]
        body.step(24)
        self.assertGreater(body.root_position[0], x + 0.005)
        body.stand()
        self.assertEqual(body.root_position[2], height)
        pushed = mimicx.Simulator()
        pushed.push = [0, 0, 0, 200, 0, 0]
        pushed.step(24)
        self.assertGreater(pushed.root_position[0], x + 0.005)
        for steps in (8.0, 2**32 + 1):
            with self.assertRaises((TypeError, ValueError)):
                pushed.step(steps)
        with self.assertRaisesRegex(ValueError, "from 1, found 0"):
            pushed.step(0)

    def test_arrays_outlive_the_simulator(self):
        place = mimicx.Simulator().root_position
        np.testing.assert_array_less([0, 0, 0.5], place + [1, 1, 0])

    def test_settings_and_shapes_are_checked(self):
        with self.assertRaisesRegex(mimicx.Error, "friction"):
            mimicx.Simulator(friction=-1)
        with self.assertRaisesRegex(mimicx.Error, "gravity: expected 0.001"):
            mimicx.Simulator(gravity=0)
        with self.assertRaises(ValueError):
            mimicx.Simulator(betas=[1, 2])
        body = mimicx.Simulator(betas=np.eye(10)[0], gravity=1.62)
        body.target_rotations[4] = 0
        with self.assertRaisesRegex(mimicx.Error, "left_knee"):
            body.step()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

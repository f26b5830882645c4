"""tools/check_real: what counts as worse, how large a spread is, and the errors of forces.

  check_real_test.py tools/check_real      status 77 without NumPy
"""
import pathlib
import sys
import tempfile
import types
import unittest

from loaded_script import loaded

try:
    import numpy as np
except ImportError:
    sys.exit(77)

real = loaded(sys.argv.pop(1))


def judged(values, table):
    measured = types.SimpleNamespace(values=values, of_inputs={}, lost=[])
    return real.judge("video", measured, {("video", k): v for k, v in table.items()})


class Judging(unittest.TestCase):
    def test_errors_may_grow_by_their_spread_and_fall_by_any_amount(self):
        for value, worse in ((0.1, False), (0.55, False), (0.61, True)):
            self.assertEqual(judged({"slip": value}, {"slip": (0.5, 0.1)}), ["video slip"] if worse else [])

    def test_share_of_followed_motions_must_not_fall(self):
        for value, worse in ((1.0, False), (0.9, False), (0.89, True)):
            self.assertEqual(judged({"followed": value}, {"followed": (0.9, 0.0)}),
                             ["video followed"] if worse else [])

    def test_rounding_of_the_table_is_not_worse(self):
        self.assertEqual(judged({"followed": 27 / 28}, {"followed": (0.9643, 0.0)}), [])

    def test_measure_that_is_gone_is_worse(self):
        self.assertEqual(judged({}, {"slip": (0.5, 0.1)}), ["video slip"])
        self.assertEqual(judged({"slip": float("nan")}, {"slip": (0.5, 0.1)}), ["video slip"])

    def test_new_measure_is_not(self):
        self.assertEqual(judged({"slip": 9.0}, {}), [])


class Spread(unittest.TestCase):
    def test_is_the_largest_difference_but_not_nothing(self):
        self.assertAlmostEqual(real.spread_of("slip", [1.0, 1.2, 0.7]), 0.3)
        self.assertAlmostEqual(real.spread_of("slip", [1.0, 1.0, 1.0]), 0.03)
        self.assertAlmostEqual(real.spread_of("time", [1.0, 1.0, 1.0]), 0.5)
        self.assertEqual(real.spread_of("followed", [1.0, 1.0, 1.0]), 0.0)


class Forces(unittest.TestCase):
    def test_errors_are_those_that_were_put_in(self):
        frames, mass, weight = 20, 80.0, 700.0
        ground = np.zeros((frames, 22, 6))
        ground[:, 7, 5] = 0.5 * weight + 0.03 * weight  # 3 % too much on the left foot, in two bodies
        ground[:, 11, 5] = 0.5 * weight
        ground[:, 11, 3] = 0.04 * weight
        samples = 10 * frames
        plate = np.zeros((samples, 3))
        plate[:, 2] = 0.5 * 9.81 * mass
        valid = np.ones((samples, 2), bool)
        ground[15:, 7, 5] += 300.0  # not seen by the left plate
        valid[141:, 0] = False
        with tempfile.TemporaryDirectory() as folder:
            data, motion = pathlib.Path(folder) / "d.npz", pathlib.Path(folder) / "m.npz"
            np.savez(data, grf_left=plate, grf_right=plate, valid=valid, grf_fps=300, mass=mass)
            np.savez(motion, ground_wrenches=ground)
            whole, foot, newtons = real.force_errors(data, motion, weight)
        self.assertAlmostEqual(whole, 3.0)
        seen_left, seen_right = 13 - 1 + 1, 17  # frames 2 ... 14, 2 ... 18
        self.assertAlmostEqual(foot, 3.0 * np.sqrt(seen_left / (seen_left + seen_right)))
        self.assertAlmostEqual(newtons, 9.81 * 0.05)


if __name__ == "__main__":
    unittest.main()

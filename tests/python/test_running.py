"""Progress, Ctrl-C, threads and sessions."""
import concurrent.futures
import os
import signal
import sys
import threading
import time
import unittest

import numpy as np
from support import Case, patch, vspring, wave

# A minute of work that comes to nothing: such a run ends when it is told to.
ENDLESS = {"method": "sweep", "step_tolerance": 1e-300, "max_iterations": 3_000_000}


class Stop(Exception):
    pass


class Bar:
    """What tqdm shows."""

    def __init__(self, total):
        self.n, self.total, self.steps = 0, total, []

    def update(self, n):
        self.n += n
        self.steps.append(n)
        return True


class Told(Case):
    def test_progress(self):
        vertices, faces = patch(cells=40, noise=0.002)
        told = []
        result = vspring.fair(vertices, faces, progress=told.append)
        fractions = [now.fraction for now in told]
        self.assertTrue(fractions)
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue(0 <= fractions[0] and fractions[-1] <= 1)
        self.assertTrue(all(now.stage for now in told))
        self.assert_same_bits(result.positions, vspring.fair(vertices, faces).positions)

    def test_bar_of_tqdm_is_filled(self):
        vertices, faces = patch()
        for total in (1, 100):
            bar = Bar(total)
            vspring.fair(vertices, faces, progress=bar)
            self.assertAlmostEqual(bar.n, total)
            self.assertGreater(len(bar.steps), 1)
            self.assertGreaterEqual(min(bar.steps), 0)
        bar = Bar(1)
        vspring.fit(vertices, faces, vertices + 0.01, weight=0.1, progress=bar)
        self.assertAlmostEqual(bar.n, 1)


class TimeLimit(Case):
    def test_ends_with_the_best_so_far(self):
        with self.assertWarnsRegex(vspring.Warning, "time limit of 0.2 s"):
            positions, report = vspring.fair_curve(wave(), time_limit=0.2, **ENDLESS)
        self.assertEqual((report.outcome, report.converged, report.usable), ("work-limit", False, False))
        self.assertEqual(report.warnings[-1].code, "time-limit")
        self.assertLess(report.iterations, ENDLESS["max_iterations"])
        self.assertTrue(np.isfinite(positions).all())

    def test_one_that_is_not_reached_changes_nothing(self):
        curve = wave()
        positions, report = vspring.fair_curve(curve, fix_normals="boundary", time_limit=1e6)
        self.assertEqual((report.outcome, report.usable, report.warnings), ("converged", True, ()))
        self.assert_same_bits(positions, vspring.fair_curve(curve, fix_normals="boundary").positions)
        with self.assertRaisesRegex(vspring.Error, "time_limit: seconds, more than 0"):
            vspring.fair_curve(curve, time_limit=0)


class Ended(Case):
    def assert_best_so_far(self, ended, curve):
        self.assertEqual((ended.report.outcome, ended.report.usable), ("cancelled", False))
        self.assert_same_bits(ended.positions[[0, -1]], curve[[0, -1]])
        inflections = vspring.measure(ended.positions)["curvature_extrema"].value
        self.assertLess(inflections, vspring.measure(curve)["curvature_extrema"].value)

    def test_by_what_progress_raises(self):
        curve = wave()

        def stop(now):
            if now.iteration > 1000:
                raise Stop("enough")

        with self.assertRaisesRegex(Stop, "enough") as caught:
            vspring.fair_curve(curve, progress=stop, **ENDLESS)
        self.assert_best_so_far(caught.exception, curve)

    def test_by_ctrl_c(self):
        curve = wave()
        main = threading.get_ident()
        # What runs in the background of a shell is begun without a handler.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))

        def interrupt():
            # This thread comes to run only where the call has released Python's lock.
            while sys._current_frames()[main].f_code.co_name != "_fair":
                time.sleep(0.01)
            time.sleep(0.2)
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=interrupt).start()
        with self.assertRaises(KeyboardInterrupt) as caught:
            vspring.fair_curve(curve, **ENDLESS)
        self.assert_best_so_far(caught.exception, curve)
        self.assertTrue(vspring.fair_curve(curve).report.converged)

    def test_surface(self):
        vertices, faces = patch(cells=60)

        def stop(now):
            raise Stop

        with self.assertRaises(Stop) as caught:
            vspring.fit(vertices, faces, vertices, within=0.05, progress=stop)
        self.assertEqual(caught.exception.report.outcome, "cancelled")
        self.assertTrue(np.isfinite(caught.exception.positions).all())


class Threads(Case):
    def test_results_have_the_same_bits(self):
        tasks = [patch(cells=cells, seed=cells) for cells in (20, 24, 28, 32)]

        def fair(task):
            return vspring.fair(*task, springs="edge").positions

        one_by_one = [fair(task) for task in tasks]
        with concurrent.futures.ThreadPoolExecutor(len(tasks)) as pool:
            for expected, at_once in zip(one_by_one * 3, pool.map(fair, tasks * 3)):
                self.assert_same_bits(at_once, expected)
        for threads in (1, 3):
            self.assert_same_bits(vspring.fair(*tasks[0], springs="edge", threads=threads).positions, one_by_one[0])

    def test_calls_run_side_by_side(self):
        met = threading.Barrier(2)

        def fair(seed):
            meet = iter([met.wait])
            return vspring.fair(*patch(seed=seed), progress=lambda now: next(meet, lambda **_: None)(timeout=60)).positions

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            both = list(pool.map(fair, (1, 2)))
        for seed, positions in zip((1, 2), both):
            self.assert_same_bits(positions, vspring.fair(*patch(seed=seed)).positions)

    def test_a_fork_goes_on(self):
        vertices, faces = patch(cells=40, noise=0.002)
        for _ in range(8):
            expected = vspring.fair(vertices, faces, threads=4).positions
            child = os.fork()
            if child == 0:
                signal.alarm(60)
                os._exit(0 if (vspring.fair(vertices, faces, threads=4).positions == expected).all() else 1)
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)


class Sessions(Case):
    def test_a_drag_follows_what_is_held(self):
        vertices, faces = patch(cells=20)
        session = vspring.Session(vertices, faces, fix_normals="boundary")
        self.assertIsNone(session.predict())
        middle = 220
        for height in (0.0, 0.05, 0.1):
            place = vertices[middle] + [0, 0, height]
            session.hold(middle, place)
            positions, report = session.update()
            self.assertEqual(report.outcome, "converged")
            self.assertEqual(positions[middle].tolist(), place.tolist())
        predicted = session.predict()
        np.testing.assert_allclose(predicted, positions, atol=2e-3)
        fair = session.fair()
        rules = [{"nodes": [middle], "position": place}]
        exact = vspring.fair(vertices, faces, fix_normals="boundary", constraints=rules, tolerance=1e-9).positions
        np.testing.assert_allclose(fair.positions, exact, atol=1e-4)
        session.free(middle)
        np.testing.assert_allclose(session.fair().positions, vspring.fair(vertices, faces, fix_normals="boundary").positions, atol=1e-4)
        session.hold(middle)
        self.assert_same_bits(session.update().positions[middle], vertices[middle])

    def test_normals(self):
        vertices, faces = patch(cells=20)
        session = vspring.Session(vertices, faces)
        session.hold_normal(220, [0.2, 0, 1])
        rules = [{"nodes": [220], "normal": [0.2, 0, 1]}]
        np.testing.assert_allclose(session.fair().positions, vspring.fair(vertices, faces, constraints=rules).positions, atol=1e-4)
        session.free_normal(220)
        np.testing.assert_allclose(session.fair().positions, vspring.fair(vertices, faces).positions, atol=1e-4)

    def test_curves_have_the_bits_of_fair_curve(self):
        flat = wave()[:, :2].astype(np.float32)
        session = vspring.Session(flat)
        session.hold(30, [1.5, 2])
        session.hold_tangent(0, [1, 1])
        rules = [{"nodes": [30], "position": [1.5, 2]}, {"nodes": [0], "tangent": [1, 1]}]
        self.assert_same_bits(session.fair().positions, vspring.fair_curve(flat, constraints=rules).positions)
        session.free_tangent(0)
        session.free(30)
        self.assert_same_bits(session.fair().positions, vspring.fair_curve(flat).positions)

    def test_threads_wait_for_each_other(self):
        vertices, faces = patch(cells=20)
        session = vspring.Session(vertices, faces)
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for result in pool.map(lambda _: session.fair(), range(8)):
                np.testing.assert_allclose(result.positions, vspring.fair(vertices, faces).positions, atol=1e-4)

    def test_its_own_progress_cannot_call_it(self):
        vertices, faces = patch(cells=20)
        session = vspring.Session(vertices, faces)
        for call in (lambda now: session.hold(220, [0, 0, 0.1]), lambda now: session.update(), lambda now: session.predict()):
            with self.assertRaisesRegex(vspring.Error, "its own progress function") as caught:
                session.fair(progress=call)
            self.assertEqual(caught.exception.positions.shape, vertices.shape)
        np.testing.assert_allclose(session.fair().positions, vspring.fair(vertices, faces).positions, atol=1e-4)

    def test_another_thread_waits_for_progress(self):
        vertices, faces = patch(cells=20)
        session = vspring.Session(vertices, faces)
        holders = []

        def tell(now):
            if not holders:
                holders.append(threading.Thread(target=session.hold, args=(220, [0, 0, 0.1])))
                holders[0].start()

        self.assertNotEqual(session.fair(progress=tell).positions[220].tolist(), [0, 0, 0.1])
        holders[0].join()
        self.assertEqual(session.fair().positions[220].tolist(), [0, 0, 0.1])

    def test_refused(self):
        vertices, faces = patch()
        session = vspring.Session(vertices, faces)
        for words, call in [("999", lambda: session.hold(999, [0, 0, 0])), ("999", lambda: session.hold(999)),
                            ("position: 3 real", lambda: session.hold(3, [0, 0, 0, 0])),
                            ("position: 3 real", lambda: session.hold(3, [0, 0])), ("normal: 3 real", lambda: session.hold_normal(3, [0, 1])), ("zero", lambda: session.hold_normal(3, [0, 0, 0])),
                            ("tolerance", lambda: session.update(tolerance=0))]:
            with self.assertRaisesRegex(vspring.Error, words):
                call()

        for words, call in [("node: a whole number", lambda: session.hold(84.0, [0, 0, 0])), ("node: a whole number", lambda: session.free(None)),
                            ("tolerance: a number", lambda: session.update(tolerance="x"))]:
            with self.assertRaisesRegex(TypeError, words):
                call()
        flat = vspring.Session(wave()[:, :2])
        flat.hold(3, [0, 0])
        flat.hold(4, [0.1, 0, 0])

        def stop(now):
            raise Stop

        with self.assertRaises(Stop) as caught:
            session.fair(progress=stop)
        self.assertEqual(caught.exception.positions.shape, vertices.shape)
        self.assertTrue(session.fair().report.converged)


if __name__ == "__main__":
    unittest.main()

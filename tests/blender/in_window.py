"""What needs a window: progress, Esc, and the panel that does an operator again with other values. Ends Blender, with status 1 on failure."""
import os
import pathlib
import sys
import threading
import time
import traceback

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

PATIENCE = 60
"""Seconds until what is waited for counts as failed."""


class Window(support.Case):
    def press_escape(self):
        window = bpy.context.window_manager.windows[0]
        for value in ('PRESS', 'RELEASE'):
            window.event_simulate(type='ESC', value=value, x=window.width // 2, y=window.height // 2)

    def invoke(self):
        with self.area():
            return bpy.ops.mesh.vspring_fair('INVOKE_DEFAULT', True)

    def last(self):
        done = bpy.context.window_manager.operators
        return done[-1] if len(done) else None

    def steps(self):
        """Yields conditions that Blender's own loop is to bring about."""
        real = support.module().fair
        told = []

        def slow(*arguments, progress, **options):
            def tell(now):
                told.append(now.fraction)
                progress(now)

            begin = time.monotonic()
            while time.monotonic() - begin < self.seconds:
                tell(support.module().Progress("waiting", 0.5, 0, 0.0))
                time.sleep(0.02)
            return real(*arguments, progress=tell, **options)

        slow.__name__ = "fair"
        support.module().fair = slow
        with self.area():
            _, vertices, faces, chosen = self.edited_patch()
        now = lambda: self.places(bpy.data.objects["Part"])

        self.seconds = PATIENCE
        self.assertEqual(self.invoke(), {'RUNNING_MODAL'})
        yield lambda: len(told) > 30
        self.press_escape()
        count = [0]

        def is_quiet():
            before, count[0] = count[0], len(told)
            return before == len(told)

        yield is_quiet
        yield lambda: not any(thread.name == "vspring" for thread in threading.enumerate())
        self.assert_same_bits(now(), vertices)
        self.assertIsNone(self.last())

        self.seconds = 1
        self.assertEqual(self.invoke(), {'RUNNING_MODAL'})
        with self.area():
            bpy.ops.object.mode_set(mode='OBJECT')
        yield lambda: not any(thread.name == "vspring" for thread in threading.enumerate())
        yield lambda: True
        with self.area():
            bpy.ops.object.mode_set(mode='EDIT')
        self.assert_same_bits(now(), vertices)
        self.assertIsNone(self.last())

        support.forget_results()
        self.assertEqual(self.invoke(), {'RUNNING_MODAL'})
        yield lambda: self.last() is not None
        whole = real(vertices, faces, region=chosen).positions
        self.assert_same_bits(now(), whole)
        self.assertEqual(self.last().bl_idname, "MESH_OT_vspring_fair")

        support.module().fair = None  # a change of strength needs nothing of it but its name
        slow_name = type("Named", (), {"__name__": "fair"})()
        support.module().fair = slow_name
        self.last().properties.strength = 0.5
        with self.area():
            bpy.ops.ed.undo_redo('EXEC_DEFAULT', True)
        np.testing.assert_allclose(now(), vertices + 0.5 * (whole - vertices), atol=1e-7)
        with self.area():
            bpy.ops.ed.undo()
        self.assert_same_bits(now(), vertices)

        support.module().fair = real
        self.assertEqual(self.invoke(), {'FINISHED'})
        np.testing.assert_allclose(now(), vertices + 0.5 * (whole - vertices), atol=1e-7)  # as it was left

        yield from self.panels()

    def panels(self):
        """What operators show after they ran, and the menu. What fails there Blender prints, and `run` looks for that."""
        vertices, faces = support.grid()
        scan = vertices.copy()
        scan[:, 2] += 0.1
        row = np.arange(6 * 13, 7 * 13)
        middle = support.within(vertices, 0.6)
        for name, chosen, options in [
                ("vspring_fair", middle, {"normals_from": 'OBJECT'}), ("vspring_fair_edges", row, {}), ("vspring_fit", middle, {}),
                ("vspring_smooth", middle, {"by": 'DISTANCE', "within": 0.05}), ("vspring_measure", row, {})]:
            self.setUp()
            yield lambda: True
            with self.area():
                other, thing = self.add(scan, faces, name="Scan"), self.add(vertices, faces)
                self.edit(thing, selected=[chosen])
                other.select_set(True)
                self.assertEqual(getattr(bpy.ops.mesh, name)('EXEC_DEFAULT', True, **options), {'FINISHED'})
                self.assertEqual(self.last().bl_idname, "MESH_OT_" + name)
                bpy.ops.screen.redo_last('INVOKE_DEFAULT')
            yield from self.shown(name)
        with self.area():
            bpy.ops.wm.call_menu(name="VIEW3D_MT_edit_mesh_vertices")
        yield from self.shown("menu")
        with self.area():
            bpy.context.space_data.show_region_ui = True
            bpy.ops.wm.call_panel(name="VSPRING_PT_fair")
        yield from self.shown("panel")

    def shown(self, name):
        """Waits until it is drawn, keeps a picture where VSPRING_SHOTS names a folder, and closes it."""
        for _ in range(3):
            yield lambda: True
        if "VSPRING_SHOTS" in os.environ:
            with self.area():
                bpy.ops.screen.screenshot(filepath=os.path.join(os.environ["VSPRING_SHOTS"], name + ".png"))
        self.press_escape()
        yield lambda: True


def run():
    window = Window()
    state = {}

    def tick():
        try:
            if not state:
                support.install()
                window.setUp()
                state.update(steps=window.steps())
                state.update(until=next(state["steps"]), begin=time.monotonic())
            if state["until"]():
                state.update(until=next(state["steps"]), begin=time.monotonic())
            elif time.monotonic() - state["begin"] > PATIENCE:
                raise AssertionError("waited in vain")
        except StopIteration:
            print("in a window: passed", flush=True)
            os._exit(0)
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        return 0.3

    bpy.app.timers.register(tick, first_interval=0.5, persistent=True)


run()

"""The add-on beside Blender's own operators, on the same selections: figures and times. `run` starts it, as Sculpt Mode needs a window."""
import argparse
import importlib
import json
import os
import pathlib
import sys
import time
import traceback

import bpy
import mathutils
import numpy as np
import selections
import support

parser = argparse.ArgumentParser()
parser.add_argument("names", nargs="*")
parser.add_argument("--mesh-fairing", type=pathlib.Path)
ASKED = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
OUT = selections.ROOT / "out/blender"
WAIT = 0.3


class Bench(support.Case):
    def look_at(self, place, normal, size):
        """Has the middle of the view show a place of a surface, and the mouse stand there."""
        with self.area():
            context = bpy.context
            view = context.space_data.region_3d
            view.view_perspective, view.view_location, view.view_distance = 'ORTHO', place, 2 * size
            view.view_rotation = mathutils.Vector(normal).to_track_quat('Z', 'Y')
            region, window = context.region, context.window
            window.event_simulate(type='MOUSEMOVE', value='NOTHING', x=region.x + region.width // 2, y=region.y + region.height // 2)

    def fair(self, thing, mask, **options):
        with self.area():
            self.edit(thing, selected=[mask])
            begin = time.perf_counter()
            bpy.ops.mesh.vspring_fair(**options)
            seconds = time.perf_counter() - begin
            bpy.ops.object.mode_set(mode='OBJECT')
        return seconds

    def smooth(self, thing, mask, repeat):
        with self.area():
            self.edit(thing, selected=[mask])
            begin = time.perf_counter()
            bpy.ops.mesh.vertices_smooth(factor=0.5, repeat=repeat)
            seconds = time.perf_counter() - begin
            bpy.ops.object.mode_set(mode='OBJECT')
        return seconds

    def mesh_fairing(self, thing, mask, continuity):
        """What that add-on does in a thread, without one."""
        sys.path.insert(0, str(ASKED.mesh_fairing.parent))
        package = ASKED.mesh_fairing.name
        operators, types, linalg = (importlib.import_module(f"{package}.{name}") for name in ("operators", "types", "linalg"))
        linalg.init()
        with self.area():
            self.edit(thing, selected=[mask])
            begin = time.perf_counter()
            operators.MESH_OT_fair_vertices_internal.WorkerThread(thing.data, types.Continuity[continuity], False).run()
            seconds = time.perf_counter() - begin
            bpy.ops.object.mode_set(mode='OBJECT')
        return seconds

    def sculpt(self, thing, mask, mode):
        """A generator: waits for the window, and returns the seconds. Moves the vertices all of whose faces are in the face set."""
        with self.area():
            self.edit(thing)
            bpy.context.tool_settings.mesh_select_mode = (False, False, True)
            bpy.ops.object.mode_set(mode='OBJECT')
            for face in thing.data.polygons:
                face.select = bool(mask[list(face.vertices)].any())
            bpy.ops.object.mode_set(mode='EDIT')
            bpy.ops.mesh.hide(unselected=True)
            bpy.ops.object.mode_set(mode='SCULPT')
            bpy.ops.sculpt.face_sets_create(mode='VISIBLE')
            bpy.ops.sculpt.reveal_all()
        places, normals = selections.places_of(thing), selections.normals_of(thing)
        inner = np.flatnonzero(mask)
        middle = inner[np.linalg.norm(places[inner] - places[inner].mean(axis=0), axis=1).argmin()]
        self.look_at(places[middle], normals[middle], np.ptp(places[inner], axis=0).max())
        yield
        yield
        with self.area():
            begin = time.perf_counter()
            bpy.ops.sculpt.face_set_edit('INVOKE_DEFAULT', mode=mode)
            seconds = time.perf_counter() - begin
            bpy.ops.object.mode_set(mode='OBJECT')
        return seconds


def figures(before, thing, mask):
    """Of what moved: bending, evenness of curvature, turns; how far it went."""
    places = selections.places_of(thing)
    faces = [list(face.vertices) for face in thing.data.polygons]
    found = support.module().measure(places, faces, fix=~mask)
    moves = np.linalg.norm(places - before, axis=1)
    return {"moved": (moves > 0).sum(), "bending": found.bending_energy, "evenness": found.mean_curvature_variation, "turn": found.greatest_turn, "flipped": found.flipped_faces,
            "crossing": found.self_intersections, "move": moves.max(), "outside": moves[~mask].max(initial=0)}


def ways(bench):
    theirs = {} if ASKED.mesh_fairing is None else {
        f"mesh-fairing, {name}": lambda thing, mask, continuity=continuity: bench.mesh_fairing(thing, mask, continuity)
        for name, continuity in (("tangency", 'TAN'), ("curvature", 'CURV'))}
    return {
        "as it was": None,
        "Fair (vspring)": lambda thing, mask: bench.fair(thing, mask, boundary='TANGENT'),
        "Fair, by position": lambda thing, mask: bench.fair(thing, mask, join='POSITION'),
        "Fair Tangency": lambda thing, mask: bench.sculpt(thing, mask, 'FAIR_TANGENCY'),
        "Fair Positions": lambda thing, mask: bench.sculpt(thing, mask, 'FAIR_POSITIONS'),
        "Smooth Vertices × 10": lambda thing, mask: bench.smooth(thing, mask, 10),
        "Smooth Vertices × 100": lambda thing, mask: bench.smooth(thing, mask, 100),
        **theirs,
    }


SELECTIONS = {"forehead": selections.forehead, "horn": selections.horn, "blend": selections.blend, "cap": selections.cap,
              "large cap": lambda: selections.cap(6)}


def loops(bench):
    """A ring around a tube, with noise: LoopTools' Relax and Fair Edge Loop."""
    for name in ("as it was", "Fair Edge Loop", "LoopTools Relax × 25"):
        bench.setUp()
        yield
        with bench.area():
            bpy.ops.preferences.addon_enable(module="mesh_looptools")
            bpy.ops.mesh.primitive_cylinder_add(vertices=48, depth=2, end_fill_type='NOTHING')
            thing = bpy.context.object
            bench.edit(thing)
            bpy.ops.mesh.select_all(action='SELECT')
            bpy.ops.mesh.subdivide(number_cuts=3)
            bpy.ops.object.mode_set(mode='OBJECT')
            places = selections.places_of(thing)
            ring = np.flatnonzero(np.abs(places[:, 2]) < 1e-6)
            ring = ring[np.argsort(np.arctan2(places[ring, 1], places[ring, 0]))]
            places[ring] *= 1 + 0.02 * np.random.default_rng(3).standard_normal((len(ring), 1)) * [1, 1, 0]
            selections.put(thing, places)
            bench.edit(thing, selected=[ring])
            begin = time.perf_counter()
            if name == "Fair Edge Loop":
                bpy.ops.mesh.vspring_fair_edges(within=0.06)
            elif name.startswith("LoopTools"):
                bpy.ops.mesh.looptools_relax(iterations='25')
            seconds = time.perf_counter() - begin
            bpy.ops.object.mode_set(mode='OBJECT')
        after = selections.places_of(thing)
        curve = support.module().measure(after[ring], closed=True)
        print(f"ring | {name} | variation {curve.curvature_variation:.4g} | radius {np.linalg.norm(after[ring, :2], axis=1).min():.4f} to "
              f"{np.linalg.norm(after[ring, :2], axis=1).max():.4f} | {1000 * seconds:.0f} ms", flush=True)
        yield


def steps():
    bench = Bench()
    OUT.mkdir(parents=True, exist_ok=True)
    for title, make in SELECTIONS.items():
        if ASKED.names and title not in ASKED.names:
            continue
        kept = {}
        for name, run in ways(bench).items():
            bench.setUp()
            yield
            with bench.area():
                thing, mask = make()
            before = selections.places_of(thing)
            seconds = 0.0 if run is None else run(thing, mask)
            if not isinstance(seconds, float):
                seconds = yield from seconds
            found = figures(before, thing, mask)
            truth = f", from the sphere {selections.away_from_sphere(selections.places_of(thing), mask):.3g}" if "cap" in title else ""
            print(f"{title} ({mask.sum()}) | {name} | " + ", ".join(f"{key} {value:.4g}" for key, value in found.items()) + truth
                  + f" | {1000 * seconds:.0f} ms", flush=True)
            kept[name] = selections.places_of(thing).tolist()
        (OUT / f"{title}.json").write_text(json.dumps(kept))
    yield from loops(bench)


def run():
    state = {}

    def tick():
        try:
            if not state:
                support.install()
                state["steps"] = steps()
            next(state["steps"])
        except StopIteration:
            os._exit(0)
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        return WAIT

    bpy.app.timers.register(tick, first_interval=0.5, persistent=True)


run()

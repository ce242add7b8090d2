"""The add-on as a person has it: packed, installed, enabled; and meshes in Edit Mode."""
import contextlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import bmesh
import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("VSPRING_BUILD", ROOT / "build/release"))
ADDON = "vspring_addon"


def install():
    archive = subprocess.run([ROOT / "blender/pack", "--build", BUILD], check=True, capture_output=True, text=True).stdout.strip()
    with told():
        bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
        bpy.ops.preferences.addon_enable(module=ADDON)


def module():
    """The module vspring that the add-on has inside."""
    return sys.modules[f"{ADDON}.vspring"]


def forget_results():
    """Of what was asked for last."""
    sys.modules[f"{ADDON}.running"].Job.kept.clear()


@contextlib.contextmanager
def told():
    """What Blender prints meanwhile, reports of operators too, as a list of one text."""
    lines = []
    sys.stdout.flush()
    with tempfile.TemporaryFile("w+") as into:
        kept = os.dup(1)
        os.dup2(into.fileno(), 1)
        try:
            yield lines
        finally:
            sys.stdout.flush()
            os.dup2(kept, 1)
            os.close(kept)
            into.seek(0)
            lines.append(into.read())


def grid(cells=12, noise=0.02, seed=7):
    """A saddle with noise: vertices in single precision, and quads."""
    line = np.linspace(-1, 1, cells + 1)
    x, y = (one.ravel() for one in np.meshgrid(line, line, indexing="ij"))
    vertices = np.column_stack([x, y, (x * x - y * y) / 2]) + noise * np.random.default_rng(seed).standard_normal((len(x), 3))
    node = np.arange(len(x)).reshape(cells + 1, cells + 1)
    quads = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    return vertices.astype(np.float32), quads


def within(vertices, reach):
    """The mask of the vertices of a grid around its middle."""
    return np.abs(vertices[:, :2]).max(axis=1) < reach


class Case(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        bpy.ops.preferences.addon_enable(module=ADDON)
        forget_results()

    def area(self):
        """Where there is a window: has operators run in its 3D view."""
        window = bpy.context.window_manager.windows[0]
        area = next(area for area in window.screen.areas if area.type == 'VIEW_3D')
        return bpy.context.temp_override(window=window, area=area, region=next(part for part in area.regions if part.type == 'WINDOW'))

    def add(self, vertices, faces=(), edges=(), name="Part"):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(np.asarray(vertices).tolist(), np.asarray(edges).tolist(), [list(map(int, face)) for face in faces])
        thing = bpy.data.objects.new(name, mesh)
        bpy.context.collection.objects.link(thing)
        return thing

    def edit(self, *things, selected=()):
        """Edit Mode of objects, with the vertices of masks or numbers selected in each."""
        bpy.ops.object.select_all(action='DESELECT')
        for thing in things:
            thing.select_set(True)
        bpy.context.view_layer.objects.active = things[0]
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.context.tool_settings.mesh_select_mode = (True, False, False)
        bpy.ops.mesh.select_all(action='DESELECT')
        for thing, chosen in zip(things, selected):
            self.select(thing, chosen)
        bpy.ops.ed.undo_push(message="before")

    def select(self, thing, chosen):
        made = bmesh.from_edit_mesh(thing.data)
        made.verts.ensure_lookup_table()
        for index in np.arange(len(made.verts))[chosen]:
            made.verts[index].select = True
        made.select_flush(True)
        bmesh.update_edit_mesh(thing.data)

    def places(self, thing):
        return np.array([vertex.co[:] for vertex in bmesh.from_edit_mesh(thing.data).verts], np.float32)

    def group(self, thing, name, nodes):
        thing.vertex_groups.new(name=name).add(np.asarray(nodes).tolist(), 1, 'REPLACE')

    def edited_patch(self, reach=0.6, **options):
        """A grid in Edit Mode, its middle selected: the object, its vertices, its faces, the mask of what is selected."""
        vertices, faces = grid(**options)
        thing = self.add(vertices, faces)
        chosen = within(vertices, reach)
        self.edit(thing, selected=[chosen])
        return thing, vertices, faces, chosen

    def assert_same_bits(self, left, right):
        left, right = np.asarray(left), np.asarray(right)
        self.assertEqual((left.dtype, left.shape), (right.dtype, right.shape))
        self.assertEqual(left.tobytes(), right.tobytes())

    def assert_refused(self, words, operator, **options):
        with told(), self.assertRaisesRegex(RuntimeError, words):
            operator(**options)

"""Meshes with a selection that wants to be fair, for pictures and comparisons in Blender: each function adds an object and returns it
with the mask of the selection."""
import json
import pathlib

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]


def places_of(thing):
    return np.array([vertex.co[:] for vertex in thing.data.vertices])


def normals_of(thing):
    return np.array([vertex.normal[:] for vertex in thing.data.vertices])


def put(thing, places):
    thing.data.vertices.foreach_set("co", places.astype(np.float32).ravel())
    thing.data.update()


def from_obj(path):
    vertices, faces = [], []
    for row in map(str.split, path.read_text().splitlines()):
        if row[:1] == ["v"]:
            vertices.append(list(map(float, row[1:4])))
        elif row[:1] == ["f"]:
            faces.append([int(corner.split("/")[0]) - 1 for corner in row[1:]])
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(vertices, [], faces)
    thing = bpy.data.objects.new(path.stem, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def forehead():
    """Suzanne, subdivided twice, with a dent in her forehead."""
    bpy.ops.mesh.primitive_monkey_add()
    thing = bpy.context.object
    thing.modifiers.new("Round", 'SUBSURF').levels = 2
    bpy.ops.object.modifier_apply(modifier="Round")
    places = places_of(thing)
    away = np.linalg.norm(places - np.array([0.0, -0.45, 0.75]), axis=1)
    depth = np.exp(-(away / 0.16) ** 2) * (0.10 + 0.05 * np.sin(40 * places[:, 0]) * np.cos(31 * places[:, 2]))
    put(thing, places - depth[:, None] * normals_of(thing))
    return thing, away < 0.34


def horn():
    """Spot, a horn selected."""
    thing = from_obj(ROOT / "examples/spot.obj")
    rules = json.loads((ROOT / "examples/spot-horns.json").read_text())["rules"]
    horns = np.concatenate([rule["nodes"] for rule in rules if rule["nodes"] != "all"])
    mask = np.zeros(len(thing.data.vertices), bool)
    mask[horns[places_of(thing)[horns, 0] > 0]] = True
    return thing, mask


def blend():
    """Three pipes that meet in a rough block; all is selected."""
    thing = from_obj(ROOT / "examples/pipe-blend.obj")
    return thing, np.ones(len(thing.data.vertices), bool)


def cap(subdivisions=5, seed=1):
    """A sphere of radius 1 with noise and a flattened top, which is selected: the true shape is known."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, radius=1)
    thing = bpy.context.object
    places = places_of(thing)
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    top = places[:, 2] > 0.75
    flat = places.copy()
    flat[top, 2] = 0.75 + 0.5 * (flat[top, 2] - 0.75)
    flat[top] += 0.005 * np.random.default_rng(seed).standard_normal((top.sum(), 3))
    put(thing, flat)
    return thing, top


def away_from_sphere(places, mask):
    return float(np.abs(np.linalg.norm(places[mask], axis=1) - 1).max())

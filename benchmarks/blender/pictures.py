"""Draws the pictures of docs/blender.md in Blender, by the operators of its add-on: before on the left, after on the right. `run` starts it."""
import json
import math
import sys

import bmesh
import bpy
import mathutils
import numpy as np
import selections
import support

WIDTH, HEIGHT = 900, 450

VIEWS = {"forehead": ((0.25, 1, -0.45), (0, 0, 1), 0.6), "horn": ((-0.35, 1, -0.35), (0, 0, 1), 0.35), "blend": ((0.5, 1, -0.6), (0, 0, 1), 1.75),
         "cap": ((0, 1, -0.9), (0, 0, 1), 1)}
"""Of each selection: which way one looks, what is up, and how far one sees."""

COLUMNS = ("as it was", "Fair (vspring)", "Fair Tangency", "Fair Positions", "Smooth Vertices × 100")


def material():
    """Grey, and glossy enough to show how light bands run."""
    made = bpy.data.materials.new("Grey")
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.55, 0.62, 0.7, 1)
    shader.inputs["Metallic"].default_value = 1
    shader.inputs["Roughness"].default_value = 0.05
    return made


def stripes():
    """A world of soft bands, which glossy surfaces mirror: where curvature jumps, bands have kinks."""
    world = bpy.data.worlds.new("Bands")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    place, wave, ramp = (nodes.new(kind) for kind in ("ShaderNodeTexCoord", "ShaderNodeTexWave", "ShaderNodeValToRGB"))
    wave.bands_direction, wave.inputs["Scale"].default_value = 'Z', 1.1
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.4, (0.12, 0.13, 0.16, 1)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.6, (1, 1, 1, 1)
    links.new(place.outputs["Generated"], wave.inputs["Vector"])
    links.new(wave.outputs["Color"], ramp.inputs["Fac"])
    # What is behind is white.
    mix, path, back = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeLightPath"), nodes.new("ShaderNodeBackground")
    front = nodes["Background"]
    links.new(ramp.outputs["Color"], front.inputs["Color"])
    back.inputs["Color"].default_value = (1, 1, 1, 1)
    links.new(path.outputs["Is Camera Ray"], mix.inputs["Fac"])
    links.new(front.outputs[0], mix.inputs[1])
    links.new(back.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], nodes["World Output"].inputs["Surface"])


def scene(draft):
    bench.setUp()
    stripes()
    render = bpy.context.scene.render
    render.engine = 'CYCLES'
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 50 if draft else 100
    bpy.context.scene.cycles.samples = 8 if draft else 32
    bpy.context.scene.cycles.max_bounces = 1
    bpy.context.scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
    bpy.context.scene.view_settings.view_transform = 'Standard'


def dressed(thing):
    for face in thing.data.polygons:
        face.use_smooth = True
    thing.data.materials.clear()
    thing.data.materials.append(material())
    thing.visible_glossy = False  # bands alone are mirrored


def shoot(before, after, towards, up, zoom, path, aim=(0, 0, 0)):
    """Both beside each other, from the direction `towards`, in parallel projection. aim: the middle of what is seen, of one of them."""
    turn = turn_of(towards, up)
    for thing, side in ((before, -1), (after, 1)):
        thing.matrix_world = mathutils.Matrix.Translation((side * zoom / 2, 0, 0)) @ turn @ mathutils.Matrix.Translation(-mathutils.Vector(aim))
        dressed(thing)
    render(2 * zoom, path)


def turn_of(towards, up):
    """Has a camera that looks along y see what another would see from the direction `towards`."""
    towards, up = mathutils.Vector(towards).normalized(), mathutils.Vector(up)
    across = towards.cross(up).normalized()
    return mathutils.Matrix((across, towards, across.cross(towards))).to_4x4()


def render(width, path):
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = 'ORTHO', width
    stand = bpy.data.objects.new("Camera", camera)
    bpy.context.collection.objects.link(stand)
    stand.location, stand.rotation_euler = (0, -10, 0), (math.pi / 2, 0, 0)
    bpy.context.scene.camera = stand
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def twin(thing):
    copy = thing.copy()
    copy.data = thing.data.copy()
    bpy.context.collection.objects.link(copy)
    return copy


def suzanne(path, draft):
    """Her forehead, dented."""
    scene(draft)
    thing, after = faired(*selections.forehead())
    shoot(thing, after, *VIEWS["forehead"][:2], 2.95, path)


def spot(path, draft):
    """Without a horn, in one step."""
    scene(draft)
    thing, after = faired(*selections.horn())
    shoot(thing, after, *VIEWS["horn"][:2], 2.05, path, (0, 0.19, 0.12))


def blend(path, draft):
    """Between pipes, their rims and the tangent planes there held."""
    scene(draft)
    thing, after = faired(*selections.blend(), boundary='TANGENT')
    places = selections.places_of(thing)
    shoot(thing, after, *VIEWS["blend"][:2], 1.15 * np.ptp(places, axis=0).max(), path, (places.max(axis=0) + places.min(axis=0)) / 2)


def faired(thing, mask, **options):
    """It, and a copy in which the mask is fair."""
    after = twin(thing)
    bench.edit(after, selected=[mask])
    bpy.ops.mesh.vspring_fair(**options)
    bpy.ops.object.mode_set(mode='OBJECT')
    return thing, after


def beside(path, draft):
    """What `run beside` left: a row for each selection, a column for each operator."""
    scene(draft)
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 1000, 800
    for row, (title, (towards, up, reach)) in enumerate(VIEWS.items()):
        results = json.loads((selections.ROOT / f"out/blender/{title}.json").read_text())
        thing, mask = getattr(selections, title)()
        first = selections.places_of(thing)
        middle = first[mask].mean(axis=0)
        for column, name in enumerate(COLUMNS):
            one = twin(thing)
            selections.put(one, np.array(results[name]))
            only_near(one, first, middle, reach)
            one.matrix_world = (mathutils.Matrix.Translation((column - 2, 0, 1.5 - row)) @ mathutils.Matrix.Scale(0.48 / reach, 4)
                                @ turn_of(towards, up) @ mathutils.Matrix.Translation(-mathutils.Vector(middle)))
            dressed(one)
        bpy.data.objects.remove(thing)
    render(5, path)


def only_near(thing, places, middle, reach):
    """Cuts off what is further away than that."""
    made = bmesh.new()
    made.from_mesh(thing.data)
    made.verts.ensure_lookup_table()
    bmesh.ops.delete(made, geom=[made.verts[k] for k in np.flatnonzero(np.linalg.norm(places - middle, axis=1) > reach)], context='VERTS')
    made.to_mesh(thing.data)


bench = support.Case()
support.install()
words = sys.argv[sys.argv.index("--") + 1:]
for draw in (suzanne, spot, blend, beside):
    if draw.__name__ in words or not set(words) - {"--draft"}:
        draw(selections.ROOT / f"docs/pictures/blender-{draw.__name__}.png", "--draft" in words)

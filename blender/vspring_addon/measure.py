"""Measure Curvature: as numbers and colours on the mesh."""
import bmesh
import bpy
import numpy as np

from .edited import EditedMesh
from .modules import vspring
from .running import EditModeOperator, edited_objects, warn_of_scale

NUMBERS, COLOURS = "curvature", "Curvature"


class VSPRING_OT_measure(EditModeOperator, bpy.types.Operator):
    """Write the curvature at every vertex into the attribute “curvature”, and colours for it into the colour attribute “Curvature”. Colours are spread over what is selected"""

    bl_idname = "mesh.vspring_measure"
    bl_label = "Measure Curvature"

    kind: bpy.props.EnumProperty(name="Curvature", description="Which one", items=[
        ('mean', "Mean", "(k1 + k2) / 2, per unit of length"),
        ('gaussian', "Gaussian", "k1 × k2, per unit of length squared"),
        ('k1', "Greatest", "The greater principal curvature"),
        ('k2', "Least", "The lesser principal curvature")])
    shown: bpy.props.BoolProperty(name="Show Colours", description="Have Solid shading of this viewport show the active colour attribute", default=True)

    def execute(self, context):
        meshes = [EditedMesh(thing) for thing in edited_objects(context)]
        try:
            found = [getattr(vspring.curvatures(edited.vertices, edited.faces), self.kind) for edited in meshes]
        except vspring.Error as failure:
            self.report({'ERROR'}, str(failure))
            return {'CANCELLED'}
        chosen = np.concatenate([values[edited.selected] for edited, values in zip(meshes, found)])
        if not len(chosen):
            chosen = np.concatenate(found)
        for edited, values in zip(meshes, found):
            colours, (low, high) = vspring.colours(values, about=None if self.kind == 'mean' else 0, over=chosen)
            put(edited.mesh, values, linear(colours))
        space = context.space_data
        if self.shown and space is not None and space.type == 'VIEW_3D':
            space.shading.color_type = 'VERTEX'
        warn_of_scale(self, [edited.object for edited in meshes])
        self.report({'INFO'}, f"Colours go from {low:.4g} to {high:.4g}; curvature is positive where the surface bends away from its normal")
        return {'FINISHED'}


def put(mesh, values, colours):
    made = bmesh.from_edit_mesh(mesh)
    layers = made.verts.layers
    # A new layer moves the others, so that they are made before they are looked up.
    for layer, name in ((layers.float, NUMBERS), (layers.float_color, COLOURS)):
        if name not in layer:
            layer.new(name)
    numbers, shades = layers.float[NUMBERS], layers.float_color[COLOURS]
    for vertex, value, colour in zip(made.verts, values.tolist(), colours.tolist()):
        vertex[numbers] = value
        vertex[shades] = (*colour, 1)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    mesh.attributes.active_color = mesh.attributes[COLOURS]


def linear(colours):
    """From sRGB, as Blender has colours of attributes."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)

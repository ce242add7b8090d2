"""Fit to Object: the selection drawn to the vertices of another object."""
import bpy
import numpy as np

from .edited import EditedMesh, Refused, as_typed, points_of, turned
from .fair import BOUNDARIES, holding, other_object
from .modules import vspring
from .running import Job, Running


class VSPRING_OT_fit(Running, bpy.types.Operator):
    """Draw the selected vertices to another object, such as a scan, and keep them fair. The vertices of that object, with its modifiers, are the points"""

    bl_idname = "mesh.vspring_fit"
    bl_label = "Fit to Object"

    other: bpy.props.StringProperty(name="Object", options={'SKIP_SAVE'}, description="What to fit to; without one, the other selected object")
    by: bpy.props.EnumProperty(name="By", description="How closely points are followed", items=[
        ('LENGTH', "Smoothing Length", "What is shorter than about six times a length is smoothed"),
        ('WITHIN', "Distance", "The fairest surface from which no point is further away than a distance")])
    length: bpy.props.FloatProperty(name="Length", options={'SKIP_SAVE'}, description="0: the median of the selected edges", default=0, min=0, subtype='DISTANCE', unit='LENGTH')
    within: bpy.props.FloatProperty(name="Within", description="Distance of the furthest point", default=0.01, min=0, subtype='DISTANCE', unit='LENGTH')
    outliers: bpy.props.FloatProperty(name="Outliers", description="The share of the points that is left out, those furthest away", default=0, min=0,
                                      max=0.5, subtype='FACTOR')
    boundary: bpy.props.EnumProperty(name="Open Edges", description="What selected vertices at open edges of the mesh do",
                                   items=BOUNDARIES[:2])
    pins: bpy.props.StringProperty(name="Pins", options={'SKIP_SAVE'}, description="Vertex group: selected vertices in it stay where they are")

    def job_of(self, thing, context):
        other = other_object(context, self.other)
        if other is None or other == thing or other.type not in {'MESH', 'CURVE', 'SURFACE', 'META', 'FONT'}:
            raise Refused("Name the object to fit to, or select it besides the one that is edited")
        self.other = other.name
        edited = EditedMesh(thing)
        mirrors = edited.mirrors()
        moving, options = holding(edited, mirrors, self.pins, self.boundary)
        to_own = np.linalg.inv(np.array(thing.matrix_world))
        points, normals = points_of(other, context)
        if not len(points):
            raise Refused(f"{other.name} has no vertices")
        points = points @ to_own[:3, :3].T + to_own[:3, 3]
        if self.by == 'WITHIN':
            options["within"] = as_typed(self.within)
        else:
            if not self.length:
                self.length = median_edge(edited)
            options["smoothing_length"] = as_typed(self.length)
        return Job(edited, mirrors, moving, vspring.fit, edited.vertices, edited.faces, points,
                   normals=None if normals is None else turned(normals, to_own), outliers=as_typed(self.outliers), **options)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "strength")
        layout.prop_search(self, "other", context.scene, "objects")
        layout.prop(self, "by")
        layout.prop(self, "within" if self.by == 'WITHIN' else "length")
        layout.prop(self, "outliers")
        layout.prop(self, "boundary")
        layout.prop_search(self, "pins", context.edit_object, "vertex_groups")


def median_edge(edited):
    """Of the edges with both ends selected or, where there are none, of all."""
    edges = edited.edges[edited.selected[edited.edges].all(axis=1)]
    ends = edited.vertices[edges if len(edges) else edited.edges].astype(float)
    return float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))) if len(ends) else 0.0

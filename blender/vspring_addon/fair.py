"""Fair: the selected part of a surface."""
import bpy
import numpy as np

from .edited import EditedMesh, Refused, as_typed, normals_from, on_both_sides
from .modules import vspring
from .running import Job, Running

JOINS = [
    ('TANGENT', "Tangent", "The selection meets what is around it smoothly"),
    ('POSITION', "Position", "The selection meets what is around it at its edge alone, and may turn there"),
]
BOUNDARIES = [
    ('HELD', "Held", "Vertices at open edges stay where they are"),
    ('TANGENT', "Held with Normals", "They stay, and the surface keeps its tangent planes there"),
    ('FAIR', "Fair", "Selected open edges are made fair first, as curves"),
]
NORMALS = [
    ('CURRENT', "Current", "As the mesh has them now"),
    ('OBJECT', "Other Object", "Those of another object where it is nearest"),
]
SPACINGS = [
    ('smooth', "As Before", "Vertices keep the spacing they have, without its noise"),
    ('even', "Even", "Vertices go to the middle of their neighbours"),
    ('keep', "In Proportion", "Vertices keep their share between their neighbours"),
]


def other_object(context, name):
    """The one that is named, else one that is selected besides what is edited; None where there is none."""
    if name:
        return context.scene.objects.get(name)
    return next((thing for thing in context.selected_objects if thing.mode != 'EDIT'), None)


def holding(edited, mirrors, pins, boundary):
    """What the selection of a mesh means for the library: the mask of what may move, and options."""
    moving = on_both_sides(edited.selected, mirrors)
    pinned = on_both_sides(edited.group(pins), mirrors)
    options = {} if moving.all() else {"region": moving}
    options["constraints"] = [{"nodes": np.flatnonzero(pinned), "position": "fixed"}]
    if boundary == 'TANGENT':
        options["fix_normals"] = "boundary"
    if boundary == 'FAIR':
        options["fair_boundary"] = True
    return moving & ~pinned, options


class VSPRING_OT_fair(Running, bpy.types.Operator):
    """Make the selected vertices fair: curvature changes as gently as what is around them allows"""

    bl_idname = "mesh.vspring_fair"
    bl_label = "Fair"

    join: bpy.props.EnumProperty(name="Join", description="How the selection meets what is around it", items=JOINS)
    boundary: bpy.props.EnumProperty(name="Open Edges", description="What selected vertices at open edges of the mesh do", items=BOUNDARIES)
    pins: bpy.props.StringProperty(name="Pins", options={'SKIP_SAVE'}, description="Vertex group: selected vertices in it stay where they are")
    normals: bpy.props.StringProperty(name="Normals", options={'SKIP_SAVE'}, description="Vertex group: its vertices have normals that are given; without one, where "
                                      "another object gives them, the edge of the selection")
    normals_from: bpy.props.EnumProperty(name="From", description="Which normals these are", items=NORMALS)
    other: bpy.props.StringProperty(name="Object", options={'SKIP_SAVE'}, description="The object that gives normals; without one, the other selected object")
    least: bpy.props.EnumProperty(name="Even", description="What is made even or small", items=[
        ('curvature', "Curvature", "Mean curvature changes as evenly as it can"),
        ('bending', "Least Bending", "The surface bends as little as it can")])
    spacing: bpy.props.EnumProperty(name="Spacing", description="Where vertices go along the surface", items=SPACINGS)
    tolerance: bpy.props.FloatProperty(name="Tolerance", description="How far a vertex may be from its final place, as a share of the size of "
                                       "what moves", default=1e-5, min=1e-10, max=0.01, precision=7, step=0.001)

    def job_of(self, thing, context):
        edited = EditedMesh(thing)
        mirrors = edited.mirrors()
        moving, options = holding(edited, mirrors, self.pins, self.boundary)
        faces = edited.faces if self.join == 'TANGENT' else edited.faces_at(moving)
        if not len(faces[0]):
            raise Refused(f"{thing.name}: no face has a vertex of the selection; for edges alone there is Fair Edge Loop")
        self.add_normals(edited, mirrors, moving, options["constraints"], context)
        return Job(edited, mirrors, moving, vspring.fair, edited.vertices, faces, fair_by=self.least, distribution=self.spacing,
                   tolerance=as_typed(self.tolerance), **options)

    def add_normals(self, edited, mirrors, moving, rules, context):
        if not self.normals and self.normals_from == 'CURRENT':
            return
        given = np.flatnonzero(on_both_sides(edited.group(self.normals), mirrors) if self.normals else edited.rim(moving))
        if self.normals_from == 'CURRENT':
            rules.append({"nodes": given, "normal": "fixed"})
            return
        other = other_object(context, self.other)
        if other is None or other.type != 'MESH':
            raise Refused("Name the mesh object that normals come from, or select it besides the one that is edited")
        rules.append({"nodes": given, "normal": normals_from(other, edited, given, context)})

    def advice(self, failure):
        if failure.code != "unusable-constraint":
            return ""
        return ". Leave vertices around the selection unselected, or put some in a vertex group and choose it for Pins"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        groups = context.edit_object
        layout.prop(self, "strength")
        layout.prop(self, "join")
        layout.prop(self, "boundary")
        layout.prop_search(self, "pins", groups, "vertex_groups")
        layout.prop_search(self, "normals", groups, "vertex_groups")
        layout.prop(self, "normals_from")
        if self.normals_from == 'OBJECT':
            layout.prop_search(self, "other", context.scene, "objects")
        layout.prop(self, "least")
        layout.prop(self, "spacing")
        layout.prop(self, "tolerance")

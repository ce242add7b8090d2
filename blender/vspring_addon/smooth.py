"""Smooth within Distance: noise of a scan."""
import bpy

from .edited import EditedMesh, as_typed
from .fair import BOUNDARIES, holding
from .modules import vspring
from .running import Job, Running


class VSPRING_OT_smooth(Running, bpy.types.Operator):
    """Take noise off the selected vertices, as of a scan. Details that rise out of the noise stay"""

    bl_idname = "mesh.vspring_smooth"
    bl_label = "Smooth within Distance"

    by: bpy.props.EnumProperty(name="By", description="How far vertices may go", items=[
        ('AUTO', "Estimated Noise", "As far as the noise reaches that there seems to be"),
        ('DISTANCE', "Distance", "The surface stays within a distance of every vertex")])
    within: bpy.props.FloatProperty(name="Within", description="How far the surface may be from where a vertex was", default=0.01, min=0, subtype='DISTANCE', unit='LENGTH')
    boundary: bpy.props.EnumProperty(name="Open Edges", description="What selected vertices at open edges of the mesh do", items=BOUNDARIES)
    pins: bpy.props.StringProperty(name="Pins", options={'SKIP_SAVE'}, description="Vertex group: selected vertices in it stay where they are")

    def job_of(self, thing, context):
        edited = EditedMesh(thing)
        mirrors = edited.mirrors()
        moving, options = holding(edited, mirrors, self.pins, self.boundary)
        options.update({"noise": "auto"} if self.by == 'AUTO' else {"within": as_typed(self.within)})
        return Job(edited, mirrors, moving, vspring.fair, edited.vertices, edited.faces, **options)

    def advice(self, failure):
        return ". Choose Distance, and say how far vertices may go" if self.by == 'AUTO' and failure.code == "unusable-shape" else ""

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "strength")
        layout.prop(self, "by")
        if self.by == 'DISTANCE':
            layout.prop(self, "within")
        layout.prop(self, "boundary")
        layout.prop_search(self, "pins", context.edit_object, "vertex_groups")

"""Fair Edge Loop: selected edges as curves."""
import bpy
import numpy as np

from .edited import EditedMesh, Refused, as_typed, on_both_sides
from .modules import vspring
from .running import Job, Running

ENDS = [
    ('TANGENT', "Tangent", "Curves keep their directions at their ends"),
    ('POSITION', "Position", "Curves may turn at their ends, and are straight there"),
]


class VSPRING_OT_fair_edges(Running, bpy.types.Operator):
    """Make chains of selected edges fair curves: curvature changes evenly along them. Ends stay, and so do vertices where chains meet"""

    bl_idname = "mesh.vspring_fair_edges"
    bl_label = "Fair Edge Loop"

    join: bpy.props.EnumProperty(name="Ends", description="How chains leave their ends", items=ENDS)
    pins: bpy.props.StringProperty(name="Pins", options={'SKIP_SAVE'}, description="Vertex group: selected vertices in it stay where they are")
    within: bpy.props.FloatProperty(name="Within", description="The fairest curve that is nowhere further than this from where it was; 0: as fair as "
                                    "its ends and pins allow", default=0, min=0, subtype='DISTANCE', unit='LENGTH')

    def job_of(self, thing, context):
        edited = EditedMesh(thing)
        mirrors = edited.mirrors()
        selected = on_both_sides(edited.selected, mirrors)
        edges = edited.edges[edited.selected_edges] if not mirrors else edited.edges[selected[edited.edges].all(axis=1)]
        if not len(edges):
            raise Refused(f"{thing.name}: select edges, or vertices that edges join")
        chains, closed = vspring.chains_of(edges)
        pinned = np.flatnonzero(on_both_sides(edited.group(self.pins), mirrors))
        free = [chain for chain, is_closed in zip(chains, closed) if is_closed and len(np.intersect1d(chain, pinned)) < 2]
        if free and not self.within:
            raise Refused(f"{thing.name}: a closed loop, as through vertex {free[0][0]}, needs something that holds it: put some of its vertices in "
                          "a vertex group and choose it for Pins, or say within which distance it stays")
        options = {"within": as_typed(self.within)} if self.within else {}
        moving = np.zeros(len(edited.vertices), bool)
        moving[np.concatenate(chains)] = True
        moving[pinned] = False
        return Job(edited, mirrors, moving, vspring.fair_curve, edited.vertices, chains=chains, closed=closed,
                   fix_normals="boundary" if self.join == 'TANGENT' else "none",
                   constraints=[{"nodes": pinned, "position": "fixed"}], **options)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "strength")
        layout.prop(self, "join")
        layout.prop_search(self, "pins", context.edit_object, "vertex_groups")
        layout.prop(self, "within")

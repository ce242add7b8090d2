"""Where operators are found: the Vertex menu, and the sidebar."""
import bpy

from .fair import VSPRING_OT_fair
from .fair_edges import VSPRING_OT_fair_edges
from .fit import VSPRING_OT_fit
from .measure import VSPRING_OT_measure
from .smooth import VSPRING_OT_smooth

OPERATORS = (VSPRING_OT_fair, VSPRING_OT_fair_edges, VSPRING_OT_fit, VSPRING_OT_smooth, VSPRING_OT_measure)


def add_operators(layout):
    # What takes long shows progress, and Esc stops it.
    layout.operator_context = 'INVOKE_DEFAULT'
    for operator in OPERATORS:
        layout.operator(operator.bl_idname)


class VSPRING_MT_fair(bpy.types.Menu):
    bl_idname = "VSPRING_MT_fair"
    bl_label = "Fair (vspring)"

    def draw(self, context):
        add_operators(self.layout)


class VSPRING_PT_fair(bpy.types.Panel):
    bl_idname = "VSPRING_PT_fair"
    bl_label = "Fair"
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = "vspring"
    bl_context = "mesh_edit"

    def draw(self, context):
        add_operators(self.layout.column(align=True))


def in_vertex_menu(self, context):
    self.layout.separator()
    self.layout.menu(VSPRING_MT_fair.bl_idname)


CLASSES = (*OPERATORS, VSPRING_MT_fair, VSPRING_PT_fair)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_edit_mesh_vertices.append(in_vertex_menu)


def unregister():
    bpy.types.VIEW3D_MT_edit_mesh_vertices.remove(in_vertex_menu)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)

"""Fair curves and surfaces in Edit Mode. Thin: what is computed, the module vspring computes."""

bl_info = {
    "name": "vspring: fair curves and surfaces",
    "author": "the makers of vspring",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Edit Mode: Vertex > Fair (vspring); Sidebar > vspring",
    "description": "Moves vertices until curvature changes as gently as what is around them allows",
    "category": "Mesh",
}


def register():
    from . import menus
    menus.register()


def unregister():
    from . import menus
    menus.unregister()

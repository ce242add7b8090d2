"""The module vspring: the one in the add-on's folder or, where there is none, the one that Blender's Python has."""
import pathlib
import sys

HERE = pathlib.Path(__file__).parent / "vspring"

if HERE.exists():
    try:
        from . import vspring
    except ImportError as failure:
        raise ImportError(f"{failure}. The add-on has {', '.join(path.name for path in HERE.glob('_vspring.*'))}, and this Blender "
                          f"has Python {sys.version_info.major}.{sys.version_info.minor} on {sys.platform}: build the add-on for that") from failure
else:
    import vspring

__all__ = ["vspring"]

"""Runs the cases in Blender, through the operators of the add-on: FOLDER has shapes, and gets a result for each case."""
import pathlib
import sys

import bpy

HERE = pathlib.Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "blender")]
import cases  # noqa: E402
import support  # noqa: E402

BOUNDARY = {"boundary": 'TANGENT'}


def run(one, folder):
    bench = support.Case()
    bench.setUp()
    vertices, rows = cases.read_obj(folder / f"{one['shape']}.obj")
    is_curve = one["call"] == "fair_curve"
    thing = bench.add(vertices, () if is_curve else rows, list(zip(rows[0], rows[0][1:])) if is_curve else ())
    options = one["options"]
    for name, group in (("pins", "Pins"), ("normals", "Normals")):
        if name in options:
            bench.group(thing, group, options[name])
    bench.edit(thing, selected=[cases.region_of(one, folder) if "region" in options else slice(None)])
    given = {name: group for name, group in (("pins", "Pins"), ("normals", "Normals")) if name in options}
    if is_curve:
        given["join"] = 'TANGENT' if "fix_normals" in options else 'POSITION'
        bpy.ops.mesh.vspring_fair_edges(**given, **({"within": options["within"]} if "within" in options else {}))
        return bench.places(thing)
    given["boundary"] = 'FAIR' if options.get("fair_boundary") else BOUNDARY.get(options.get("fix_normals"), 'HELD')
    if one["call"] == "fit":
        points = bench.add(cases.read_points(folder / "points.xyz"), name="Points")
        bpy.ops.mesh.vspring_fit(other=points.name, length=options["smoothing_length"], **given)
    elif "noise" in options:
        bpy.ops.mesh.vspring_smooth(by='AUTO', **given)
    elif "within" in options:
        bpy.ops.mesh.vspring_smooth(by='DISTANCE', within=options["within"], **given)
    else:
        names = {"fair_by": "least", "distribution": "spacing", "tolerance": "tolerance"}
        bpy.ops.mesh.vspring_fair(**given, **{names[name]: value for name, value in options.items() if name in names})
    return bench.places(thing)


def main():
    folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
    support.install()
    for number, one in enumerate(cases.CASES):
        cases.write_result(folder / f"{number}.blender.json", run(one, folder).tolist())


main()

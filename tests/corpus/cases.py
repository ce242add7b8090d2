"""Cases that come to the same bits by every way into the library, and their shapes. Standard library alone: Blender runs this too.

A case has the names of Python's arguments. Coordinates are what single precision can hold, as Blender keeps them so."""
import json
import pathlib
import struct
import subprocess

# Made by the program; name: how.
SHAPES = {
    "annulus": "annulus --nodes 553 --boundary-nodes 121 --noise 0.01 --seed 1",
    "cap": "cap --nodes 600 --noise 0.02 --seed 1",
    "torus": "torus --noise 0.02 --seed 1",
    "pipes": "pipe-blend",
    "polygons": "polygon-patch",
}
HALF = {"torus": lambda x, y, z: x > 0, "cap": lambda x, y, z: x * x + y * y < 0.2, "spot": lambda x, y, z: z < -0.55}


def case(name, shape, call="fair", **options):
    return {"name": name, "shape": shape, "call": call, "options": options}


CASES = [
    case("boundary", "annulus"),
    case("boundary with normals", "annulus", fix_normals="boundary"),
    case("least bending", "annulus", fair_by="bending"),
    case("even spacing", "annulus", distribution="even"),
    case("kept spacing", "cap", distribution="keep"),
    case("finer", "cap", tolerance=1e-8),
    case("n-gons", "polygons"),
    case("quads and triangles", "pipes", fix_normals="boundary"),
    case("region", "cap", region="half"),
    case("region of a closed surface", "torus", region="half"),
    case("region of an animal", "spot", region="half"),
    case("pins", "cap", region="half", pins=[3, 40, 77, 131]),
    case("normals", "cap", region="half", normals=[3, 40, 77]),
    case("boundary made fair", "annulus", fair_boundary=True, pins=list(range(0, 553, 5))),
    case("noise", "torus", noise="auto"),
    case("noise of a region", "spot", noise="auto", region="half"),
    case("within a distance", "cap", within=0.03),
    case("drawn to points", "cap", call="fit", points="points", smoothing_length=0.1),
    case("curve", "wave", call="fair_curve"),
    case("curve with tangents", "wave", call="fair_curve", fix_normals="boundary"),
    case("curve with pins", "wave", call="fair_curve", fix_normals="boundary", pins=[10, 25]),
    case("curve within a distance", "wave", call="fair_curve", within=0.05),
]


def single(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def make_shapes(program, root, folder):
    """OBJ files of all shapes, and those points are drawn to."""
    for name, how in SHAPES.items():
        subprocess.run([program, "generate", *how.split(), "-o", folder / f"{name}.obj"], check=True, capture_output=True)
    (folder / "spot.obj").write_text((root / "examples/spot.obj").read_text())
    for path in folder.glob("*.obj"):
        rows = (line.split() for line in path.read_text().splitlines())
        kept = []
        for row in rows:
            if row[:1] == ["v"]:
                kept.append(["v", *(repr(single(float(part))) for part in row[1:4])])
            elif row[:1] == ["f"]:
                kept.append(["f", *(corner.split("/")[0] for corner in row[1:])])
        path.write_text("\n".join(map(" ".join, kept)) + "\n")
    table = (root / "examples/wave.csv").read_text().splitlines()
    places = [[single(float(part)) for part in line.split(",")] for line in table if line[:1] in "-0123456789."]
    rows = [" ".join(["v", *map(repr, place + [0.0] * (3 - len(place)))]) for place in places]
    (folder / "wave.obj").write_text("\n".join([*rows, "l " + " ".join(str(k + 1) for k in range(len(rows)))]) + "\n")
    (folder / "points.xyz").write_text("".join(f"{single(0.1 * k - 0.5)!r} {single(0.07 * (k % 7) - 0.2)!r} {single(0.9 - 0.01 * k)!r}\n" for k in range(11)))


def read_obj(path):
    """Vertices, and the rows of faces or lines from 0."""
    vertices, rows = [], []
    for row in map(str.split, pathlib.Path(path).read_text().splitlines()):
        if row[0] == "v":
            vertices.append(tuple(map(float, row[1:4])))
        elif row[0] in "fl":
            rows.append([int(corner) - 1 for corner in row[1:]])
    return vertices, rows


def read_points(path):
    return [tuple(map(float, line.split())) for line in pathlib.Path(path).read_text().splitlines()]


def region_of(one, folder):
    """The numbers of the vertices of a case's region."""
    vertices, _ = read_obj(folder / f"{one['shape']}.obj")
    return [k for k, place in enumerate(vertices) if HALF[one["shape"]](*place)]


def rules_of(options):
    rules = [{"nodes": options[name], key: "fixed"} for name, key in (("pins", "position"), ("normals", "normal")) if name in options]
    return {"rules": rules} if rules else None


def plain_options(one, folder):
    """Options with the region as numbers, and pins and normals as rules."""
    options = {name: value for name, value in one["options"].items() if name not in ("pins", "normals", "points")}
    if "region" in options:
        options["region"] = region_of(one, folder)
    if (rules := rules_of(one["options"])) is not None:
        options["constraints"] = rules
    return options


def write_result(path, places):
    path.write_text(json.dumps(places))

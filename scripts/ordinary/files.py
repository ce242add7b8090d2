"""Texts of files, and what is in them."""
import itertools
import re


def csv_text(nodes, planar):
    lines = ["x,y" if planar else "x,y,z"]
    lines += [",".join(map(repr, node[:2] if planar else node)) for node in nodes]
    return "\n".join(lines) + "\n"


def text_of(shape, nodes, name):
    if name.endswith(".csv"):
        return csv_text(nodes, shape.planar)
    lines = ["v " + " ".join(map(repr, node)) for node in nodes]
    if shape.faces is None:
        lines.append("l " + " ".join(str(k + 1) for k in range(len(nodes))) + (" 1" if shape.closed else ""))
    else:
        lines += ["f " + " ".join(str(k + 1) for k in face) for face in shape.faces]
    return "\n".join(lines) + "\n"


def parse_obj(text):
    """Nodes, and faces or, for a curve, edges."""
    nodes, faces = [], []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            nodes.append(tuple(map(float, words[1:4])))
        elif words[:1] in (["f"], ["l"]):
            numbers = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [numbers] if words[0] == "f" else itertools.pairwise(numbers)
    return nodes, faces


def parse_ply(text):
    """Reads a PLY file of positions and faces only, as text."""
    header, _, body = text.partition("end_header\n")
    rows = body.splitlines()
    nodes = int(re.search(r"element vertex (\d+)", header)[1])
    return [tuple(map(float, row.split())) for row in rows[:nodes]], [list(map(int, row.split()[1:])) for row in rows[nodes:]]


def parse_csv(text):
    rows = [tuple(map(float, line.split(","))) for line in text.splitlines()[1:]]
    return [(*row, 0.0) if len(row) == 2 else row[:3] for row in rows]

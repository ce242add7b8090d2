"""Five shapes before and after, by vspring and matplotlib: curvature combs and curvature colours.

    PYTHONPATH=build/release/python /usr/bin/python3 examples/gallery.py FOLDER    # draws FOLDER/python-*.png

docs/python-tasks.md explains them one by one."""
import pathlib
import sys

import matplotlib
import numpy as np
import vspring

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

EXAMPLES = pathlib.Path(__file__).resolve().parent


def draw_surface(axes, vertices, faces, colours, title, view=(20, -60), at=None, reach=None):
    """Faces in the colours of their nodes, lit from the left. view: elevation and azimuth. at, reach: what is seen."""
    corners = [vertices[list(face)] for face in faces]
    normals = np.array([np.cross(face[2] - face[0], face[-1] - face[1]) for face in corners])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    elevation, azimuth = np.radians([view[0] + 15, view[1] - 35])
    light = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    shade = 0.45 + 0.55 * np.maximum(normals @ light, 0)
    own = np.array([colours[list(face)].mean(axis=0) for face in faces])
    axes.add_collection3d(Poly3DCollection(corners, facecolors=own * shade[:, None], edgecolors="none", antialiased=False))
    middle = (vertices.max(axis=0) + vertices.min(axis=0)) / 2 if at is None else np.asarray(at)
    size = np.ptp(vertices, axis=0).max() / 2 if reach is None else reach
    axes.set(xlim=middle[0] + [-size, size], ylim=middle[1] + [-size, size], zlim=middle[2] + [-size, size], title=title)
    axes.set_box_aspect((1, 1, 1), zoom=1.5)
    axes.view_init(*view)
    axes.set_axis_off()


def surfaces(path, before, after, faces, **seen):
    """Both beside each other, coloured by mean curvature in the same range."""
    bends = [vspring.curvatures(one, faces).mean for one in (before, after)]
    figure = pyplot.figure(figsize=(9, 4.5), dpi=100, layout="constrained")
    for place, (vertices, bend, title) in enumerate(zip((before, after), bends, ("before", "after"))):
        shades, _ = vspring.colours(bend, over=bends[1])
        draw_surface(figure.add_subplot(1, 2, place + 1, projection="3d"), vertices, faces, shades, title, **seen)
    figure.savefig(path)
    pyplot.close(figure)


def curvature_vectors(curve):
    """Of the circle through each node and its neighbours, pointing to its middle; zero at the ends."""
    back, on = curve[1:-1] - curve[:-2], curve[2:] - curve[1:-1]
    before, after = (np.linalg.norm(one, axis=1, keepdims=True) for one in (back, on))
    vectors = np.zeros_like(curve)
    vectors[1:-1] = 2 * (on / after - back / before) / (before + after)
    return vectors


def comb(axes, curve, title, scale):
    """The curve, and a tooth for each node, as long as it is bent there."""
    tips = curve - scale * curvature_vectors(curve)
    axes.plot(*np.stack([curve, tips, np.full_like(curve, np.nan)], axis=1).reshape(-1, 2).T, color="tab:orange", linewidth=0.6)
    axes.plot(*tips.T, color="tab:orange", linewidth=1)
    axes.plot(*curve.T, color="tab:blue", linewidth=1.5)
    axes.set(aspect="equal", title=title)
    axes.set_axis_off()


def bent(vertices, faces, **held):
    return vspring.measure(vertices, faces, **held).bending_energy


def region(folder):
    spot = vspring.read(EXAMPLES / "spot.obj")
    horn = np.linalg.norm(spot.vertices - [0.18, -0.27, 0.87], axis=1) < 0.16
    after, _ = vspring.fair(spot, region=horn)
    surfaces(folder / "python-region.png", spot.vertices, after, spot.faces, view=(15, -65), at=(0, -0.3, 0.7), reach=0.4)
    return bent(spot, None, fix=~horn), bent(after, spot.faces, fix=~horn)


def blend(folder):
    pipes = vspring.read(EXAMPLES / "pipe-blend.obj")
    after, _ = vspring.fair(pipes, fix_normals="boundary")
    surfaces(folder / "python-blend.png", pipes.vertices, after, pipes.faces)
    return bent(pipes, None), bent(after, pipes.faces)


def aerofoil(folder):
    profile = vspring.read(EXAMPLES / "naca-2412.dat")
    table = np.round(profile.vertices, 3)  # as old tables have them
    after, _ = vspring.fit(table, within=0.0005)
    figure, rows = pyplot.subplots(2, 1, figsize=(9, 5), dpi=100, layout="constrained")
    for axes, curve, title in zip(rows, (table, after), ("before", "after")):
        comb(axes, curve, title, 0.01)
        axes.set(xlim=(-0.15, 1.02), ylim=(-0.2, 0.2))
    figure.savefig(folder / "python-aerofoil.png")
    pyplot.close(figure)
    return vspring.measure(table).curvature_variation, vspring.measure(after).curvature_variation


def scan(folder):
    spot = vspring.read(EXAMPLES / "spot.obj")
    noisy = spot.vertices + 0.006 * np.random.default_rng(1).standard_normal(spot.vertices.shape)
    after, _ = vspring.fair(noisy, spot.faces, noise="auto")
    surfaces(folder / "python-scan.png", noisy, after, spot.faces, view=(10, -60))
    normals = vspring.curvatures(spot).normals
    return tuple(np.sqrt(np.mean(((one - spot.vertices) * normals).sum(axis=1) ** 2)) for one in (noisy, after))


def drag(folder):
    line = np.linspace(-1, 1, 25)
    x, y = (one.ravel() for one in np.meshgrid(line, line, indexing="ij"))
    vertices = np.column_stack([x, y, np.zeros_like(x)])
    node = np.arange(625).reshape(25, 25)
    faces = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    session = vspring.Session(vertices, faces, fix_normals="boundary")
    for height in np.linspace(0, 0.6, 13):
        session.hold(node[12, 12], [0, 0, height])
        moved, _ = session.update()
    after, report = session.fair()
    surfaces(folder / "python-drag.png", vertices, after, faces, view=(25, -60))
    return np.abs(moved - after).max(), report.expected_error


GALLERY = (region, blend, aerofoil, scan, drag)


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for one in GALLERY:
        before, after = one(folder)
        print(f"{one.__name__}: {before:.3g} to {after:.3g}", flush=True)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))

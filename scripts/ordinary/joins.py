"""Regions of surfaces that are to meet the curvature around them."""
import json
import math

from ordinary.checks import CHECKS, QUALITY, check_fairness, check_truth
from ordinary.shapes import draw_grid_surface, log_uniform
from ordinary.tasks import Task, shaken
from ordinary.vectors import diagonal_of


def draw_join(draw):
    """A grid surface with a region whose nodes are off their places."""
    while True:
        shape = draw_grid_surface(draw)
        rim = set(shape.rim)
        inner = [k for k in range(len(shape.nodes)) if k not in rim]
        around = shape.nodes[draw.choice(inner)]
        radius = log_uniform(draw, 2 * shape.edge, 0.3 * shape.size)
        moving = [k for k in inner if math.dist(shape.nodes[k], around) < radius]
        if 3 <= len(moving) <= 0.6 * len(inner):
            break
    task = Task("", 0, shape)
    task.noise = draw.choice((0.0, draw.uniform(0, 0.005))) * shape.size
    task.exact = list(shape.nodes)
    task.fixed, task.held, task.how = set(range(len(shape.nodes))) - set(moving), True, "joins"
    shape.nodes = [node if k in task.fixed else shaken(draw, node, task.noise, False) for k, node in enumerate(shape.nodes)]
    task.files["region.json"] = json.dumps(moving)
    task.options = ["--region", "region.json", "--continuity", "curvature"]
    task.checks = [check for check in CHECKS if check not in (check_fairness, check_truth)]

    def check(result):
        report = result.report
        across = diagonal_of([result.nodes[k] for k in moving])
        far = max(shape.truth(result.nodes[k]) for k in moving)
        most = 0.03 * across + across ** 2 / (16 * shape.radius)
        result.figures["region"] = [far / across, most / across]
        result.figures["met"] = report.get("continuity") == "curvature"
        if far > most:
            result.blame(QUALITY, f"a region {across:.3g} wide is {far:.3g} from the true surface, {most:.3g} allowed")
        jump = report.get("curvature_jump")
        # Next to none may grow.
        if result.figures["met"] and jump and jump["after"] > jump["tangent"] and jump["after"] * across > 1e-3:
            result.blame(QUALITY, f"the jump of curvature grew from {jump['tangent']:.3g} to {jump['after']:.3g}")
        if not result.figures["met"] and "tangent-only" not in report.get("warning_codes", []):
            result.blame(QUALITY, "curvature is not met, and no warning says so")
    task.check = check
    return task

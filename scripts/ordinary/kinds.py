"""Kinds of tasks that are drawn in ways of their own."""
import functools
import random

from ordinary.cages import draw_cage
from ordinary.creases import draw_crease
from ordinary.files import text_of
from ordinary.halves import draw_half_task
from ordinary.holes import draw_hole_task
from ordinary.joins import draw_join
from ordinary.met import MET
from ordinary.networks import draw_network
from ordinary.pulls import draw_pull_task
from ordinary.slides import draw_slide


DRAWS_OF_THEIR_OWN = {"met": lambda draw: MET[draw.choice(list(MET))](draw), "creases": draw_crease, "cages": draw_cage, "slides": draw_slide, "networks": draw_network, "joins": draw_join}


def draw_own_task(kind, seed, number):
    """Files as users have them, or sharp edges: the kind decides the task."""
    draw = random.Random(f"{seed} {number} {kind}")
    task = DRAWS_OF_THEIR_OWN[kind](draw)
    task.seed, task.number = seed, number
    if task.input not in task.files:
        task.files[task.input] = text_of(task.shape, task.shape.nodes, task.input)
    task.arguments = [task.command, task.input, "-o", task.output, *task.options, "--report", "report.json", "--quiet", "--threads", "1"]
    return task


OF_THEIR_OWN = {**{kind: functools.partial(draw_own_task, kind) for kind in DRAWS_OF_THEIR_OWN}, "halves": draw_half_task, "holes": draw_hole_task, "pulls": draw_pull_task}

"""Distances of points from shapes."""
import itertools
import math

from ordinary.vectors import box_of, cross, dot, mean_of, scaled, sub


def from_segment(p, a, b):
    d, e = sub(b, a), sub(p, a)
    squared = dot(d, d)
    t = min(max(dot(d, e) / squared, 0.0), 1.0) if squared > 0 else 0.0
    return math.dist(e, scaled(d, t))


def from_triangle(p, a, b, c):
    """Ericson, Real-Time Collision Detection, 5.1.5."""
    ab, ac, ap = sub(b, a), sub(c, a), sub(p, a)
    n = cross(ab, ac)
    squared = dot(n, n)
    if squared > 0:
        v, w = dot(cross(ap, ac), n) / squared, dot(cross(ab, ap), n) / squared
        if v >= 0 and w >= 0 and v + w <= 1:
            return abs(dot(ap, n)) / math.sqrt(squared)
    return min(from_segment(p, a, b), from_segment(p, b, c), from_segment(p, c, a))


def pieces_of(nodes, faces, all_ways=False):
    """Triangles of a face. One of more nodes is cut by a fan around its mean; all_ways: also by fans from each of its
    nodes."""
    pieces = []
    for face in faces:
        corners = [nodes[k] for k in face]
        if len(corners) == 3:
            pieces.append(tuple(corners))
            continue
        middle = mean_of(corners)
        pieces += [(a, b, middle) for a, b in zip(corners, corners[1:] + corners[:1])]
        if all_ways:
            pieces += [(a, b, c) for k, a in enumerate(corners)
                       for b, c in itertools.pairwise(corners[k + 1:] + corners[:k])]
    return pieces


class Tree:
    """Segments or triangles in a tree of boxes."""

    def __init__(self, pieces):
        self.measure = from_segment if len(pieces[0]) == 2 else from_triangle
        self.top = self.build(pieces)

    def build(self, pieces):
        low, high = box_of([corner for piece in pieces for corner in piece])
        if len(pieces) <= 4:
            return low, high, pieces, None
        axis = max(range(3), key=lambda i: high[i] - low[i])
        pieces = sorted(pieces, key=lambda piece: sum(corner[axis] for corner in piece))
        half = len(pieces) // 2
        return low, high, None, (self.build(pieces[:half]), self.build(pieces[half:]))

    def distance(self, p, enough=0.0, least=math.inf):
        """least: a bound that is known; enough: what is less need not be known exactly."""
        def gap(low, high):
            return math.hypot(*(max(l - x, 0.0, x - h) for x, l, h in zip(p, low, high)))

        stack = [(0.0, self.top)]
        while stack:
            near, (_, _, pieces, halves) = stack.pop()
            if near >= least:
                continue
            if pieces is not None:
                least = min(least, min(self.measure(p, *piece) for piece in pieces))
                if least <= enough:
                    return least
            else:
                stack += sorted(((gap(half[0], half[1]), half) for half in halves), key=lambda entry: -entry[0])
        return least

"""Vectors as tuples of numbers."""
import math


TAU = 2 * math.pi


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1 / math.hypot(*a))


def mean_of(points):
    return tuple(math.fsum(p[i] for p in points) / len(points) for i in range(3))


def root_mean_square(values):
    values = list(values)
    return math.sqrt(math.fsum(v * v for v in values) / len(values)) if values else 0.0


def box_of(points):
    return tuple(map(min, zip(*points))), tuple(map(max, zip(*points)))


def diagonal_of(points):
    return math.dist(*box_of(points))

"""Polylines measured by arithmetic of the tests' own, in the plane and in space."""
import bisect
import itertools
import math


def along(nodes):
    """How far along the polyline each node is."""
    return list(itertools.accumulate(map(math.dist, nodes, nodes[1:]), initial=0))


def from_segment(place, a, b):
    along_it = squared = 0
    for p, x, y in zip(place, a, b):
        along_it += (p - x) * (y - x)
        squared += (y - x) ** 2
    share = min(max(along_it / squared, 0), 1) if squared > 0 else 0
    return math.dist(place, [x + share * (y - x) for x, y in zip(a, b)])


def distances(places, nodes):
    """Of places from the polyline."""
    ways = along(nodes)
    found, last = [], None
    for place in places:
        # From where the last one was nearest it is no further than that and the step between them.
        least, k = (found[-1] + math.dist(place, last)) * (1 + 1e-12) if found else math.inf, 0
        while k + 1 < len(nodes):
            least = min(least, from_segment(place, nodes[k], nodes[k + 1]))
            # Nothing is nearer before the way from here is as long as what is left over.
            k = max(k + 1, bisect.bisect_right(ways, ways[k] + math.dist(place, nodes[k]) - least) - 1)
        found.append(least)
        last = place
    return found


def places_on(nodes, parts=4):
    """The nodes, and places between them that part each edge so often."""
    return [[x + k / parts * (y - x) for x, y in zip(a, b)] for a, b in zip(nodes, nodes[1:]) for k in range(parts)] + [list(nodes[-1])]


def turns(nodes):
    """Angles between successive edges, with signs in the plane; nodes that repeat the one before are passed over."""
    nodes = [node for k, node in enumerate(nodes) if k == 0 or node != nodes[k - 1]]
    edges = [[y - x for x, y in zip(a, b)] for a, b in zip(nodes, nodes[1:])]
    found = []
    for a, b in zip(edges, edges[1:]):
        dot = math.fsum(x * y for x, y in zip(a, b))
        if len(a) == 2:
            found.append(math.atan2(a[0] * b[1] - a[1] * b[0], dot))
        else:
            found.append(math.atan2(math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]), dot))
    return found


def curvatures(nodes):
    """At the nodes inside, with signs in the plane."""
    nodes = [node for k, node in enumerate(nodes) if k == 0 or node != nodes[k - 1]]
    lengths = list(map(math.dist, nodes, nodes[1:]))
    return [2 * turn / (a + b) for turn, a, b in zip(turns(nodes), lengths, lengths[1:])]


def root_mean_square(values):
    return math.sqrt(math.fsum(x * x for x in values) / len(values))


def extremes(values):
    """How often values change from rising to falling and back, by more than a twentieth of their root mean square."""
    least = root_mean_square(values) / 20
    count, way, low, high = 0, 0, values[0], values[0]
    for value in values:
        low, high = min(low, value), max(high, value)
        if way >= 0 and value < high - least:
            count, way, low, high = count + (way > 0), -1, value, value
        elif way <= 0 and value > low + least:
            count, way, low, high = count + (way < 0), 1, value, value
    return count


def sign_changes(values):
    """How often values go from above a twentieth of their root mean square to below its negative, and back."""
    least = root_mean_square(values) / 20
    signs = [value > 0 for value in values if abs(value) > least]
    return sum(a != b for a, b in zip(signs, signs[1:]))

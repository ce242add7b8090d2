"""How to tell what a call did: progress, ending it before its time, whether its result is usable, and figures of fairness
before and after. From the project's folder: /usr/bin/python3 examples/python/08_report.py OUT"""
import sys

import vspring


class Enough(Exception):
    """Somebody does not want to wait any longer."""


def stop(now):
    raise Enough


def show(now):
    print(f"{now.stage} {100 * now.fraction:.0f} %")


def tell(report):
    off = "" if report.expected_error is None else f", off by some {report.expected_error:.0e} of the size"
    print(f"{'usable' if report.usable else 'not usable'} ({report.outcome}): {report.iterations} iterations on "
          f"{len(report.levels)} levels{off}")
    for warning in report.warnings:
        print(f"  {warning.code}: {warning}")


out = sys.argv[1] if len(sys.argv) > 1 else "."
pipes = vspring.read("examples/pipe-blend.obj")
try:
    vspring.fair(pipes, fix_normals="boundary", progress=stop)
except Enough as ended:  # what comes back is a shape on the way, and says so
    tell(ended.report)

positions, report = vspring.fair(pipes, fix_normals="boundary", progress=show)
tell(report)
if not report.usable:
    sys.exit(1)
before, after = vspring.measure(pipes), vspring.measure(positions, pipes.faces)
print(f"bending energy {after.bending_energy:.0f}, before {before.bending_energy:.0f}; "
      f"greatest turn {after.greatest_turn:.1f} degrees, before {before.greatest_turn:.1f}")
vspring.write(f"{out}/08_report.obj", positions, source=pipes)

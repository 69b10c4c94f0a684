"""The rational gauge: scalings by square roots that make the matrix of a scene integer.

Square-free integers t (one an axis) and s (one a direction of contact) with sqrt(t_axis) n_axis /
sqrt(s) rational; m clears the denominators of a direction. See `system` for what they scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from ..errors import SolveError
from ..numbers.exact import ZERO, Surd
from ..numbers.roots import root_product
from ..scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class Gauge:
    """The rational gauge of a scene.

    `axes` are the t, `classes` the s of the normals; `rows` has the integer row of each normal, and
    its m.
    """

    axes: list[int]
    classes: list[int]
    rows: list[tuple[list[int], int]]


def gauge_of(scene: Scene) -> Gauge:
    """The gauge of a scene; `SolveError` where it has none."""
    normals, _ = scene.normals
    axes, classes = rational_gauge(normals, scene.dimension, _loaded_axes(scene))
    return Gauge(axes, classes, _integer_rows(normals, axes))


def rational_gauge(
    normals: tuple[tuple[Surd, ...], ...], dimension: int, first_axes: list[int]
) -> tuple[list[int], list[int]]:
    """Square-free t (an axis) and s (a normal) with sqrt(t_axis) n_axis / sqrt(s) rational.

    Axes in `first_axes` are given t = 1 where they can be, which keeps loads on them rational.
    Raises `SolveError` where no such scaling exists.
    """
    axes: list[int | None] = [None] * dimension
    classes: list[int | None] = [None] * len(normals)
    for start in [*first_axes, *range(dimension)]:
        if axes[start] is not None:
            continue
        axes[start] = 1
        changed = True
        while changed:
            changed = False
            for k, normal in enumerate(normals):
                for axis, component in enumerate(normal):
                    if not component:
                        continue
                    if len(component.terms) > 1:
                        raise SolveError(_no_gauge(normal))
                    radicand = component.terms[0][0]
                    t, s = axes[axis], classes[k]
                    if t is not None and s is None:
                        classes[k] = root_product(radicand, t)[1]
                        changed = True
                    elif t is None and s is not None:
                        axes[axis] = root_product(radicand, s)[1]
                        changed = True
                    elif t is not None and root_product(radicand, t)[1] != s:
                        raise SolveError(_no_gauge(normal))
    return [t or 1 for t in axes], [s or 1 for s in classes]


def _no_gauge(normal: tuple[Surd, ...]) -> str:
    shown = ", ".join(map(str, normal))
    return (
        f"no scaling of the axes by square roots makes the contact along ({shown}) rational "
        "together with the others: exact solving needs a scene with such a scaling"
    )


def _loaded_axes(scene: Scene) -> list[int]:
    loaded = {a for disc in scene.discs for a, p in enumerate(disc.load) if p is not ZERO and p}
    return sorted(loaded, reverse=True)


def _integer_rows(
    normals: tuple[tuple[Surd, ...], ...], axes: list[int]
) -> list[tuple[list[int], int]]:
    """For each normal the integers m sqrt(t) n / sqrt(s), and m."""
    rows = []
    for normal in normals:
        # With n = c sqrt(r) this is c times the square in r t, whose root is that of s.
        scaled = [
            n.terms[0][1] * root_product(n.terms[0][0], t)[0] if n else Fraction(0)
            for n, t in zip(normal, axes, strict=True)
        ]
        m = lcm(*(x.denominator for x in scaled))
        rows.append(([int(x * m) for x in scaled], m))
    return rows

"""The corners of the set of admissible networks, and its volume, for tiny piles.

Forces that balance and keep to Coulomb's law form a polyhedron; the `dimension` of it
(`indeterminacy`) says in how many independent ways they can change. Here its corners are listed:
every admissible network is a mean of them, plus a sum of the changes that have no end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import SolveError, VerificationError
from ..numbers.exact import ONE, ZERO, Exact, Surd
from ..numbers.vectors import exact_vector
from ..programs.affine_hull import affine_hull
from ..programs.certificates import is_feasible
from ..programs.vertices import TooManyError, vertices, volume
from ..scenes.scene import Scene
from .equations import Network, balance, friction_problem

_COLUMNS = 60


@dataclass(frozen=True, eq=False)
class Extremes:
    """The corners of the set of networks, the changes without end, and the volume.

    `volume` (w to the power of the dimension) is that of the projection onto `coordinates`, force
    components that determine all others: (contact number, 0 where the contact is smooth, +1 and -1
    for x+ = (f_n + f_t / mu) / 2 and x- = (f_n - f_t / mu) / 2). It is None where the set has no
    end, or is too complicated to be measured.
    """

    scene: Scene
    mu: Surd
    rough: tuple[str, ...]
    networks: tuple[Network, ...]
    rays: tuple[Network, ...]
    coordinates: tuple[tuple[int, int], ...]
    volume: Surd | None

    def __repr__(self) -> str:
        size = "" if self.volume is None else f", volume {self.volume}"
        return f"<Extremes: {len(self.networks)} corners, {len(self.rays)} rays{size}>"


def extremes(scene: Scene, mu: Exact, rough: Sequence[str] = ()) -> Extremes:
    """All corners of the set of admissible networks of a tiny pile, exactly.

    Every admissible network is a mean of them, plus a sum of the changes that have no end.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.

    Returns
    -------
    Extremes
        The corners (`networks`, in w), the changes without end (`rays`), and the `volume`.

    Raises
    ------
    InputError
        For a scene or friction that is none of these.
    SolveError
        For a pile that is not tiny (more than 60 force components, or 400 corners and rays on the
        way) or that no network holds.

    Examples
    --------
    TBS 1 without friction may carry its weight by the disc below alone, or by those at its sides:

    >>> from lcp_piles import tbs
    >>> sorted([str(f) for f in network.normal] for network in extremes(tbs(1), 0).networks)
    [['0', '0', '1'], ['1', '1', '0']]
    """
    problem = friction_problem(scene, mu, rough)
    read = problem.constraints
    if len(read.columns) > _COLUMNS:
        count = len(read.columns)
        raise SolveError(f"{count} force components: corners are listed for at most {_COLUMNS}")
    hull = affine_hull(read)
    if hull is None:
        raise SolveError("no forces balance the loads with this friction: there is no corner")
    support = sorted(set(range(len(read.columns))) - set(hull.zero))
    free, c, D = _solved(scene, mu, rough, support)
    if len(free) != hull.dimension:
        raise VerificationError(f"dimension {len(free)} by elimination, {hull.dimension} otherwise")
    found = vertices(c, D)
    order = [*free, *(j for j in support if j not in free)]

    def network(y: Sequence[Surd], load: int) -> Network:
        x = [ZERO] * len(read.columns)
        for j, constant, row in zip(order, c, D, strict=True):
            x[j] = constant * load + sum((d * v for d, v in zip(row, y, strict=True)), ZERO)
        point = exact_vector(x)
        if load and not is_feasible(read, point):
            raise VerificationError("a corner does not balance the loads")
        return problem.network(point)

    sides = {p: 0 if p == m else 1 for p, m in zip(problem.plus, problem.minus, strict=True)}
    contact = {p: k for ways in (problem.minus, problem.plus) for k, p in enumerate(ways)}
    try:
        size = None if found.rays else volume(found)
    except TooManyError:
        size = None
    return Extremes(
        scene,
        problem.mu,
        tuple(rough),
        tuple(network(y, 1) for y in found.points),
        tuple(network(y, 0) for y in found.rays),
        tuple((contact[j], sides.get(j, -1)) for j in free),
        size,
    )


def _solved(
    scene: Scene, mu: Exact, rough: Sequence[str], support: Sequence[int]
) -> tuple[list[int], list[Surd], list[list[Surd]]]:
    """A x = b over the support, solved for all but some free columns y: x = c + D y, y first."""
    given = balance(scene, mu, rough)
    place = {j: k for k, j in enumerate(support)}
    width = len(support)
    rows = [[*[ZERO] * width, load] for load in given.loads]
    matrix = given.matrix
    for i, j, value in zip(matrix.rows, matrix.columns, matrix.values, strict=True):
        if j in place:
            rows[i][place[j]] += value
    pivots: list[tuple[int, list[Surd]]] = []
    for k in range(width):
        pivot = next((row for row in rows if row[k]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        pivot = [x / pivot[k] for x in pivot]
        for row in [*rows, *(old for _, old in pivots)]:
            if row[k]:
                share = row[k]
                row[:] = [x - share * y for x, y in zip(row, pivot, strict=True)]
        pivots.append((k, pivot))
    chosen = [k for k, _ in pivots]
    free = [k for k in range(width) if k not in chosen]
    one = [[ONE if k == j else ZERO for j in free] for k in free]
    c = [ZERO] * len(free) + [row[width] for _, row in pivots]
    D = one + [[-row[k] for k in free] for _, row in pivots]
    order = [support[k] for k in free]
    return order, c, D

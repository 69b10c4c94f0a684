"""Every computed figure of the paper, made again: one picture a figure, its numbers beside it.

The sizes are the paper's, or beyond them where the paper stopped for want of a machine (the forces
on disc (2,1) of TBS go on until contact e is open). Piles on a smooth floor are shown on a floor as
soft as the discs and on the paper's floor, compliance -1/2. Not made again: the sketch that defines
the letters, and the data of molecular dynamics, which the text of the paper does not hold.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from ..errors import InputError
from ..pictures.plotting import save
from .figures_fields import pressure_plate, size_plate, stress_plate, tbs_pressure_plate
from .figures_flowchart import flowchart_plate
from .figures_networks import hong_remark, network_plate, scene_plate
from .figures_push import apex_pressure_plate, push_sequence_plate
from .figures_table1 import table1_plate
from .plate import Plate

_TBS_SIZES = (*range(2, 31), *range(35, 91, 5), *range(90, 121, 6))

FIGURES: dict[str, Callable[[], Plate]] = {
    "scenes-tbs": partial(scene_plate, "tbs", 5),
    "scenes-tss": partial(scene_plate, "tss", 7),
    "scenes-nt60": partial(scene_plate, "nt60", 9),
    "scenes-nt30": partial(scene_plate, "nt30", 8),
    "flowchart": partial(flowchart_plate, "tss", 10),
    "network-tbs": partial(network_plate, "tbs", 15),
    "stress-tbs": partial(stress_plate, "tbs", 11),
    "pressure-tbs": partial(tbs_pressure_plate, 17),
    "size-tbs": partial(size_plate, "tbs", "adef", _TBS_SIZES),
    "network-tss": partial(network_plate, "tss", 10, by_z=True),
    "stress-tss": partial(stress_plate, "tss", 10),
    "pressure-tss": partial(pressure_plate, "tss", (13,)),
    "size-tss": partial(size_plate, "tss", "ade", range(4, 31)),
    "network-nt60": partial(network_plate, "nt60", 9, remark=hong_remark),
    "network-nt30": partial(network_plate, "nt30", 6),
    "stress-nt30": partial(stress_plate, "nt30", 6),
    "pressure-nt30": partial(pressure_plate, "nt30", (6, 5)),
    "push-sequence": partial(push_sequence_plate, 6, (4, 10, 12, 15, 19, 21, 23)),
    "apex-pressure": partial(apex_pressure_plate, 6),
    "table1": table1_plate,
}

NAMES = tuple(FIGURES)
"""The figures that `reproduce` makes, in the paper's order."""


def reproduce(
    out: Path,
    only: Sequence[str] | None = None,
    progress: Callable[[str], None] | None = None,
) -> list[Path]:
    """Make the figures of the paper in a directory, and return the files written.

    Parameters: `out`, made if it is not there; `only`, some of `NAMES` (None: all of them);
    `progress`, called with the name of each figure before it is made. A figure is a PNG and a
    PDF, and its numbers one or more CSV files that begin with its name, exact and in decimals;
    Table 1 is CSV and Markdown. Raises `InputError` for unknown names and for files that
    cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     [path.name for path in reproduce(Path(place), ["scenes-tbs"])]
    ['scenes-tbs.png', 'scenes-tbs.pdf', 'scenes-tbs.csv']
    """
    wanted = NAMES if only is None else tuple(only)
    for name in wanted:
        if name not in FIGURES:
            raise InputError("the figure", name, "one of " + ", ".join(NAMES))
    written: list[Path] = []
    for name in wanted:
        if progress:
            progress(name)
        written += _write(FIGURES[name](), out, name)
    return written


def _write(plate: Plate, out: Path, name: str) -> list[Path]:
    written = []
    try:
        out.mkdir(parents=True, exist_ok=True)
        if plate.picture is not None:
            for ending in (".png", ".pdf"):
                written.append(out / f"{name}{ending}")
                save(plate.picture, written[-1])
        for ending, text in plate.texts.items():
            written.append(out / f"{name}{ending}")
            written[-1].write_text(text, encoding="utf-8")
    except OSError as fault:
        raise InputError(
            "the directory of the figures", str(out), "one that can be written", str(fault)
        ) from fault
    return written

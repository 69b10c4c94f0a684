"""`python -m benchmarks.reference`: write the reference cases, their certificates and checksums."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from benchmarks.reference.cases import CASES, Case
from benchmarks.reference.record import record
from lcp_piles.certificates.certify import certificate, text_of

DATA = Path(__file__).parent / "data"
SUMS = "SHA256SUMS"
TABLE = "README.md"
_HEAD = """# Reference cases for simulations of discs

Exact forces of small piles, as files to test a code for discrete elements against without
installing anything. `NAME.json` has the setup in decimals of 17 digits and exactly, every force
(`force`: decimal and exact, in disc weights), its first correction for soft discs (`per_tau`: a
code with linear springs of compliance tau finds force + tau x per_tau up to order tau squared), the
state of every contact, and what a correct code should find (`expect`); `case.schema.json`
describes the fields. `NAME.certificate.json` proves it: `python
lcp_piles/certificates/check_certificate.py FILE` needs nothing but Python. `SHA256SUMS` is for
`sha256sum -c`. Larger cases: `lcp-piles solve ... --json FILE --certificate FILE --stiffness TAU`.

Setup of all: discs touch without load at the given positions; the contact law is linear in the
overlap, without friction or adhesion; a contact's compliance counts in tau. Held discs do not move
(or move by `held`, in w tau). Gravity is `load`, in weights. Start at rest there, and damp.

"""
_COLUMNS = (
    "case",
    "discs",
    "contacts: closed, open, just touching",
    "largest force (w)",
    "largest change per tau",
    "first order until tau",
    "stability",
    "what it tests",
)


def files(cases: Sequence[Case] = CASES) -> dict[str, str]:
    """The texts of all files by their names: cases, certificates, table and checksums."""
    texts: dict[str, str] = {}
    rows = [_line(_COLUMNS), "|" + "---|" * len(_COLUMNS)]
    for case in cases:
        data, solution = record(case)
        texts[f"{case.name}.json"] = json.dumps(data, indent=1) + "\n"
        texts[f"{case.name}.certificate.json"] = text_of(certificate(solution))
        rows.append(_row(data))
    texts[TABLE] = _HEAD + "\n".join(rows) + "\n"
    sums = [f"{sha256(text.encode()).hexdigest()}  {name}" for name, text in texts.items()]
    return {**texts, SUMS: "\n".join(sums) + "\n"}


def _row(data: dict[str, Any]) -> str:
    contacts = data.get("contacts")
    if contacts is None:
        cells = ["", "", "", "", data["status"]]
    else:
        states = [c["state"] for c in contacts]
        counts = [str(states.count(s)) for s in ("closed", "open", "osculatory")]
        rates = [abs(c["per_tau"]) for c in contacts if c["per_tau"] is not None]
        until = data["first_order_until"]
        cells = [
            ", ".join(counts),
            f"{max(c['force'][0] for c in contacts):.12g}",
            f"{max(rates):.6g}" if rates else "none",
            ("always" if until is None else f"{until:.3g}") if rates else "",
            data["stability"],
        ]
    return _line([data["name"], str(len(data["discs"])), *cells, data["tests"]])


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Write every file into a directory."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=DATA, help="default: %(default)s")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    for name, text in files().items():
        (out / name).write_text(text, encoding="utf-8", newline="\n")
    print(f"wrote {len(CASES)} cases to {out}")


if __name__ == "__main__":
    main()

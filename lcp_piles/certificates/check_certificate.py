#!/usr/bin/env python3
"""Check a certificate: forces in a pile, a push, bounds with friction, a complementarity problem.

    python check_certificate.py FILE

Prints what the file proves (its format: notes/certificates.md). Exit status 0: all of it holds; 1:
something does not; 2: there is no such file. It needs Python 3.11, and shares nothing with the
program that wrote the file. What you trust is Python's integers, fractions and JSON, the laws
stated at the checks, and this text, which is all there is.
"""

# fmt: off
import json
import re
import sys
from fractions import Fraction
from heapq import heapify, heappop, heappush
from itertools import pairwise
from math import gcd, isqrt, lcm
from types import SimpleNamespace as Record

MOST_BYTES, MOST_MARKS, MOST_PLACES, MOST_DISCS = 2**29, 2**22, 2**21, 100_000
MOST_DIGITS, MOST_TEXT = 100_000, 4_000  # of a hexadecimal number, of a number as people write it
TERM = r"(^|[+-] ?)(\d+)?(?:/([1-9]\d*))?(?:(?:(?<=\d)\*|(?<!\d))sqrt\((\d+)\))?(?: (?=[+-])|$)"

class RefutedError(Exception):
    """What the file says is false, or not of the format."""

def need(holds, what):
    if not holds:
        raise RefutedError(what)

class Number(dict):
    """A sum of x sqrt(r), as {r: x}, with rational x and square-free r.

    It is zero only if every x is (Besicovitch 1940), so enough digits tell its sign.
    """
    def __add__(self, other):
        total = Number(self)
        for r, x in other.items():
            total[r] = total.get(r, 0) + x
        return total

    def __mul__(self, other):
        total = Number()
        for r, x in self.items():
            for s, y in other.items() if isinstance(other, dict) else [(1, other)]:
                g = gcd(r, s)
                total[r // g * (s // g)] = total.get(r // g * (s // g), 0) + x * y * g
        return total

    def __neg__(self):
        return self * -1

    def sign(self):
        terms = [(r, x) for r, x in self.items() if x]
        if len({x > 0 for _, x in terms}) < 2:
            return 0 if not terms else 1 if terms[0][1] > 0 else -1
        scale, shift = lcm(*(x.denominator for _, x in terms)), 64
        while True:  # each root is cut off below 2^-shift, and loses less than one unit
            cut = [(isqrt(int(x * scale) ** 2 * r << 2 * shift), x) for r, x in terms]
            total = sum(root if x > 0 else -root for root, x in cut)
            if abs(total) > len(terms):
                return 1 if total > 0 else -1
            shift *= 2

ZERO, ONE = Number(), Number({1: 1})

def root(text):
    r = int(text) if text.isdecimal() and len(text) < 10 else 0
    square_free = r > 0 and all(r % (p * p) for p in range(2, isqrt(r) + 1))
    need(square_free and str(r) == text, f"{text!r} is square-free")
    return r

def number(text):
    """The number that a text such as "2 - 1/2*sqrt(3)" writes."""
    need(isinstance(text, str) and 0 < len(text) <= MOST_TEXT, "a number is a text")
    parts = [*re.finditer(TERM, text, re.ASCII)]
    whole = "".join(m[0] for m in parts) == text
    need(whole and all(m[2] or m[4] for m in parts), f"{text[:60]!r} is a number")
    terms = [(m[4] or "1", Fraction(int(m[2] or 1), int(m[3] or 1)), m[1]) for m in parts]
    return sum((Number({root(r): -x if "-" in sign else x}) for r, x, sign in terms), ZERO)

def integers(text, count=None):
    words = text.split(" ") if text else []
    need(count in (None, len(words)), f"there are {count} numbers, not {len(words)}")
    need(max(map(len, words), default=0) <= MOST_DIGITS, "numbers are short enough")
    return [int(word, 16) for word in words]

def vector(entry, places):
    """({place: number}, denominator) from {"denominator": hex, "1": hex hex ..., "3": ...}."""
    (den,) = integers(entry.all()["denominator"], 1)
    need(den > 0 and len(entry) < 10 and len(places) <= MOST_PLACES, "a vector is short enough")
    found = {place: Number() for place in places}
    for text in entry.keys() - {"denominator"}:
        r = root(text)
        for place, x in zip(found, integers(entry[text], len(found))):
            if x:
                found[place][r] = x
    return found, den

# ---- Scenes: discs with loads and held displacements; contacts with the normal from b to a

def written(discs, contacts, supports):
    ids = [json.dumps(d["id"]) for d in discs]
    index = {name: k for k, name in enumerate(ids)} | {json.dumps(s): None for s in supports}
    need(ids and len(index) == len(ids) + len(supports), "discs and supports have their own names")
    loads = [[number(x) for x in d["load"]] for d in discs]
    held = [[None if x is None else number(x) for x in d["held"]] for d in discs]
    found = [Record(a=index[json.dumps(c["a"])], b=index[json.dumps(c["b"])], end=c["b"],
                    normal=[number(x) for x in c["normal"]], compliance=number(c["compliance"]),
                    gap=number(c["gap"]), tied=c["bilateral"]) for c in contacts]
    need(all(type(c.tied) is bool for c in found), "a contact is bilateral or not")
    need(all(c.a is not None and c.a != c.b for c in found), "a contact has two ends")
    need(len({*map(len, [*loads, *held, *(c.normal for c in found)])}) == 1, "one number of axes")
    return loads, held, found

def pile(kind, layers, push="0", floor_compliance="1", corner_stones="held"):
    """A pile of the paper: rows from the apex down, from left to right; floor contacts last."""
    need(kind in ("nt30", "nt60", "tss", "tbs") and layers in range(1, 500), "a pile of the paper")
    need(corner_stones in ("held", "resting"), "corner stones are held or resting")
    bumpy, tilted, half = kind == "tbs", kind in ("tss", "tbs"), Fraction(1, 2)
    x, y = (Number({3: half}), Number({1: half}))[::1 if tilted else -1]
    below = [(1, -1, [x, y]), (1, 1, [-x, y])]  # rows and columns on, the normal
    beside = [*below, (2, 0, [ZERO, ONE])] if tilted else [(0, 2, [-ONE, ZERO]), *below]
    last = layers + 2 * bumpy
    lengths = [3 * i - 2 if kind == "nt30" else i for i in range(1, last + 1)]
    need(sum(lengths) <= MOST_DISCS, "a pile of so many discs")
    places = [(i, 2 * j - t - 1) for i, t in enumerate(lengths, 1) for j in range(1, t + 1)]
    index, edge, inward = {p: k for k, p in enumerate(places)}, lengths[-1] - 1, number(push)
    stones = {} if bumpy else {(last, side * edge): [inward * -side, ZERO] for side in (-1, 1)}
    pairs = [(p, (p[0] + i, p[1] + j), n) for p in places if p[0] <= layers for i, j, n in beside]
    disc = Record(end=None, compliance=ONE, gap=ZERO, tied=False)
    found = [Record(a=index[a], b=index[b], normal=n, **vars(disc)) for a, b, n in pairs
             if b in index and not {a, b} <= stones.keys()]
    if corner_stones == "resting":
        stones = {p: [x, None] for p, (x, _) in stones.items()}
    held = [[ZERO, ZERO] if p[0] > layers else stones.get(p, [None, None]) for p in places]
    floor = Record(b=None, end="floor", normal=[ZERO, ONE], compliance=number(floor_compliance),
                   gap=ZERO, tied=number(floor_compliance).sign() < 0)
    found += [Record(a=k, **vars(floor)) for k, p in enumerate(places)
              if p[0] == last and held[k][1] is None and not bumpy]
    return [[ZERO, -ONE]] * len(places), held, found

def system(scene, mu=None, rough=()):
    """Rows B of the gaps B u + o + C f and of the balance B^T f + p = 0, one a contact.

    They are multiplied by one `scale`, which makes integers of them: Fractions take long.
    With friction mu a disc also turns (clockwise), and a rough contact has a row for each of
    x+, x- >= 0 in f_n = x+ + x-, f_t = mu (x+ - x-), the force on a along t = (-n_y, n_x).
    """
    loads, held, contacts = (pile if "kind" in scene else written)(**scene.all())
    rows, of, turning, axes = [], [], mu is not None, len(held[0])
    need(not turning or (axes == 2 and isinstance(rough, (list, tuple))), "friction is in a plane")
    for k, c in enumerate(contacts):
        need(sum((n * n for n in c.normal), -ONE).sign() == 0, "a normal has length one")
        need(c.compliance.keys() <= {1}, "a compliance is rational")
        slips = [mu, -mu] if mu and mu.sign() and (c.b is not None or c.end in rough) else [ZERO]
        for slip in slips:
            t = [c.normal[-1] * -slip, c.normal[0] * slip] if slip else [ZERO] * axes
            pull, turn = [n + x for n, x in zip(c.normal, t)], [slip] * turning
            ends = {c.a: [*pull, *turn], c.b: [*(-x for x in pull), *turn]}
            ends.pop(None, None)  # supports do not move
            rows.append({(d, i): x for d, ways in ends.items() for i, x in enumerate(ways)})
            of.append((k, slip))
    scale = lcm(*(x.denominator for row in rows for n in row.values() for x in n.values()))
    rows = [{j: Number({r: int(x * scale) for r, x in n.items()}) for j, n in row.items()}
            for row in rows]
    held = [[*h, *[None if None in h else ZERO] * turning] for h in held]
    loads = [[*p, *[ZERO] * turning] for p in loads]
    tied = [contacts[k].tied for k, _ in of]
    return Record(rows=rows, scale=scale, of=of, contacts=contacts, tied=tied,
                  held={(d, i): x for d, h in enumerate(held) for i, x in enumerate(h)},
                  load={(d, i): x for d, p in enumerate(loads) for i, x in enumerate(p)})

# ---- Laws

def motion(s, entry):
    v, den = vector(entry, s.held)
    need(not any(v[j] for j, h in s.held.items() if h is not None), "a motion moves nothing held")
    return v, den

def rate(row, v):
    return sum((n * v[j] for j, n in row.items() if n and v[j]), ZERO)

def balance(s, f, load):
    total = {j: p * s.scale for j, p in load.items() if s.held[j] is None}
    for row, x in zip(s.rows, f, strict=True):
        for j, n in row.items():
            if x and n and j in total:
                total[j] = total[j] + n * x
    need(not any(p.sign() for p in total.values()), "forces balance at every disc")

def state(s, entry, gap, held, load):
    """The signs of forces and gaps of a solution."""
    (u, a), (f, b) = vector(entry["u"], s.held), vector(entry["f"], range(len(s.rows)))
    off = [u[j] + h * -a for j, h in held.items() if h is not None]
    need(not any(x.sign() for x in off), "what is held is where it is held")
    balance(s, f.values(), {j: p * b for j, p in load.items()})
    g = [(rate(row, u) * b + (o * b + c.compliance * f[k]) * (a * s.scale)).sign()
         for k, (row, c, o) in enumerate(zip(s.rows, s.contacts, gap))]
    f = [x.sign() for x in f.values()]
    right = [y == 0 if tied else x >= 0 <= y and x * y == 0 for x, y, tied in zip(f, g, s.tied)]
    need(all(right), "contacts neither pull nor overlap, and bear nothing where there is a gap")
    return f, g

def independent(rows, s, proof):
    """Numbers of rows that elimination modulo m, where roots are integers, shows independent."""
    m, roots = proof["modulus"], {root(q): x for q, x in proof["roots"].all().items()}
    primes = all(q > 1 and all(q % d for d in range(2, isqrt(q) + 1)) for q in roots)
    need(primes and m > 1 and all(x * x % m == q % m for q, x in roots.items()), "roots modulo m")
    whole = {1: 1}
    for q, x in roots.items():
        whole |= {r * q: y * x for r, y in whole.items()}
    places = [j for j, h in s.held.items() if h is None]
    order, turn, kept, free = integers(proof["pivots"]), {}, [], {*places}
    for k, j in zip(order[::2], order[1::2], strict=True):
        row = {i: sum(x.numerator * pow(x.denominator, -1, m) * whole[r] for r, x in n.items()) % m
               for i, n in rows[k].items() if i in free}
        heap = [turn[i] for i in row if i in turn]
        heapify(heap)
        while heap:  # the rows before this one, in their order
            i, old = kept[heappop(heap)]
            x = row.pop(i, 0)
            for d, y in old.items() if x else ():
                if d in turn and d not in row:
                    heappush(heap, turn[d])
                row[d] = (row.get(d, 0) - x * y) % m
        pivot, over = places[j], pow(row.pop(places[j]), -1, m)
        turn[pivot] = len(kept)
        kept.append((pivot, {d: y * over % m for d, y in row.items() if y}))
    return order[::2], len(places)

def kernel(s, chosen, proof):
    """A basis of all motions that leave the chosen rows at rest."""
    basis = [motion(s, entry)[0] for entry in proof["motions"]]
    rates = [rate(s.rows[k], v) for v in basis for k in chosen]
    need(not any(x.sign() for x in rates), "the motions leave contacts at rest")
    found, size = independent([*(s.rows[k] for k in chosen), *basis], s, proof)
    rank = sum(k < len(chosen) for k in found)
    need(len(found) == size == rank + len(basis), "there is no other motion")
    return basis

# ---- Claims: each function yields, in words, what it has proved

def forces(c):
    """Two solutions have f . g' = f' . g = 0 and C (f - f') = 0 if no compliance is negative.

    So a contact with a force in one has no gap in any, and the other way round.
    """
    s = system(c["scene"])
    f, g = state(s, c, [x.gap for x in s.contacts], s.held, s.load)
    everywhere, none = range(len(f)), dict.fromkeys(s.load, ZERO)
    yield f"the forces solve the scene, on {sum(map(bool, f))} contacts of {len(f)}"
    held = [k for k in everywhere if f[k] or s.tied[k]]
    idle = [k for k in everywhere if not (f[k] or g[k] or s.tied[k])]
    mechanisms = kernel(s, held, c["mechanisms"])
    yield f"motions that leave the contacts with forces at rest: {len(mechanisms)}"
    if any(x.compliance.sign() < 0 for x in s.contacts):
        return (yield "a compliance is negative: no word on other solutions and on stability")
    rigid = {k for k, x in enumerate(s.contacts) if x.compliance.sign() == 0}
    if idle:  # a stress that presses on all of them keeps every motion from opening one
        stress, _ = vector(c["stress"], everywhere)
        need(all(stress[k].sign() > 0 for k in idle), "the stress presses on idle contacts")
        need(not any(stress[k] for k in everywhere if g[k]), "and acts on none that is open")
        balance(s, stress.values(), none)
    if rigid & {*idle}:  # a motion that opens all of these keeps every stress from loading one
        v, _ = motion(s, c["motion"])
        rates = {k: rate(s.rows[k], v).sign() for k in rigid if not g[k]}
        need(all(x == (k in idle) for k, x in rates.items()), "the motion opens idle ones")
    yield f"open in some solution: {sum(map(bool, g))} contacts; just touching in all: {len(idle)}"
    hard = [k for k in held if k in rigid]
    if "rigid stress" in c:
        stress, _ = vector(c["rigid stress"], everywhere)
        where = {k for k in everywhere if stress[k]}
        need(where and where <= {*hard}, "a stress acts on rigid contacts with forces alone")
        balance(s, stress.values(), none)
    elif hard:
        found, _ = independent([s.rows[k] for k in hard], s, c["rigid"])
        need(sorted(found) == [*range(len(hard))], "rigid contacts are independent")
    yield "other forces solve it too" if "rigid stress" in c else "no other forces solve it"
    free = kernel(s, [*held, *idle], c["free"]) if idle and mechanisms else mechanisms
    moved = [k for k, row in enumerate(s.rows) if any(rate(row, v).sign() for v in free)]
    yield f"motions that leave at rest all that touch: {len(free)}; they change {len(moved)} gaps"
    slides = {f[k] for k, x in enumerate(s.contacts) if f[k] and x.b is not None
              if any(v[x.a, i] != v[x.b, i] for v in free for i in range(len(x.normal)))}
    flat = "saddle" if slides else "neutral"
    yield f"the equilibrium is {'undecided' if -1 in slides else flat if free else 'stable'}"

def gives_way(c, mu):
    """Forces that balance would give 0 <= sum x (B v) = -p . v < 0."""
    s = system(c["scene"], mu, c["rough"] if mu is not None else ())
    v, _ = motion(s, c["motion"])
    rates = [rate(row, v).sign() for row in s.rows]
    need(all(x == 0 if tied else x >= 0 for x, tied in zip(rates, s.tied)), "no contact closes")
    need(rate(s.load, v).sign() > 0, "the load does work on the motion")

def network(s, entry, load):
    x, den = vector(entry, range(len(s.rows)))
    need(all(y.sign() >= 0 for y in x.values()), "no contact pulls")
    balance(s, x.values(), {j: p * (den * load) for j, p in s.load.items()})
    return x, den

def collapse(c):
    gives_way(c, number(c["friction"]) if "friction" in c else None)
    yield "no forces balance the loads: the scene gives way"

def critical(c):
    """What balances with some friction balances with more."""
    network(system(c["scene"], number(c["upper"]), c["rough"]), c["network"], 1)
    yield f"it stands with friction {c['upper']}, or more"
    if "lower" in c:
        gives_way(c, number(c["lower"]))
        yield f"it gives way with friction {c['lower']}, or less"

def path(c):
    """Between two solutions, where none bears what is open in the other, all are solutions."""
    s, end, points, pieces = system(c["scene"]), system(c["towards"]), [], []
    need(s.rows == end.rows and s.tied == end.tied, "scenes differ in gaps, loads and held discs")
    need(all(x.compliance == y.compliance for x, y in zip(s.contacts, end.contacts)), "no more")
    need(all((h is None) == (end.held[j] is None) for j, h in s.held.items()), "the same is held")

    def solved(entry, first, t):  # the scenes first * here + t * (there - here)
        def mixed(a, b):
            return None if a is None else a * first + (b + -a) * t
        gap = [mixed(x.gap, y.gap) for x, y in zip(s.contacts, end.contacts)]
        held = {j: mixed(x, end.held[j]) for j, x in s.held.items()}
        return state(s, entry, gap, held, {j: mixed(x, end.load[j]) for j, x in s.load.items()})

    def joined(f, g, h, k):
        need(not any(a * y or x * b for a, b, x, y in zip(f, g, h, k)), "the way between solves it")
        return [bool(a or x) for a, x in zip(f, h)]

    for entry in c["points"]:
        points.append((entry["t"], solved(entry, 1, number(entry["t"]))))
    for (t, one), (later, two) in pairwise(points):
        loaded, step = joined(*one, *two), (number(later) + -number(t)).sign()
        need(step >= 0, "the points follow each other")
        pieces += [(t, loaded)] * step
    if "direction" in c:
        t, last = points[-1]
        pieces.append((t, joined(*last, *solved(c["direction"], 0, ONE))))
        yield "beyond the last point it goes on without end"
    yield f"{len(pieces)} pieces from {points[0][0]} to {points[-1][0]}"
    for (_, before), (t, after) in pairwise(pieces):
        signs = [(k, "+" if y else "-") for k, (x, y) in enumerate(zip(before, after)) if x != y]
        if signs:
            yield f"at {t} forces come (+) or go (-): {' '.join(f'{sign}{k}' for k, sign in signs)}"

def bounds(c):
    """The sum of w x is -p . v or more if w - B v >= 0 for a motion v: sum x (B v) = -p . v."""
    s = system(c["scene"], number(c["friction"]), c["rough"])
    for end in c["bounds"]:
        yield bound(s, end)

def bound(s, c):
    sense = {"least": 1, "largest": -1}[c["end"]]
    x, den = network(s, c["network"], 1)
    weigh = {int(k): [number(x) * sense for x in pair] for k, pair in c["weights"].all().items()}
    pairs, kinds = c["weights"].items(), ("f_n", "f_t")
    named = [(x, f"{f}({k})") for k, pair in pairs for x, f in zip(pair, kinds)]
    what = " + ".join(f"{x} {f}" for x, f in named if number(x).sign()) or "nothing"
    weights = [weigh[k][0] + weigh[k][1] * slip if k in weigh else ZERO for k, slip in s.of]
    if "ray" in c:
        r, _ = network(s, c["ray"], 0)
        need(sum((w * r[k] for k, w in enumerate(weights)), ZERO).sign() < 0, "the ray leads on")
        return f"there is no {c['end']} value of {what}"
    v, a = motion(s, c["motion"])
    rest = [(w * (a * s.scale) + -rate(row, v)).sign() for w, row in zip(weights, s.rows)]
    need(min(rest, default=0) >= 0, "the motion bounds it")
    value = number(c["value"]) * sense
    need((rate(s.load, v) + value * a).sign() == 0, "the motion gives the value")
    attained = sum((w * x[k] for k, w in enumerate(weights)), -(value * den))
    need(attained.sign() == 0, "the network has it")
    return f"the {c['end']} value of {what} is {c['value']}"

def lcp(c):
    """0 <= z, w = M z + q with z . w = 0; or y >= 0, M^T y <= 0, q . y < 0, which allows no w."""
    q, scale = vector(c["q"], range(c["size"]))
    entries, unit = vector(c["M"], [*zip(integers(c["rows"]), integers(c["columns"]), strict=True)])
    z, den = vector(c["z" if "z" in c else "y"], range(len(q)))
    need(all(x.sign() >= 0 for x in z.values()), "no entry is negative")
    w = {i: x * (den * unit) if "z" in c else ZERO for i, x in q.items()}
    for (i, j), x in entries.items():
        a, b = (i, j) if "z" in c else (j, i)
        w[a] = w[a] + x * z[b] * scale
    signs = {i: x.sign() for i, x in w.items()}
    if "z" in c:
        need(all(x >= 0 and not (x and z[i]) for i, x in signs.items()), "w >= 0 and z . w = 0")
        return (yield f"z solves the complementarity problem of {len(q)} unknowns")
    need(all(x <= 0 for x in signs.values()), "M^T y <= 0")
    need(sum((x * z[i] for i, x in q.items()), ZERO).sign() < 0, "q . y < 0")
    yield f"no z >= 0 has M z + q >= 0: the problem of {len(q)} unknowns has no solution"

# ---- Files

class Entry(dict):
    """An object of a file, that knows which of its fields were asked for."""
    def __init__(self, pairs, known):
        super().__init__(pairs)
        need(len(self) == len(pairs), "a name stands once")
        self.used = set()
        known.append(self)

    def __getitem__(self, name):
        self.used.add(name)
        return super().__getitem__(name)

    def all(self):
        self.used.update(self)
        return self

CLAIMS = {"forces": forces, "collapse": collapse, "path": path, "bounds": bounds,
          "critical friction": critical, "lcp": lcp}
FAULTS = (RefutedError, ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError,
          TypeError, ValueError)

def check(data: bytes) -> list[str]:
    """What a certificate, in bytes, proves, in words; one of FAULTS where it does not."""
    known: list[Entry] = []
    need(len(data) <= MOST_BYTES and sum(map(data.count, b",[{:")) <= MOST_MARKS, "a file so large")
    c = json.loads(data, object_pairs_hook=lambda pairs: Entry(pairs, known))
    need(c["format"] == "lcp-piles-certificate/1", "a format that is known")
    proved = [*CLAIMS[c["claim"]](c)]
    need(all(entry.keys() <= entry.used for entry in known), "every field is asked for by a check")
    return proved

def main(path: str) -> int:
    try:
        with open(path, "rb") as file:
            proved = check(file.read(MOST_BYTES + 1))
    except OSError as error:
        print(f"cannot read it: {error}", file=sys.stderr)
        return 2
    except FAULTS as error:
        print(f"NOT PROVED ({type(error).__name__}): {str(error)[:200]}")
        return 1
    print("PROVED:", *proved, sep="\n  ")
    return 0

if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)

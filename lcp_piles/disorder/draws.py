"""Random numbers for the initial gaps of a scene, in integers, the same on every machine.

Sample k of a seed reads the raw words of numpy's PCG64 from `SeedSequence(seed, spawn_key=(k,))`.
Those are fixed for ever (NEP 19), unlike numpy's distributions, so the distributions are our own:
a draw is an integer, in units of `amplitude / UNIT`, made by integer arithmetic. Nothing depends on
the order of samples, their number, the processor or the version of a library.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

import numpy as np
from flint import arb, ctx

from ..errors import InputError
from ..numbers.exact import Exact
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.conversion import rational_of
from ..scenes.scene import Scene

UNIT = 2**30
"""Draws are integers over this: an amplitude of 1 w tau has steps of 1e-9."""
_CUT = 3
_BITS = 128
_NEAR_TIE = 1e-3


class Disorder(Protocol):
    """A distribution of initial gaps; `Uniform`, `Normal` and `Radii` are the ones we have."""

    @property
    def amplitude(self) -> Fraction:
        """The size of the gaps in w tau."""

    def draw(self, scene: Scene, words: Words) -> IntArray:
        """What is added to the initial gap of every contact, in units of `amplitude / UNIT`."""


class Words(Protocol):
    """A source of random words of 64 bits."""

    def __call__(self, size: int) -> np.ndarray[tuple[int], np.dtype[np.uint64]]:
        """The next `size` words."""


@dataclass(frozen=True)
class Uniform:
    """Gaps of a uniform distribution from -amplitude to amplitude.

    Attributes
    ----------
    amplitude : Fraction
        The largest gap (w tau), at least 0; given as any exact rational.

    Raises
    ------
    InputError
        For another amplitude.

    Examples
    --------
    >>> Uniform("1/2")
    Uniform(amplitude=Fraction(1, 2))
    """

    amplitude: Fraction

    def __init__(self, amplitude: Exact) -> None:
        object.__setattr__(self, "amplitude", _amplitude(amplitude))

    def draw(self, scene: Scene, words: Words) -> IntArray:
        """The gaps of a sample: a number a contact.

        Parameters
        ----------
        scene : Scene
            The scene.
        words : callable
            So many random words of the sample.

        Returns
        -------
        array of int, shape (contacts,)
            What is added to the initial gaps, in units of `amplitude / UNIT`.
        """
        return _uniform(words(len(scene.contacts)))


@dataclass(frozen=True)
class Normal:
    """Gaps of a normal distribution of mean 0, cut off at three deviations.

    What is further than three deviations from the mean never occurs, so the standard deviation is
    0.9866 amplitudes.

    Attributes
    ----------
    amplitude : Fraction
        The deviation before the cut (w tau), at least 0; given as any exact rational.

    Raises
    ------
    InputError
        For another amplitude.

    Examples
    --------
    >>> Normal(2)
    Normal(amplitude=Fraction(2, 1))
    """

    amplitude: Fraction

    def __init__(self, amplitude: Exact) -> None:
        object.__setattr__(self, "amplitude", _amplitude(amplitude))

    def draw(self, scene: Scene, words: Words) -> IntArray:
        """The gaps of a sample: a number a contact.

        Parameters
        ----------
        scene : Scene
            The scene.
        words : callable
            So many random words of the sample.

        Returns
        -------
        array of int, shape (contacts,)
            What is added to the initial gaps, in units of `amplitude / UNIT`.
        """
        return _normal(words(len(scene.contacts)))


@dataclass(frozen=True)
class Radii:
    """Gaps of discs of random radii, r + dr with dr uniform from -amplitude to amplitude.

    The lattice stays, so the initial gap of a contact between discs a and b is -(dr_a + dr_b), and
    that of a disc and a support -dr_a. Every disc has a dr, those that are held too.

    Attributes
    ----------
    amplitude : Fraction
        The largest dr (w tau), at least 0; given as any exact rational.

    Raises
    ------
    InputError
        For another amplitude.

    Examples
    --------
    >>> Radii(5)
    Radii(amplitude=Fraction(5, 1))
    """

    amplitude: Fraction

    def __init__(self, amplitude: Exact) -> None:
        object.__setattr__(self, "amplitude", _amplitude(amplitude))

    def draw(self, scene: Scene, words: Words) -> IntArray:
        """The gaps of a sample: the sum of two numbers of discs a contact.

        Parameters
        ----------
        scene : Scene
            The scene.
        words : callable
            So many random words of the sample.

        Returns
        -------
        array of int, shape (contacts,)
            What is added to the initial gaps, in units of `amplitude / UNIT`.
        """
        radius = np.append(_uniform(words(len(scene.discs))), 0)  # end -1 is a support
        a, b = scene.ends
        both: IntArray = -(radius[a] + radius[b])
        return both


def sample_words(seed: int, k: int) -> Words:
    """The random words of sample k of a seed.

    >>> sample_words(7, 0)(2).tolist() == sample_words(7, 0)(2).tolist()
    True
    """
    for name, value in (("the seed", seed), ("the number of a sample", k)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 0:
            raise InputError(name, value, "an integer from 0 on")
    source = np.random.PCG64(np.random.SeedSequence(int(seed), spawn_key=(int(k),)))
    return source.random_raw


def _amplitude(value: Exact) -> Fraction:
    amplitude = rational_of(value, "the amplitude")
    if amplitude < 0:
        raise InputError("the amplitude", amplitude, "a number from 0 on (w tau)")
    return amplitude


def _uniform(words: np.ndarray[tuple[int], np.dtype[np.uint64]]) -> IntArray:
    """Integers from -UNIT up to, and without, UNIT, all of the same probability."""
    return (words >> np.uint64(33)).astype(np.int64) - UNIT


def _normal(words: np.ndarray[tuple[int], np.dtype[np.uint64]]) -> IntArray:
    """The nearest integers to UNIT x, x of the normal distribution cut off at 3.

    x is where the distribution function has the value of a uniform number. Floats say what x is;
    where that is too near the middle of two integers, exact arithmetic says which is nearer.
    """
    from scipy.special import ndtr, ndtri  # slow to import

    odd = 2 * (words >> np.uint64(12)).astype(np.int64) + 1  # odd / 2^53 is uniform in (0, 1)
    least = ndtr(-float(_CUT))
    x: FloatArray = ndtri(least + odd * 2.0**-53 * (1 - 2 * least)) * UNIT
    below = np.floor(x)
    found = np.rint(x).astype(np.int64)
    for i in np.flatnonzero(np.abs(x - below - 0.5) < _NEAR_TIE).tolist():
        found[i] = int(below[i]) + _past(int(odd[i]), 2 * int(below[i]) + 1)
    return found


def _past(odd: int, twice: int) -> bool:
    """Whether the cut-off normal distribution up to twice / (2 UNIT) has less than odd / 2^53."""
    bits = ctx.prec
    ctx.prec = _BITS
    try:
        root = arb(2).sqrt()
        whole = (arb(_CUT) / root).erf()
        part = (arb(twice) / (2 * UNIT) / root).erf()
        # (part + whole) / (2 whole) against odd / 2^53; a tie of the two has probability zero, and
        # an irrational number is never equal to a rational one.
        return bool((part + whole) * 2**52 < whole * odd)
    finally:
        ctx.prec = bits

"""Contact laws: how hard two discs push that overlap.

With x the overlap over c tau, a contact of compliance c pushes with x^k disc weights: k = 1 is
Hooke's law, that of the paper, k = 3/2 that of Hertz for spheres. In both tau is the overlap (in
disc radii) at which a contact of compliance 1 carries one disc weight.

In the limit tau -> 0 a Hertzian pile has other forces than a Hookean one: the forces that minimise
the sum of c f^(1 + 1/k), which is quadratic for Hooke only. They agree where balance alone decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numbers.vectors import FloatArray


@dataclass(frozen=True)
class Law:
    """A contact law: f = x^exponent for x > 0, the overlap over c tau, and nothing for x <= 0.

    Attributes
    ----------
    name : str
        What it is called.
    exponent : float
        1 is Hooke's law, 3/2 that of Hertz.

    Examples
    --------
    >>> HERTZ.force(np.array([-1.0, 4.0])).tolist(), HERTZ.stiffness(np.array([4.0])).tolist()
    ([0.0, 8.0], [3.0])
    """

    name: str
    exponent: float

    def force(self, x: FloatArray) -> FloatArray:
        """The forces of overlaps.

        Parameters
        ----------
        x : array of float
            Overlaps over c tau (w); nothing below zero.

        Returns
        -------
        array of float
            The forces (w).
        """
        return np.asarray(np.maximum(x, 0.0) ** self.exponent)

    def stiffness(self, x: FloatArray) -> FloatArray:
        """df/dx; at x = 0 that of a contact which is just closing.

        Parameters
        ----------
        x : array of float
            Overlaps over c tau (w).

        Returns
        -------
        array of float
            The slopes.
        """
        pressed = np.where(x >= 0, x, 0.0) ** (self.exponent - 1)
        return np.asarray(np.where(x >= 0, self.exponent * pressed, 0.0))

    def energy(self, x: FloatArray) -> FloatArray:
        """The integral of the force over x.

        Parameters
        ----------
        x : array of float
            Overlaps over c tau (w).

        Returns
        -------
        array of float
            The energies over c tau (w^2).
        """
        return self.force(x) * np.maximum(x, 0.0) / (self.exponent + 1)


HOOKE = Law("hooke", 1.0)
"""Hooke's law, that of the paper: f = x."""
HERTZ = Law("hertz", 1.5)
"""The law of Hertz, that of elastic spheres: f = x^(3/2)."""

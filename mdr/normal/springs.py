"""SpringArray: where the springs stand under the indenter and how stiff each one is.

The half-space becomes a row of independent elements dk_z = E* dx, dk_x = G* dx (Popov and Heß 2015). A spring
here stands for the pair at +x and -x, so its width, the weight of a rule of integration, counts twice.

Where they stand is the matter of spring_grid.py: most where springs touch and leave.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to the mean depth [m] (kept in this
form because u_z0 may be many orders larger than du_z), width 2 dx [m].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.normal.resolved import resolved
from mdr.normal.spring_grid import Depths, nodes
from mdr.tools.arrays import Array
from mdr.tools.checks import count
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span

MIN_SPRINGS = 16  #: fewer cannot serve all panels


@dataclass(frozen=True, eq=False, repr=False)
class SpringArray(Summarised, ArrayRecord):
    """Springs of a contact, from the centre outwards; arrays of shape (n_springs,).

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration)
    >>> springs = mdr.SpringArray.of(case, n_springs=64)
    >>> print(f"{springs.normal_force(20e-6, 20e-6):.4f} N, in closed form {case.indenter.force(20e-6, 4e6):.4f} N")
    0.0802 N, in closed form 0.0802 N
    """

    x: Array  #: positions [m]
    gap: Array  #: g(x) - u_z0 [m]
    width: Array  #: weight 2 dx, both sides of the contact [m]
    E_star: float  #: normal modulus [Pa]
    G_star: float  #: tangential modulus [Pa]
    n_core: int  #: the first n_core springs never lose contact

    @classmethod
    def of(cls, case: SlidingContact, n_springs: int = 512) -> SpringArray:
        """The springs of a sliding contact, most of them where they touch and leave.

        Parameters
        ----------
        case : SlidingContact
            The contact.
        n_springs : int
            Springs at x > 0, at least 16; each stands for the pair at +x and -x.

        Returns
        -------
        SpringArray
            The springs, from the centre outwards.

        Raises
        ------
        ValueError
            For fewer than 16 springs.
        """
        return springs_of(resolved(case), count("n_springs", n_springs, MIN_SPRINGS))

    def _summary(self) -> Summary:
        return Summary(
            f"SpringArray of {self.x.size} springs at x > 0, each for the pair at +x and -x",
            [
                ("x", span(self.x, "m"), "positions"),
                ("core", f"{self.n_core} springs", "from the centre, never out of contact"),
                ("dk_z", span(self.dk_z, "N/m"), "normal stiffness of each"),
                ("dk_x", span(self.dk_x, "N/m"), "tangential stiffness of each"),
                ("E*", number(self.E_star, "Pa"), "normal modulus"),
                ("G*", number(self.G_star, "Pa"), "tangential modulus"),
            ],
        )

    @property
    def dk_z(self) -> Array:
        """Normal stiffness of each spring E* 2 dx [N/m]."""
        return self.E_star * self.width

    @property
    def dk_x(self) -> Array:
        """Tangential stiffness of each spring G* 2 dx [N/m]."""
        return self.G_star * self.width

    def normal_stiffness(self, u_z: float, u_z0: float) -> float:
        """Stiffness [N/m] of the springs that reach the surface.

        Parameters
        ----------
        u_z : float
            Depth of the indenter [m].
        u_z0 : float
            Mean depth [m], from which the gaps count.

        Returns
        -------
        float
            Normal stiffness [N/m].
        """
        return float(np.sum(self.dk_z[self.gap < u_z - u_z0]))

    def normal_force(self, u_z: float, u_z0: float) -> float:
        """Elastic force [N] of the springs.

        Parameters
        ----------
        u_z : float
            Depth of the indenter [m].
        u_z0 : float
            Mean depth [m], from which the gaps count.

        Returns
        -------
        float
            Normal force [N].
        """
        return float(np.sum(self.dk_z * np.maximum(u_z - u_z0 - self.gap, 0)))


def springs_of(case: SlidingContact, n_springs: int, cut: float = np.inf) -> SpringArray:
    """What `SpringArray.of` answers. cut: gap [amplitudes] at which the row is cut besides. Up to it springs that never
    lose contact do the same but for their gap, as all of them do where nothing shakes in the plane, no body swings
    back, and their limit of friction follows from it.
    """
    depths = Depths.of(case.cycle, case.kept_gap, cut, case.gap_tells_limit, ordered=not case.is_shaken)
    x, gap, width, n_core = nodes(case.indenter, depths, n_springs)
    return SpringArray(x, gap, width, case.material.E_star, case.material.G_star, n_core)

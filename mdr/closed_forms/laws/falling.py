"""Laws of friction that falls: an elastic spring that keeps contact under a rigid pull, with mu_s above mu_k."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.tools.checks import between, positive

EXACT_TIME = 4e-15  #: of a phase, to which the release is found


class FallingFriction(NamedTuple):
    """Friction of a spring that sticks and is let go."""

    share: float  #: mean friction over that of full slip, mu_k F_N [-]
    periods: int  #: after how many periods it is let go again


def falling_friction(velocity: float, alpha: float, stick: float) -> FallingFriction:
    """Friction of an elastic spring that keeps contact, over that of full slip, where mu_s is above mu_k.

    Lengths in du_z, or mu_k kappa du_z, time in 1/omega, from the instant at which the depth grows fastest: the kinetic
    limit is 1/alpha + sin(t). The foot comes to rest where the limit begins to outrun the pull, cos(tau) = v at
    t = -tau, and the force goes on from there on a straight line, until it is let go::

        1/alpha - sin(tau) + v (t + tau) = (mu_s/mu_k) [1/alpha + sin(t)]

    Then it is mu_k f_z until the next instant at which the foot comes to rest, t = 2 pi n - tau. With t for the first
    solution and theta = t + tau::

        share = 1 + alpha/(2 pi n) [v theta²/2 - theta sin(tau) + cos(t) - cos(tau)],    n = ceil(theta/(2 pi))

    At v -> 1, the critical velocity of Eq. (1) with mu_k, tau = 0: friction is above that of full slip by
    alpha/(2 pi n) [t²/2 - 1 + cos(t)], and falls by as much in a jump there. As v -> 0 the spring is let go in the
    minimum of the load alone: the share is (1 - alpha) (1 + mu_s/mu_k)/2.

    The whole of a flat punch, and of a curved contact those springs that the edge does not reach. A dashpot or arms
    delay the foot that has been let go, which then does not come to rest in each period: there is no jump at v_c, but a
    rise of the number of periods without end, like a logarithm of v_c - v_0.

    Parameters
    ----------
    velocity : float
        v_0/(mu_k kappa omega du_z) [-], above 0.
    alpha : float
        du_z/u_z0 of the spring [-], between 0 and 1, of a harmonic depth.
    stick : float
        mu_s/mu_k [-], at least 1.

    Returns
    -------
    FallingFriction
        The share of friction and the number of periods.

    Examples
    --------
    >>> below = mdr.laws.falling_friction(1.0, alpha=0.4, stick=1.5)
    >>> print(f"{below.share:.6f} after {below.periods} period")
    1.065730 after 1 period
    """
    from scipy.optimize import brentq

    v, mean = positive("velocity", velocity, "v_0/(mu_k kappa omega du_z)"), 1 / between("alpha", alpha, 0.0, 1.0)
    if not 1 <= stick < np.inf:
        raise ValueError(f"stick = {stick!r} must be mu_s/mu_k, at least 1")
    if v > 1:
        return FallingFriction(1.0, 1)
    tau, turn = np.arccos(v), np.arccos(v / stick)  # the margin falls from `turn` to 2 pi - turn, in each period

    def margin(t: float) -> float:
        return float(stick * (mean + np.sin(t)) - (mean - np.sin(tau) + v * (t + tau)))

    k = max(int(np.ceil((margin(-turn) / (2 * np.pi * v)) - 1)), 0)  # the least margin falls by 2 pi v in a period
    first, last = turn + 2 * np.pi * k, 2 * np.pi * (k + 1) - turn
    if margin(last) > 0:  # by rounding
        k, first, last = k + 1, first + 2 * np.pi, last + 2 * np.pi
    t = brentq(margin, first, last, xtol=EXACT_TIME) if margin(first) > 0 else first
    theta = t + tau
    n = max(int(np.ceil(theta / (2 * np.pi))), 1)
    held = v * theta**2 / 2 - theta * np.sin(tau) + np.cos(t) - np.cos(tau)
    return FallingFriction(float(1 + held / (mean * 2 * np.pi * n)), n)

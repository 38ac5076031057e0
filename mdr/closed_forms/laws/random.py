"""Laws of a contact whose depth vibrates at random, under a rigid pull.

The pull takes up a depth at the rate c = v_0/(mu_0 kappa). What a spring lags behind full slip, in units of its depth,
is D = max over theta >= 0 of zeta(t) - zeta(t - theta) - c theta, zeta the random part of the depth: the content of a
queue that is fed by zeta' and served at the rate c. Friction falls short of mu_0 F_N by mu_0 k_zc times the mean of D.

Symbols: b = c/sigma_v, sigma, sigma_v, sigma_a rms of zeta, zeta', zeta'', m_k moments of the spectrum.
"""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import ABOVE_ZERO, COULOMB, GIVEN_DEPTH, NO_ARMS, NO_SHAKE, RIGID, holds_for
from mdr.case.motion import NormalOscillation
from mdr.case.spectrum import Spectrum
from mdr.closed_forms.rigid_pull import average_friction
from mdr.indenters.flat_punch import FlatPunch
from mdr.materials.kelvin_voigt import KelvinVoigt
from mdr.tools.checks import between, instance, not_negative, positive


def random_loss(b: float, T: float = 0.0) -> float:
    """Mean lag [-] of a fast pull, in units of sigma_v²/sigma_a: friction that random vibration takes.

    psi(v_0/v_c) is the lag of a sine over its amplitude. A narrow band is a sine of slowly varying Rayleigh amplitude::

        integral over x > b of x² exp(-x²/2) psi(b/x)

    This is the law of any spectrum at high velocity too: excursions of zeta' above c are the tips of such sines. To
    leading order, elastic, they give (9/(2 pi)) exp(-b²/2)/b³. A spectrum of the spread s = m_2 m_6/m_4² - 1, see
    `mdr.Spectrum.spread`, loses more by a share that tends to 0.6 s/b²: the law holds to some 3 % for b² > 20 s, of a
    material with T < 1 [random_vibration]. There is no critical velocity, as no amplitude is the greatest.

    Parameters
    ----------
    b : float
        Velocity v_0/(mu_0 kappa sigma_v) [-], above 0. Slower than b² = 20 s the loss is larger, see
        `slow_random_loss`.
    T : float
        Loss tangent tau sigma_a/sigma_v of a Kelvin material [-], 0 for an elastic one.

    Returns
    -------
    float
        Mean of D over sigma_v²/sigma_a [-].

    Examples
    --------
    >>> print(f"{mdr.laws.random_loss(2.0):.4f}")
    0.0111
    """
    b, T = positive("b", b, "v_0/(mu_0 kappa sigma_v)"), not_negative("T", T, "tau sigma_a/sigma_v")
    if b >= 38.0:  # the loss is below the least float
        return 0.0
    node, weight = np.polynomial.legendre.leggauss(64)
    # amplitudes beyond 9 rms above b are left out; for b > 5 beyond that share of 5/b
    most = np.sqrt(9.0 / max(1.0, b / 5))
    root = most * (node + 1) / 2  # psi begins with a power of x - b, 2 or 3/2
    x = b + root**2
    alpha = 1e-3 / np.hypot(1, T)  # of a sine on a flat punch, which keeps contact
    case = SlidingContact(FlatPunch(1.0), KelvinVoigt(1.0, 0.5, T), 1.0, NormalOscillation(1.0, alpha, 1.0))
    psi = (1 - average_friction(case, case.unit_velocity * b / x).cof) / alpha
    return float(most / 2 * weight @ (2 * root * x**2 * np.exp(-(x**2) / 2) * psi))


def slow_random_loss(b: float) -> float:
    """Mean lag [-] of a slow pull, in units of sigma: it grows without end as the pull becomes slower.

    Depths below -sigma h + c theta at times theta ago are rare and independent, so that none has been there with the
    probability::

        F(h) = Phi(h) exp(-Phi(-h)/(b sqrt(2 pi)))

    Phi the normal distribution, and the lag is the mean of h. It grows like sqrt(2 log(1/b)): there is no static
    friction, but at last a contact that is lost. Elastic; of the spectrum sigma and sigma_v alone matter, if it is not
    narrow [random_vibration].

    Parameters
    ----------
    b : float
        Velocity v_0/(mu_0 kappa sigma_v) [-]. Within 3 % for 0.003 < b < 0.03 and a flat band wider than half of its
        greatest frequency; a narrow band lags less, one of a fifth by 10 to 20 %.

    Returns
    -------
    float
        Mean of D over sigma [-].

    Examples
    --------
    >>> print(f"{mdr.laws.slow_random_loss(0.01):.3f}")
    2.164
    """
    from scipy.special import ndtr

    b = positive("b", b, "v_0/(mu_0 kappa sigma_v)")
    h = np.linspace(-40, 40, 16001)
    not_above = ndtr(h) * np.exp(-ndtr(-h) / (b * np.sqrt(2 * np.pi)))
    return float(np.trapezoid(np.heaviside(h, 0.5) - not_above, h))


def random_end(share: float, T: float = 0.0) -> float:
    """Velocity b [-] at which so much of friction's loss is left: it stands where sines have a critical velocity.

    The loss of `random_loss` over its limit at rest, sqrt(pi/2), the mean of Rayleigh amplitudes [random_vibration].

    Parameters
    ----------
    share : float
        What is left [-], between 1e-9 and 0.9.
    T : float
        Loss tangent tau sigma_a/sigma_v of a Kelvin material [-], 0 for an elastic one.

    Returns
    -------
    float
        v_0/(mu_0 kappa sigma_v) [-].

    Examples
    --------
    >>> [round(mdr.laws.random_end(share), 2) for share in (0.1, 0.01, 0.001)]
    [1.09, 1.96, 2.67]
    """
    from scipy.optimize import brentq

    share = between("share", share, 1e-9, 0.9, "of the loss at rest")
    left = np.sqrt(np.pi / 2) * share
    return float(brentq(lambda b: np.log(random_loss(b, T) / left), 1e-4, 8.0, xtol=1e-10))


@holds_for(COULOMB, RIGID, NO_SHAKE, NO_ARMS, GIVEN_DEPTH, ABOVE_ZERO, instead="random_cof")
def random_friction(case: SlidingContact, spectrum: Spectrum, v_0: float) -> float:
    """Friction [-] of a fast pull over a depth that vibrates at random: mu_0 (1 - k_zc D/F_N), D of `random_loss`.

    Exact for a flat punch as far as its range goes, of first order in sigma/u_z0 for curved shapes; contact kept
    [random_vibration].

    Parameters
    ----------
    case : SlidingContact
        The contact, elastic or Kelvin; its oscillation gives way to the spectrum.
    spectrum : Spectrum
        Power density of the depth.
    v_0 : float
        Pulling velocity [m/s], above 0.

    Returns
    -------
    float
        Mean F_x over mean F_z [-].

    Raises
    ------
    TypeError, ValueError
        For a body, a shake in the plane, a material of Maxwell arms, a mean depth that is not positive, and an rms
        above a third of it.

    Examples
    --------
    >>> steady = mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=600.0)  # its mean depth alone matters
    >>> case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, steady)
    >>> rough = mdr.Spectrum.band(rms=4e-6, f_low=50.0, f_high=150.0)
    >>> print(round(mdr.laws.random_friction(case, rough, 2e-3), 3))
    0.487
    """
    instance("spectrum", spectrum, Spectrum)
    v_0, depth = positive("v_0", v_0, "in m/s"), case.cycle.u_z0
    if not spectrum.rms <= 1 / 3 * depth:  # above, contact is lost now and then
        raise ValueError(
            f"the rms of the spectrum, {spectrum.rms:.4g} m, is more than a third of the mean depth of {depth:.4g} m: "
            "the contact is lost now and then, which the law leaves out; use random_cof"
        )
    velocity, acceleration = spectrum.rms_velocity, spectrum.rms_acceleration
    b = v_0 / (case.mu_0 * case.material.mindlin_ratio * velocity)
    lag = velocity**2 / acceleration * random_loss(b, case.material.tau * acceleration / velocity)
    return float(case.mu_0 * (1 - case.k_zc * lag / case.indenter.force(depth, case.material.E_star)))

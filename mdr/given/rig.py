"""From a rig to a case: what is set and read at an experiment, turned into the fields of a `SlidingContact`.

Rigs have a load, a frequency in hertz, a loss tangent and a sled; a case has a depth, an angular frequency, a
relaxation time, and one mass for each direction.
"""

from __future__ import annotations

import math

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.doubts import edge, wavelength
from mdr.case.friction import Friction, law_of
from mdr.case.in_plane import Shake
from mdr.case.motion import ConstantLoad, LoadOscillation, Motion, NormalOscillation
from mdr.case.paths import HOLD, SET, hold_of
from mdr.case.pull import Pull, RigidPull, SpringPull
from mdr.given.vary import contact_of, warn_of_load
from mdr.indenters.base import Indenter
from mdr.materials import Elastic, KelvinVoigt, Material
from mdr.normal.normal_force import normal_force
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.arrays import SAME
from mdr.tools.checks import instance, not_negative, positive, truth
from mdr.tools.keywords import offering
from mdr.tools.notation import GRAVITY
from mdr.tools.warned import warn_outside


@offering
def rig(
    indenter: Indenter,
    material: Material,
    mu_0: float | None = None,
    *,
    tau_0: float = 0.0,
    mu_s: float | None = None,
    friction: Friction | None = None,
    frequency: float,
    load: float | None = None,
    load_grams: float | None = None,
    load_amplitude: float | None = None,
    depth_amplitude: float | None = None,
    acceleration: float | None = None,
    support_acceleration: float | None = None,
    tan_delta: float | None = None,
    k_x: float | None = None,
    m: float | None = None,
    c_x: float = 0.0,
    load_rides: bool | None = None,
    shake: Shake | None = None,
    hold: str | None = None,
    density: float | None = None,
) -> SlidingContact:
    """The contact that a rig makes, from what is set and read at it.

    Parameters
    ----------
    indenter : Indenter
        The shape; a measured one is a `SampledProfile`.
    material : Material
        The half-space.
    mu_0 : float, optional
        Coefficient of friction without vibration [-]; give it or `friction`.
    tau_0 : float
        Shear strength of the face besides [Pa].
    mu_s : float, optional
        Static coefficient of friction [-], where it is above mu_0; see `StaticKinetic`.
    friction : Friction, optional
        The law of friction, in the place of mu_0, tau_0 and mu_s.
    frequency : float
        Frequency of the vibration [Hz], not the angular one.
    load, load_grams : float
        Load [N], or the mass [g] whose weight it is. Give one. With an amplitude of the load, or a shake alone, it is
        the mean load. With an amplitude of depth or acceleration it is what `hold` says.
    load_amplitude, depth_amplitude, acceleration, support_acceleration : float, optional
        What the normal vibration is set to; give one, or none where `shake` moves the contact in the plane alone.
        Amplitude of the load [N]; amplitude of the depth [m]; amplitude of the acceleration of the indenter against
        the half-space [m/s²], which is (2 pi frequency)² times that of the depth; or amplitude of the acceleration
        [m/s²] of a support, such as a shaken table, on which the one body stands and the other, a mass, lies by its
        weight: its normal force is m (g + a) well below the resonance of the mass on the contact. Greatest upwards at
        t = 0.
    tan_delta : float, optional
        Loss tangent [-] at this frequency. It turns an `Elastic` material, whose E then is the storage modulus, into
        the `KelvinVoigt` material that has it.
    k_x : float, optional
        Stiffness of the spring that pulls [N/m]. None: a rigid pull.
    m : float, optional
        Mass of the sled [kg]; must be given with k_x, 0 for a body without inertia. Under a rigid pull it is of use
        for a load that rides on it alone.
    c_x : float
        Damping beside the spring [N s/m].
    load_rides : bool, optional
        Whether an oscillating load presses on the sled, so that the sled's mass moves in the normal direction too. Must
        be said where there are both, and only there. `load` then is all that presses, the weight of the sled included.
        On a shaken support: whether all that presses is a mass that lies on it, which is so unless a sled of another
        weight is given; False is a sled of mass m that a soft spring presses on.
    shake : InPlaneOscillation or InPlaneMotion, optional
        Motion in the plane besides the pull; where nothing else vibrates, at this frequency.
    hold : {None, "depth", "load"}
        What stays with an amplitude of depth or acceleration: "depth", about which a stiff drive moves, where the load
        rests without vibration; or "load", of a weight that rides on a piezo, the mean load. None is "depth", and warns
        where the mean load is more than 1 % above the load.
    density : float, optional
        Density [kg/m³] of the half-space. With it a vibration is warned of whose shear waves are not much longer than
        the contact, as the springs are quasi-static.

    Returns
    -------
    SlidingContact
        The contact. With an amplitude of the load, or of a support, a `LoadOscillation`; with one of depth or
        acceleration, a `NormalOscillation` about the depth that `hold` asks for; with none, a `ConstantLoad`.

    Raises
    ------
    TypeError
        For a part of a wrong kind, and for `tan_delta` with a material that has a loss tangent of its own.
    ValueError
        Where something is missing, given twice, or refused by its rule; and for a load the shape does not carry.

    Notes
    -----
    As force grows faster than depth, the mean force about the depth at which the load rests is larger than the load: of
    an elastic ball by 4 % at du_z = 0.44 u_z0 and by 20 % at du_z = u_z0. The depth at rest belongs to this shape and
    this material: where they vary, give `mdr.sweep`, `mdr.find`, `mdr.tolerance` or `mdr.fit` ``held={"load": ...}``,
    and for the mean load ``held={"load": ..., "hold": "load"}``.

    Examples
    --------
    >>> import mdr
    >>> ball, rubber = mdr.Sphere(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.rig(
    ...     ball, rubber, 0.8, frequency=50, load_grams=300, load_amplitude=0.1, tan_delta=0.2,
    ...     k_x=5e3, m=0.2, load_rides=True,
    ... )
    >>> case.oscillation
    LoadOscillation(F_z0=2.941995, dF_z=0.1, omega=314.1592653589793, m_z=0.2)
    >>> print(f"{mdr.critical_velocity(case):.3g} m/s")
    0.00215 m/s
    """
    omega = SET["frequency"].told("frequency", frequency)
    material = _lossy(material, tan_delta, omega)
    instance("indenter", indenter, Indenter)
    F_z0 = _load(load, load_grams)
    given = {
        "load_amplitude": load_amplitude, "depth_amplitude": depth_amplitude, "acceleration": acceleration,
        "support_acceleration": support_acceleration,
    }  # fmt: skip
    amplitudes = {
        name: positive(name, value, "leave it out for a shake alone")
        for name, value in given.items()
        if value is not None
    }
    if len(amplitudes) > 1:
        raise ValueError(f"{' and '.join(amplitudes)} are given: give one of them, the others follow")
    held = {} if hold is None else {HOLD: hold_of(hold)}
    by_force = load_amplitude is not None or support_acceleration is not None
    if held and (by_force or not amplitudes):
        raise ValueError("hold is about a driven depth: give depth_amplitude or acceleration too, or leave it out")
    pull = _pull(k_x, m, c_x)
    if load_rides is not None:
        truth("load_rides", load_rides)
    if support_acceleration is None:
        m_z = _moved_by_load(m, load_rides, load_amplitude is not None, k_x is None, F_z0)
    else:
        m_z = _on_support(m, load_rides, F_z0)
    if not amplitudes and (shake is None or not math.isclose(shake.omega, omega, rel_tol=SAME)):
        raise ValueError(
            f"nothing vibrates at the frequency of {frequency:.6g} Hz: give one of {', '.join(given)}, or a shake in "
            f"the plane with omega = 2 pi frequency = {omega:.9g} rad/s"
        )
    motion: Motion = ConstantLoad(F_z0)
    if support_acceleration is not None:
        motion = LoadOscillation(F_z0, m_z * support_acceleration, omega, m_z)
    elif load_amplitude is not None:
        motion = LoadOscillation(F_z0, load_amplitude, omega, m_z)
    elif amplitudes:
        du_z = amplitudes.get("depth_amplitude") or amplitudes["acceleration"] / omega**2
        motion = NormalOscillation(0.0, du_z, omega)
    parts = {
        "indenter": indenter, "material": material, "friction": law_of(friction, mu_0, tau_0, mu_s),
        "oscillation": motion, "pull": pull, "shake": shake,
    }  # fmt: skip
    settings = {"load": F_z0, **held}
    case = contact_of(parts, settings)
    way_out = ""
    if acceleration is not None:
        way_out = "; for the acceleration of what a weight stands on, a shaken table, give it as support_acceleration"
        _warn_of_drive(case, F_z0 / GRAVITY * acceleration, way_out if held else "")
    warn_of_load(settings, case, way_out=way_out)
    if density is not None:
        _warn_of_waves(case, positive("density", density, "in kg/m³"))
    return case


def _lossy(material: Material, tan_delta: float | None, omega: float) -> Material:
    """The material with this loss tangent at omega."""
    instance("material", material, Material)
    if tan_delta is None:
        return material
    if not isinstance(material, Elastic):
        raise TypeError(
            f"tan_delta turns an Elastic material into one with that loss tangent, and {material!r} has its own: give "
            "Elastic(E, nu) with E the storage modulus, or leave tan_delta out"
        )
    return KelvinVoigt.from_loss_tangent(E=material.E, nu=material.nu, tan_delta=tan_delta, omega=omega)


def _load(load: float | None, load_grams: float | None) -> float:
    """The load [N]."""
    if (load is None) == (load_grams is None):
        raise ValueError("give the load once: load in N, or load_grams, the mass in g whose weight it is")
    if load is not None:
        return SET["load"].checked("load", load)
    return 1e-3 * GRAVITY * positive("load_grams", load_grams, "in g")


def _pull(k_x: float | None, m: float | None, c_x: float) -> Pull:
    if k_x is not None and m is None:
        raise ValueError("m is missing: give the mass of the sled in kg, or m=0 for a body without inertia")
    if k_x is None and not_negative("c_x", c_x, "in N s/m") > 0:
        raise ValueError("c_x is the damper beside a spring: give k_x in N/m too, or leave c_x out for a rigid pull")
    return RigidPull() if k_x is None else SpringPull(k_x, m, c_x)  # type: ignore[arg-type]


def _moved_by_load(m: float | None, rides: bool | None, oscillates: bool, is_rigid: bool, F_z0: float) -> float:
    """The mass [kg] that moves in the normal direction."""
    moved = not_negative("m", m, "mass in kg") if m is not None else 0.0
    if rides is not None and not oscillates:
        raise ValueError("load_rides is about an oscillating load: give load_amplitude too, or leave it out")
    if rides and moved == 0:
        raise ValueError("load_rides=True: give the mass m of the sled on which the load rides, in kg")
    if oscillates and moved > 0 and rides is None:
        raise ValueError(
            f"does the oscillating load press on the sled of m = {moved:.6g} kg? Say load_rides=True, and the sled "
            "moves in the normal direction with its mass, or load_rides=False, and the load moves no mass"
        )
    if is_rigid and moved > 0 and not rides:
        raise ValueError("m has no effect under a rigid pull: give k_x in N/m too, or leave m out")
    if rides and moved * GRAVITY > F_z0:
        warn_outside(
            f"the weight of the sled, {moved * GRAVITY:.4g} N, is more than the load of {F_z0:.4g} N that rides on it: "
            "the load is all that presses, the weight of the sled included"
        )
    return moved if rides else 0.0


def _on_support(m: float | None, rides: bool | None, F_z0: float) -> float:
    """The mass [kg] that lies on a shaken support."""
    weighs, moved = F_z0 / GRAVITY, not_negative("m", m, "mass in kg") if m is not None else 0.0
    if rides is False:
        return positive("m", moved, "mass in kg of the sled that lies on the support; or load_rides=True")
    if rides is None and moved > 0 and not math.isclose(moved, weighs, rel_tol=0.01):
        raise ValueError(
            f"the load is the weight of {weighs:.6g} kg, and the sled has m = {moved:.6g} kg: say load_rides=True "
            "where all that presses lies on the support, or load_rides=False where a soft spring presses the sled"
        )
    return weighs


def _warn_of_drive(case: SlidingContact, inertia: float, way_out: str) -> None:
    """Warn of a weight that is said to ride on a driven depth whose force is not that of its inertia [N]."""
    force = normal_force(known := resolved(case), np.linspace(0, 2 * np.pi, 64)) if way_out else np.zeros(1)
    if (swing := float(np.ptp(force)) / 2) > 2 * inertia:
        warn_outside(
            f"acceleration= is that of the indenter against the half-space: a depth of +-{known.cycle.du_z:.3g} m "
            f"takes a drive of +-{swing:.3g} N, and the weight has +-{inertia:.3g} N at that acceleration{way_out}"
        )


def _warn_of_waves(case: SlidingContact, density: float) -> None:
    """Warn where shear waves in the half-space are not much longer than the contact is wide."""
    known = at_rest(case)
    width, longest = 2 * edge(known.indenter, known.working_depth)[0], wavelength(known, density)
    if longest < 10 * width:
        warn_outside(
            f"shear waves in the half-space are about {longest:.3g} m long at this frequency, and the contact is "
            f"{width:.3g} m wide: the springs are quasi-static, which wants waves 10 times as long"
        )

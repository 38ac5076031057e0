"""The case whose depth is known: `resolved` solves for the depth under a load, once.

A SlidingContact computes its properties from its fields. Under a load the depth is no field: it follows from
shape, material and load (load_control.py). `resolved` puts it there, as a `DepthUnderLoad`; every function that needs
the depth does this first, so that it takes either case, and there a user is warned of what is unlikely (doubts.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from mdr.case.contact import SlidingContact, require_case
from mdr.case.depth_cycle import Cycle
from mdr.case.doubts import doubts_of
from mdr.case.motion import ConstantLoad, LoadOscillation, Motion
from mdr.indenters.base import Indenter
from mdr.materials.base import Material
from mdr.normal.load_control import depth_under_load, static_depth
from mdr.normal.stability import doubts_of_load
from mdr.tools.memoise import remembered
from mdr.tools.warned import asked_from_outside, warn_outside


@dataclass(frozen=True)
class DepthUnderLoad(Motion):
    """The depth that a load brings about, for one shape on one material."""

    load: LoadOscillation | ConstantLoad = field()  #: what imposes it
    indenter: Indenter = field(repr=False)  #: shape that it was solved for
    material: Material = field(repr=False)  #: half-space that it was solved for
    u_z_rest: float  #: depth at which the mean load rests [m]
    depth: Cycle | None = field(repr=False)  #: over one period; None where only the rest was asked for

    @property
    def omega(self) -> float:
        """Angular frequency of the load [rad/s], zero of a constant one."""
        return self.load.omega

    @property
    def knows_depth(self) -> bool:
        """Whether it was solved for the whole period."""
        return self.depth is not None

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return self.load.cycle if self.depth is None else self.depth

    @property
    def working_depth(self) -> float:
        """Depth [m] at which the mean load rests, to which stiffnesses belong."""
        return self.u_z_rest

    def on(self, indenter: Indenter, material: Material) -> Motion:
        """Itself on the contact that it was solved for; on any other one the load, to be solved for anew."""
        return self if indenter is self.indenter and material is self.material else self.load


def resolved(case: SlidingContact) -> SlidingContact:
    """The contact with its depth [m] known, so that all its properties answer.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    SlidingContact
        The contact itself if its depth is prescribed, or resolved already. Under a load its oscillation is the depth
        that the load brings about. `dataclasses.replace` with another shape or material puts the load back.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        If the shape does not carry the load, or if no periodic depth is found: beside a resonance of the mass m_z, or
        where the mass bounces in another rhythm.

    Examples
    --------
    >>> import mdr
    >>> load = mdr.LoadOscillation(F_z0=0.05, dF_z=0.01, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, oscillation=load)
    >>> print(f"{mdr.resolved(case).working_depth:.3g} m")
    2.6e-05 m
    """
    known = with_depth(case)
    _warn(known)
    return known


def with_depth(case: SlidingContact, moving: bool = True) -> SlidingContact:
    """The same without a warning of what is unlikely; moving: over the whole period, not at rest alone."""
    load, depth = _load_of(case), None
    if load is None:
        return case
    rest = _rests_at(case.indenter, case.material, load.F_z0)
    if moving and isinstance(load, LoadOscillation):
        depth = depth_under_load(case.indenter, case.material, load)
    elif moving:
        depth = Cycle.constant(rest)
    return replace(case, oscillation=DepthUnderLoad(load, case.indenter, case.material, rest, depth))


def plausibility(case: SlidingContact) -> tuple[str, ...]:
    """What is unlikely of a contact, in words: most often a unit is wrong.

    Functions that are given such a contact warn of the same with a `PlausibilityWarning`, which
    ``warnings.simplefilter("ignore", mdr.PlausibilityWarning)`` silences; they compute all the same.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    tuple of str
        One sentence for each doubt, empty where there is none.

    Raises
    ------
    ValueError
        If the shape does not carry the load, or no periodic depth under it is found.

    Notes
    -----
    Limits are pure numbers: slope of the shape at the edge of contact and depth over contact radius (1),
    du_z/u_z0 (5), mu_0 (2), omega tau of a Kelvin body (5), stiffness of the spring over that of the contact (1e4)
    and the other way round (1e6), natural frequency of the body over that of the vibration (100). Of a mass that a load
    moves: Floquet multiplier of the depth (1), and the error of the closed form beside its resonance (0.03). A case
    file is warned of too that leaves out a mass: m of [pull], or m_z of a load that may ride on the body.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=2e-6, du_z=20e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Sphere(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, vibration)
    >>> for doubt in mdr.plausibility(case):
    ...     print(doubt)
    the amplitude of the depth is 10 times the mean depth ...
    """
    return _doubts_of(with_depth(case))


@remembered(maxsize=64)
def _doubts_of(known: SlidingContact) -> tuple[str, ...]:
    return (*doubts_of(known), *doubts_of_load(known))


def _warn(known: SlidingContact) -> None:
    """Warn of what is unlikely of a case of known depth, where code outside the package asked for it.

    Called by what a public function calls first; warned of is the line that called the public function. What the
    package asks itself, such as each point of a study, is not looked at.
    """
    for doubt in _doubts_of(known) if asked_from_outside() else ():
        warn_outside(doubt)


def at_rest(case: SlidingContact) -> SlidingContact:
    """The case that knows at least the depth at which its mean load rests, and with it its stiffness.

    For what needs no more: a case of prescribed depth as it is; under a load, no periodic motion is sought.
    Raises ValueError where the shape does not carry the load.
    """
    known = with_depth(case, moving=False)
    _warn(known)
    return known


def _load_of(case: SlidingContact) -> LoadOscillation | ConstantLoad | None:
    """The load whose depth is still to be found; None where the depth is known."""
    motion = require_case(case).oscillation
    if motion.knows_depth:
        return None
    load = motion.load or motion
    if not isinstance(load, LoadOscillation | ConstantLoad):
        raise TypeError(
            f"the depth under {motion!r} cannot be found: give a LoadOscillation, a ConstantLoad, or a motion of known "
            "depth"
        )
    return load


_rests_at = remembered(maxsize=256)(static_depth)

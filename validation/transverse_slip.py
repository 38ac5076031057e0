"""Slip across the pull: what it does to friction, with coupling and without.

Springs slip along the pull only, and so do Cattaneo's and Mindlin's contacts. In three dimensions tractions along x
shift the surface along y as well, for nu > 0, and with coupling the radial rubbing of the contact has a part across the
pull. To see what that does the judge is run once as it is, and once with tractions and slip along the pull only.
"""

from dataclasses import dataclass, replace
from functools import cache

import mdr
from mdr.closed_forms.coupling import radial_rub
from mdr.half_space.friction import Settings, in_three_dimensions
from validation.cases import contact
from validation.figures import COLOURS, figure
from validation.half_space.springs import of_springs
from validation.report import Check, Checks, Claim, told
from validation.words import listed, number, span

ALPHA, FRICTION = 0.3, 0.3
VELOCITIES = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 2.0)  # over Eq. (1)
POISSON = (0.15, 0.3, 0.5)
CHECKED = 0.6  # v_0/v_c at which errors are looked for
SETTINGS = Settings(cells=21, steps=32, cycles=4, settled=1e-3)


@dataclass(frozen=True)
class Losses:
    """What springs are too high by, over mu_0, against three dimensions, and against slip along the pull only."""

    nu: float
    v: float
    coupled: float
    along: float  #: coupled, without slip across
    uncoupled: float
    uncoupled_along: float

    @property
    def by_coupling(self) -> float:
        """What slip across adds to the loss with coupling."""
        return self.coupled - self.along

    @property
    def by_itself(self) -> float:
        """What slip across changes without coupling."""
        return self.uncoupled - self.uncoupled_along


def rub(nu: float) -> float:
    """Lambda of validation/end_of_stick.py: stick ends at about 1 + lambda."""
    return radial_rub(contact("paraboloid", ALPHA, mu_0=FRICTION, nu=nu))


@cache
def losses(nu: float, v: float, settings: Settings) -> Losses:
    """The four of one contact."""
    case = contact("paraboloid", ALPHA, mu_0=FRICTION, nu=nu)
    v_0 = v * mdr.critical_velocity(case)
    springs = of_springs(case, v_0, settings).cof
    runs = (replace(settings, coupled=c, transverse=t) for c in (True, False) for t in (True, False))
    return Losses(nu, v, *((springs - in_three_dimensions(case, v_0, one).cof) / FRICTION for one in runs))


def errors(settings: Settings) -> dict[str, float]:
    """By how much half of the steps and half of the cells change the loss and its parts, together; at one point."""
    coarser = replace(settings, steps=settings.steps // 2), replace(settings, cells=(settings.cells + 1) // 2)
    here, *others = (losses(0.3, CHECKED, one) for one in (settings, *coarser))
    names = ("coupled", "by_coupling", "by_itself")
    return {name: sum(abs(getattr(here, name) - getattr(other, name)) for other in others) for name in names}


def claim(effort: str) -> Claim:
    """Slip across the pull does not change friction noticeably

    How: Run with and without slip across the pull.

    Range: paraboloid, ν = {nus}, μ_0 = {FRICTION}, Δu_z/u_z0 = {ALPHA}, v_0/v_c = {listed_velocities};
    {settings.cells}² cells, {settings.steps} steps a period; at ν = 0.3 and {CHECKED:g} v_c half the steps and half the
    cells change the losses by up to {error[coupled]:.0e}, what slip across does with coupling by
    {error[by_coupling]:.0e} and without by {error[by_itself]:.0e}

    Measured: Without coupling, to forbid slip across the pull changes the COF by at most {itself:.0e} of μ_0: what
    Cattaneo and Mindlin leave out does no harm. With coupling, the loss against the springs has two parts. At
    {below_v_c} v_c up to {most_percent:.0f} % of it come from slip across the pull; the rest would be there without, as
    the leading and the trailing half are rubbed along the pull in opposite senses. Above the end of stick all of it is
    slip across the pull, which turns friction aside: with slip along the pull only, friction there is full.

    Verdict: holds if β = 0

    Sentence: Without coupling slip across changes the COF of a paraboloid by {by_itself} of μ_0 at most; with it, it
    makes a part of the loss below v_c and all of it above the end of stick.
    """
    quick = effort == "quick"
    settings = replace(SETTINGS, cells=15, steps=24) if quick else SETTINGS
    velocities = (0.6, 1.6) if quick else VELOCITIES
    found = [losses(nu, v, settings) for nu in (POISSON[1:2] if quick else POISSON) for v in velocities]
    itself = max(abs(one.by_itself) for one in found)
    some = [one for one in found if one.nu < 0.5 and 0.3 < one.v < 0.9]
    below = [one.by_coupling / one.coupled for one in some]
    error = errors(settings)
    nus, listed_velocities = listed(sorted({one.nu for one in found})), listed(velocities)
    below_v_c = span([one.v for one in some])
    most_percent = 100 * max(below)
    by_itself = number(itself, 1)
    return Claim(**told(claim, locals()), checks=_checks(found), figures=(_figure(found),))


def _checks(found: list[Losses]) -> Checks:
    itself = max(abs(one.by_itself) for one in found)
    beyond = [one for one in found if one.nu < 0.5 and one.v > 1 + rub(one.nu)]
    alone, both = max(one.along for one in beyond), min(one.coupled for one in beyond)
    below = [one.by_coupling / one.coupled for one in found if one.nu < 0.5 and 0.3 < one.v < 0.9]
    why, of_two = "of the order of the square of ν/(4 − 2ν) and less", "two parts of one order"
    yield Check.at_most(f"uncoupled: greatest change of μ/μ_0 by slip across, {len(found)} runs", itself, 3e-4, why)
    yield Check.at_most("above the end of stick: loss without slip across, over μ_0", alone, 1e-6, "full slip along x")
    yield Check.at_least("above the end of stick: loss with it, over μ_0", both, 5e-4, "friction turned aside")
    yield Check.between("least share of the loss by slip across, 0.4 to 0.8 v_c", min(below), 0.2, 0.8, of_two)
    yield Check.between("greatest such share", max(below), 0.2, 0.8, of_two)


@figure("loss", size=(6.4, 4.0))
def _figure(fig, ax, found: list[Losses]):
    """Curves of the loss of friction against velocity, full above dashed, dotted at zero.

    What springs are too high by. Full: three dimensions. Dashed: with tractions and slip along the pull only, which
    stays below and ends with stick; the tail above about (1 + λ) v_c is friction turned aside by radial slip. Dotted,
    on the axis: without coupling, where transverse slip alone does nothing.
    """
    few = len({one.v for one in found}) < 3  # no line through two points
    for nu, colour in zip(sorted({one.nu for one in found if one.nu < 0.5}), COLOURS, strict=False):
        own = [one for one in found if one.nu == nu]
        v = [one.v for one in own]
        for of, mark, line, label in (
            ("coupled", "o", "-", rf"$\nu = {nu:g}$"),
            ("along", "s", "--", "the same, slip along the pull only"),
            ("uncoupled", "x" if few else "", ":", "the same, without coupling"),
        ):
            look = {"marker": mark, "ls": "" if few else line, "mfc": colour if of == "coupled" else "w"}
            ax.plot(v, [getattr(one, of) for one in own], color=colour, label=label, **look)
    ax.set(xlabel="$v_0$ over Eq. (1)", ylabel=r"(springs $-$ 3D)/$\mu_0$")
    ax.legend()
    return few and (
        "What springs are too high by, at one velocity below v_c and one above the end of stick. Dots: three"
        " dimensions. Squares: with tractions and slip along the pull only, less below and nothing above. Crosses:"
        " without coupling."
    )

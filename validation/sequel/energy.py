"""Who pays for less friction: the account of energy of three directions of vibration (section 4 of the later paper).

All energies are over mu_0 F_N v_0 in a period, what sliding without vibration takes. Efficiency is friction lowered,
1 - COF/mu_0, over the work of the oscillator.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

import mdr
from mdr.tools.arrays import Array
from validation.cases import BODY, OMEGA, contact, loss, reach, shaken
from validation.figures import COLOURS, figure
from validation.report import Check, Checks, Part, told

MU_0 = 0.5
RATE = 0.3  #: v_0 over mu_0 kappa omega u_z0
WAYS = ("normal", "along", "across")
SIZES = {"normal": np.linspace(0.35, 0.95, 7), "along": np.linspace(0.35, 1.6, 11), "across": np.geomspace(0.35, 4, 6)}
TIMES = (0.0, 0.05, 0.2, 1.0)  #: omega tau
LESS = 0.3  #: of mu_0, by which friction is lowered where directions are compared


class Account(NamedTuple):
    """A run in these units."""

    lowered: float  #: 1 - COF/mu_0
    pull: float
    oscillator: float
    lost: float  #: all that becomes heat
    least_slip: float  #: in contact, over v_0; below zero where a spring slips back


def part(effort: str) -> Part:
    """Energy

    How: Accounts of the directions over their amplitudes.

    Range: {names}, elastic and ωτ = {times} (and a body), v_0 = {RATE:g} μ_0 κ ω u_z0; amplitudes that lower friction
    by up to {most:.2f} of μ_0.

    Measured: Elastic: a normal oscillation supplies no work in the mean, and all dissipation falls with friction.
    Along, the oscillator supplies exactly what the pull is spared, as long as no spring slips back: each has its v_0 of
    slip, at μ_0 times its load. Where springs slip back, so with large amplitudes and at the edge of curved faces, more
    is dissipated than without vibration. Across more always is, as the way of slip is longer. So the order normal,
    along, across holds for elastic contacts. On a viscous one the normal oscillation works on the dashpots of all
    springs. From ωτ of about 0.1 on it takes more than one along, and with ωτ = 1 more than one across: to lower the
    friction of a punch by {LESS:g} of μ_0 takes {rubber[normal]:.1f} of what sliding takes, along {rubber[along]:.2f},
    across {rubber[across]:.1f}.

    Sentence: Elastic: normal vibration takes no power, along what the pull is spared, across more. With ωτ = 1 the
    order is along, across, normal.
    """
    quick = effort == "quick"
    shapes = ("flat punch",) if quick else ("flat punch", "paraboloid")
    found = {(shape, T, way): curve(shape, T, way) for shape in shapes for T in (0.0, 1.0) for way in WAYS}
    found |= {("flat punch", T, way): curve("flat punch", T, way) for T in TIMES[1:-1] for way in WAYS[:2]}
    most = max(one.lowered for accounts in found.values() for one in accounts)
    at = {key: cost(one) for key, one in found.items()}
    rubber = {way: at["flat punch", 1.0, way] for way in WAYS}
    names, times = " and ".join(shapes), ", ".join(f"{T:g}" for T in TIMES[1:])
    return Part(
        **told(part, locals()),
        checks=(*_elastic_checks(found), *_body_checks(), *_order_checks(at)),
        figures=(_figure(found),),
    )


def account(shape: str, T: float, way: str, size: float, **body: float) -> Account:
    """A contact vibrated one way, by this share of u_z0, or of mu_0 kappa u_z0."""
    if way == "normal":
        case = contact(shape, size, T, **body)
    else:
        case = shaken(shape, 0.0, T=T, **{{"along": "chi", "across": "eta"}[way]: size}, **body)
    run = mdr.slide(case, RATE * OMEGA * reach(case), accuracy=3e-4)
    spent, without = run.energy_balance, MU_0 * run.mean_F_z * run.v_0 * 2 * np.pi / OMEGA
    works = spent.pull_work, spent.normal_work + spent.shake_work, spent.lost
    return Account(1 - run.cof / MU_0, *(one / without for one in works), run.least_slip / run.v_0)


def curve(shape: str, T: float, way: str) -> list[Account]:
    """Accounts over the amplitude."""
    return [account(shape, T, way, size) for size in SIZES[way]]


def cost(accounts: Sequence[Account]) -> float:
    """Work of the oscillator that lowers friction by LESS."""
    lowered: Array = np.array([one.lowered for one in accounts])
    return float(np.interp(LESS, lowered, [one.oscillator for one in accounts]))


def _elastic_checks(found: dict[tuple[str, float, str], list[Account]]) -> Checks:
    for (shape, T, way), accounts in found.items():
        rising = np.diff([one.lowered for one in accounts]).min()
        where = f"{way}, {shape}, {loss(T)}"
        yield Check.at_least(f"least gain by a larger amplitude: {where}", rising, 0.0, "none is lost")
        if T > 0:
            continue
        if way == "normal":
            off = max(abs(one.oscillator) for one in accounts)
            yield Check(f"work of a normal oscillation: {shape}", off, 0.0, 1e-8, "the normal force is elastic")
            least = max(one.lost for one in accounts)
            yield Check.at_most(f"greatest dissipation under it: {shape}", least, 1.0, "it falls with friction")
        elif way == "across":
            least = min(one.lost for one in accounts)
            yield Check.at_least(f"least dissipation shaken across: {shape}", least, 1.01, "a longer way of slip")
        elif shape == "flat punch":
            kept = [one for one in accounts if one.least_slip >= 0]
            yield Check.at_least("punches that do not slip back", len(kept), 3, "small amplitudes")
            name = "worst |work of a longitudinal oscillation less what the pull is spared|, no slip back: flat punch"
            off = max((abs(one.oscillator - one.lowered) for one in kept), default=np.nan)
            yield Check(name, off, 0.0, 2e-4, "each spring has its v_0 of slip; accuracy of the runs")
    large = account("flat punch", 0.0, "along", 3.0)
    yield Check.at_least("dissipation shaken along with η = 3: flat punch", large.lost, 1.2, "it slips back too")
    edge = account("paraboloid", 0.0, "along", 1.0)
    yield Check.at_least("dissipation shaken along with η = 1: paraboloid", edge.lost, 1.005, "its edge slips back")


def _body_checks() -> Checks:
    for way in WAYS[:2]:
        one = account("flat punch", 0.0, way, 0.4, **BODY)
        name = f"supply less use with a body, {way}: flat punch"
        yield Check(name, one.pull + one.oscillator - one.lost, 0.0, 1e-3, "all of it is accounted for")
        if way == "normal":
            yield Check("work of a normal oscillation with a body: flat punch", one.oscillator, 0.0, 1e-8, "as above")


def _order_checks(at: dict[tuple[str, float, str], float]) -> Checks:
    for shape, T in sorted({key[:2] for key in at}):
        where = f"{shape}, {loss(T)}, friction lowered by {LESS:g} μ_0"
        over = at[shape, T, "normal"] / at[shape, T, "along"]
        if T in (0.0, 1.0):
            across = at[shape, T, "across"]
            why = "slip takes a longer way"
            yield Check.at_least(f"work across over work along: {where}", across / at[shape, T, "along"], 1.2, why)
        if T == 0:
            yield Check(f"work normal over work along: {where}", over, 0.0, 1e-6, "none is needed")
        elif T < 0.1:
            yield Check.at_most(f"work normal over work along: {where}", over, 0.8, "little is lost in dashpots")
        else:
            yield Check.at_least(f"work normal over work along: {where}", over, 1.2, "it works on all dashpots")
        if T == 1:
            over = at[shape, T, "normal"] / at[shape, T, "across"]
            yield Check.at_least(f"work normal over work across: {where}", over, 1.1, "likewise")


@figure("power", 1, 2, (10, 4.2), sharex=True)
def _figure(fig, panels, found):
    """Two panels, work of the oscillator over the share of friction that is lowered: elastic, and with dashpots.

    What it costs to lower friction, at v_0 = {rate:g} μ_0 κ ω u_z0; full lines flat punch, broken paraboloid. Left:
    elastic, where a normal oscillation is free and one along takes what the pull is spared. Right: with ωτ = 1 a normal
    oscillation takes most, and one along least.
    """
    for ax, T in zip(panels, (0.0, 1.0), strict=True):
        for way, colour in zip(WAYS, COLOURS, strict=False):
            for shape, line in (("flat punch", "-"), ("paraboloid", "--")):
                if (shape, T, way) in found:
                    accounts = found[shape, T, way]
                    work = [max(one.oscillator, 0.0) for one in accounts]
                    label = way if shape == "flat punch" else None
                    ax.plot([one.lowered for one in accounts], work, line, color=colour, label=label)
        ax.plot([0, 1], [0, 1], ":", color="0.4", label="what the pull is spared")
        ax.set(title=loss(T), xlabel=r"friction lowered, $1 - \mu/\mu_0$", xlim=(0, 1), ylim=(-0.1, 4))
    panels[0].set_ylabel(r"work of the oscillator over $\mu_0F_Nv_0T$")
    panels[0].legend()
    return {"rate": RATE}

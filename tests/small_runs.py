"""Runs small enough for Python alone: `python tests/small_runs.py` prints what they come to."""

import json
from dataclasses import replace
from itertools import cycle, product

import numpy as np
from conftest import contact

import mdr
from mdr.closed_forms.shaken_pull import ShakenPull, average_friction
from mdr.march.periodic.steady import Resolution, steady
from mdr.materials.operator import Rheology
from mdr.normal import indentation
from mdr.spring.law import law_of
from mdr.spring.settle import settled
from mdr.tools.anderson import shares

MATERIALS = {
    "elastic": mdr.Elastic(E=3e6, nu=0.4),
    "Kelvin": mdr.KelvinVoigt(E=3e6, nu=0.4, tau=2e-3),
    "arms": mdr.Prony(E_inf=2e6, arms=((1e6, 1e-3), (2e6, 1e-2)), nu=0.4),
    "arms and dashpot": mdr.Prony(E_inf=2e6, arms=((1e6, 5e-3),), nu=0.4, tau=1e-3),
}
MOTIONS = {"pressed": 3.0, "taps": 0.5, "flies": -0.6}
PULLS = {
    "rigid": {},
    "body": {"k_ratio": 0.7, "c_ratio": 0.1},
    "light body": {"k_ratio": 0.3, "omega_0_ratio": np.inf, "c_ratio": 0.3},
}
SHAKE = mdr.InPlaneOscillation(300.0, 2e-6, 0.7)
#: instants [s] and depths or forces over the greatest: in, out and in again, jumps both ways, a rest
TIMES = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 8.0, 8.0, 9.0]) * 1e-3
DEPTHS = np.array([0.1, 1.0, 0.7, -0.2, 0.6, 0.9, 0.3, 0.8, 0.3, 0.25])
FORCES = np.array([0.1, 1.0, 0.3, 0.0, 0.5, 0.8, 0.0, 0.0, 0.4, 0.6])


def least_squares():
    """The shares of Anderson's method, with a step that newer ones contain."""
    steps = np.array([[1.0, 2.0, 0.5, 0.0], [0.3, -1.0, 0.2, 2.0], [1.0, 2.0, 0.5, 0.0]])
    yield "shares", shares(steps, np.array([1.0, 0.0, 2.0, -1.0]), 1e-10).tolist()


def slides():
    """Every kind of spring, motion and pull, in an odd and an even number of steps; in turn still and shaken, from both
    starts, and pulled either way.
    """
    like, starts, ways = contact("paraboloid"), cycle((("full_slip", 2), ("rest", 3))), cycle((1, -1))
    shakes, every = cycle((None, None, SHAKE, SHAKE)), product(MATERIALS.items(), MOTIONS.items(), PULLS.items())
    for (name, material), (motion, depth_ratio), (pull, groups) in every:
        oscillation = replace(like.oscillation, u_z0=depth_ratio * like.oscillation.du_z)
        of_pull = contact("paraboloid", **groups).pull
        case = mdr.SlidingContact(like.indenter, material, like.mu_0, oscillation, of_pull, next(shakes))
        (start, n_periods), way = next(starts), next(ways) if case.shake else 1
        knobs = {"n_springs": 16, "steps_per_period": 14 + n_periods, "n_periods": n_periods, "start": start}
        run = mdr.slide(case, way * 0.4 * case.unit_velocity, record=n_periods - 2, **knobs)
        energy = run.energy_balance
        numbers = [run.cof, run.stick_share, energy.friction_loss, energy.viscous_loss, energy.shake_work]
        yield f"{name}, {motion}, {pull}, {start}, {case.shake}", [*numbers, *(() if run.F_x is None else run.F_x)]


def shaken_pulls():
    """Friction under a shake in closed form."""
    like = replace(contact("paraboloid"), shake=SHAKE)
    for name, motion in product(("elastic", "Kelvin"), ("pressed", "taps")):
        oscillation = replace(like.oscillation, u_z0=MOTIONS[motion] * like.oscillation.du_z)
        case = replace(like, material=MATERIALS[name], oscillation=oscillation)
        found = average_friction(ShakenPull.of(case), [0.0, 0.4])
        yield f"shaken pull, {name}, {motion}", found[0].tolist()
        yield f"share of stick, {name}, {motion}", found[2].tolist()


def searches():
    """Periodic states that are solved for, of a body on springs without memory and with arms."""
    for name in ("elastic", "arms"):
        of_pull = contact("paraboloid", k_ratio=0.7, omega_0_ratio=1.6, c_ratio=0.1)
        case = replace(of_pull, material=MATERIALS[name])
        run = steady(case, 0.4 * case.unit_velocity, Resolution(16, 24, "full_slip", lump=True, accuracy=1e-8))
        yield f"search, {name}", [run.cof, run.settling.solved]


def presses():
    """Histories of depth and of force."""
    for name, material in MATERIALS.items():
        for shape in (mdr.Paraboloid(R=5e-3), mdr.FlatPunch(a=1e-3)):
            for what, history in {"u_z": 1e-5 * DEPTHS, "F_z": FORCES}.items():
                record = isinstance(shape, mdr.Paraboloid)
                run = mdr.indent(shape, material, TIMES, **{what: history}, n_springs=16, record=record)
                loads = run.q_z.ravel() if record else ()
                yield f"{name}, {type(shape).__name__}, {what}", [*run.u_z, *run.F_z, *run.contact_radius, *loads]


def records():
    """Recorded motion through a contact."""
    t = np.linspace(0, 0.02, 13)
    found = mdr.slide_record(
        mdr.Paraboloid(R=5e-3), MATERIALS["Kelvin"], 0.4, t, 1e-3 * t, u_z=1e-5 + 4e-6 * np.sin(900 * t), n_springs=32
    )
    yield "record", [*found.F_x, *found.F_z]


def cycles():
    """Springs in their periodic normal motion; arms too fast for the steps find none, or alternate."""
    fast = mdr.Prony(3e6, [(3.511e5, 8.036e-4), (1.129e6, 1.618e-4)], 0.4, tau=0.4875)
    gap, w = np.linspace(-1.0, 1.0, 9), np.full(9, 0.25)
    several = dict.fromkeys(MATERIALS, (300.0, 48)) | {"finds none": (300.0, 16), "alternates": (1e3, 20)}
    for name, (omega, n_t) in several.items():
        phase = 2 * np.pi * np.arange(n_t + 1) / n_t - 1.0
        of = Rheology.of(MATERIALS.get(name, fast), omega)
        found = settled(gap, w, np.cos(phase), -np.sin(phase), law_of(of.T, of.rho, of.theta), each=True)
        numbers = [] if found is None else [*found.area, *found.moment, *found.compression, *found.s.ravel()]
        yield f"{name}, cycle", numbers or [np.nan]


MAKERS = (least_squares, slides, shaken_pulls, searches, presses, records, cycles)


def results():
    """Name -> numbers of every run."""
    few, indentation.STEPS = indentation.STEPS, 16
    try:
        return {name: [float(x) for x in numbers] for make in MAKERS for name, numbers in make()}
    finally:
        indentation.STEPS = few


if __name__ == "__main__":
    print(json.dumps(results()))

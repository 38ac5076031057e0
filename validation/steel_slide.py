"""Springs beside forces that were measured on steel, vibrated along the slide (J. Luo and others, 2024).

The computation is that of geometries/steel_slide.py: one bar fixes how far the contact deflects before it slides, and
the others are predicted. What is asked of each prediction is whether it is within its error; whether something simpler
does as well; what no constant coefficient of friction can meet, whatever the face and the stiffness; and what a static
coefficient above the kinetic one changes (`falling`: mu_s that at rest, mu_k that of each velocity).

Symbols: l = mu_0 kappa d deflection, du_x amplitude.
"""

import numpy as np

from geometries import steel_slide as measured
from mdr.tools.arrays import Array
from validation.report import Check, Checks, Claim, Figure, told
from validation.words import percent

ROUGH, SMOOTH = "rough face", ("flat punch", "paraboloid")
ERROR, ERROR_WITH = 0.2, 0.1  #: N, in the middle of the error bars without and with vibration
STIFF = 3.5  #: amplitude over a deflection that is small


def claim(effort: str) -> Claim:
    """Measured: vibrated steel keeps what springs under a rough face say, with the friction of each velocity

    How: Predict the bars that fixed nothing.

    Range: One table: steel 40Cr on itself, dry, under 10.8 N, base vibrated along the slide at 26 kHz by 0.35 µm;
    forces at rest and at five velocities from 0.05 to 1 mm/s, with vibration and without. Flat punch, paraboloid, and a
    rough face, whose load grows exponentially with depth (mdr.RoughFace); rigid pull. J. Luo and
    others, Sci. Rep. 14:25847 (2024).

    Measured: A contact that does not deflect would keep {rigid} of its friction at 0.05 mm/s; {kept} were measured, and
    {kept_at_rest} at rest. Springs deflect before they slide. How far is the one number that is not known; the bar at
    rest fixes it. With μ_0 F_N at each velocity that of the bar without vibration, springs under a rough face meet the
    five bars of the slide to {off_rough:.2f} N, within the error of the prediction, {least_error:.2f} to
    {most_error:.2f} N. A paraboloid comes up to {low_paraboloid:.1f} N too low, a flat punch {low_punch:.1f} N, and the
    same share of friction at all velocities up to {share:.1f} N too high. Fixed by the bar at 0.05 mm/s instead, all
    faces meet the other four bars of the slide, to {off_back:.2f} N, as would the same share: this tests little. The
    bar at rest is then too high, by {high_rough:.1f} N under the rough face and {back[flat punch][0]:.1f} N under the
    punch. No constant μ_0 meets the table: friction of springs never falls with velocity, and here it falls by
    {fall:.2f} N from rest to 0.05 mm/s. Two coefficients can. With the value at rest as μ_s, that of each velocity as
    μ_k, and no new number, a flat punch meets the five bars of the slide to {falls_punch:.2f} N: a spring that does
    not slip back is loaded to μ_s again and again, and carries the middle of both limits, less the force of the
    amplitude. The rough face is then up to {falls_rough:.1f} N too high, a paraboloid {falls_paraboloid:.1f} N. With
    both coefficients constant the punch falls as far, but is {falls_constant:.1f} N too high at 1 mm/s. So the table
    does not tell face and law apart. What speaks for the punch: springs of a rough face let go one after another, so
    that without vibration a slow pull from rest would come to only {peak:.0f} % above sliding; {measured_peak:.0f} %
    were measured. What speaks against it: μ_s is back at once after slip, in less than a period of 38 µs. That the
    limit under vibration is that of the mean velocity, and not of the velocity of the vibration, up to a thousand times
    higher, is compatible with the table and not shown by it. What is not told apart: the stiffness of the contact and
    of what holds base and slider (together {stiffness:.0f} N/µm under the rough face); static friction as a peak and as
    a mean; stick-slip without vibration; resonances of the slider. The rough face was tried after the smooth ones had
    failed. A law of friction that falls with velocity by itself (rate and state) could be tried next; this library has
    none.

    Verdict: fails when μ_0 is constant, and for smooth faces unless the value at rest is a static coefficient

    Sentence: Fixed at rest, springs with the μ_0 of each velocity meet five measured forces: under a rough face to
    {off_rough:.2f} N, or a flat punch to {falls_punch:.2f} N with μ_s at rest. No constant μ_0 does.
    """
    off = {face: _off(face, "as slow", "at rest")[1:] for face in measured.faces}
    back = {face: _off(face, "as slow", "0.05 mm/s") for face in measured.faces}
    fall, error = measured.vibrated[0] - measured.vibrated[1], _spread(ROUGH)[1:]
    share = np.abs(_same_share() - measured.vibrated).max()
    _, deflection = measured.found[ROUGH, "as slow", "at rest"]
    rigid = percent(measured.rigid[1] / measured.without[1], 1)
    kept = percent(measured.vibrated[1] / measured.without[1])
    kept_at_rest = percent(measured.vibrated[0] / measured.without[0])
    off_rough = np.abs(off[ROUGH]).max()
    least_error = error.min()
    most_error = error.max()
    low_paraboloid = -off["paraboloid"].min()
    low_punch = -off["flat punch"].min()
    off_back = max(np.abs(one[2:]).max() for one in back.values())
    falls_punch, falls_paraboloid, falls_rough = (
        np.abs(_off(face, "falling", "at rest")).max() for face in measured.faces
    )
    falls_constant, peak, measured_peak = _constant_fall()[-1], 100 * (_peak() - 1), 100 * (_stick() - 1)
    high_rough, stiffness = back[ROUGH][0], 1e-6 * measured.FOLDS * measured.without[1] / deflection[1]
    return Claim(
        **told(claim, locals()),
        checks=(*_met_checks(), *_constant_checks(), *_falling_checks(), *_stiff_checks()),
        figures=(_figure(),),
    )


def _off(face: str, limit: str, bar: str) -> Array:
    """Predicted less measured [N]."""
    forces, _ = measured.found[face, limit, bar]
    return np.asarray(forces - measured.vibrated)


def _same_share() -> Array:
    """Forces [N] if at all velocities as much is kept as at rest."""
    return np.asarray(measured.without * measured.vibrated[0] / measured.without[0])


def _stick() -> float:
    """mu_s/mu_k of the bars without vibration, at rest and at 0.05 mm/s."""
    return float(measured.without[0] / measured.without[1])


def _constant_fall() -> Array:
    """Predicted less measured [N] of a punch at 0.05 and 1 mm/s, if both coefficients are those of `_stick`."""
    _, deflection = measured.found["flat punch", "as slow", "at rest"]
    chi, slow = measured.du_x / deflection[1], measured.without[1]
    forces = slow * np.array([measured.kept("flat punch", chi, measured.v_0[i], _stick()) for i in (1, -1)])
    return np.asarray(forces - measured.vibrated[[1, -1]])


def _peak() -> float:
    """Greatest friction over that of slip, without vibration, of a rough face that is slowly pulled from rest.

    Springs slip up to the compression x l_e, others are stretched alike: 1 - (1 + x) e^-x + mu_s/mu_k x e^-x.
    """
    return 1 + (_stick() - 1) * float(np.exp(-_stick() / (_stick() - 1)))


def _spread(face: str) -> Array:
    """Error [N] of predicted less measured, fixed by the bar at rest, as each bar has its own."""
    own, rest, force = (
        0.5 * (measured.predicted(face, limits, 0, F)[0] - measured.predicted(face, less, 0, f)[0])
        for limits, less, F, f in _shifted()
    )
    return np.asarray(np.sqrt(own**2 + rest**2 + force**2 + ERROR_WITH**2))


def _shifted() -> list[tuple[Array, Array, float, float]]:
    """Bars moved up and down: those without vibration of the slide, that at rest, and that at rest with vibration."""
    at_rest, F = np.arange(6) == 0, float(measured.vibrated[0])
    own, rest = ERROR * ~at_rest, ERROR * at_rest
    limits = measured.without
    moved = [(limits + one, limits - one, F, F) for one in (own, rest)]
    return [*moved, (limits, limits, F + ERROR_WITH, F - ERROR_WITH)]


def _met_checks() -> Checks:
    why = "errors of its own two bars and of the bar at rest: 0.2 N without vibration, 0.1 N with it"
    spread = {face: _spread(face) for face in measured.faces}
    for v, off, error in zip(measured.v_0, _off(ROUGH, "as slow", "at rest"), spread[ROUGH], strict=True):
        if v > 0:
            yield Check(f"predicted less measured [N], rough face, {1e3 * v:g} mm/s", off, 0.0, error, why)
    worst = np.abs(_off(ROUGH, "as slow", "at rest")).max()
    for face in SMOOTH:
        off = np.abs(_off(face, "as slow", "at rest")).max()
        name = f"worst |predicted less measured| over that of a rough face, {face}"
        yield Check.at_least(name, off / worst, 3.0, "the table tells faces apart")
    share = np.abs(_same_share() - measured.vibrated).max()
    name = "the same, if as much is kept at all velocities as at rest"
    yield Check.at_least(name, share / worst, 3.0, "and springs from a constant share")
    back = _off(ROUGH, "as slow", "0.05 mm/s")
    yield Check("at rest, rough face fixed at 0.05 mm/s [N]", back[0], 0.0, spread[ROUGH][1], "as above")


def _constant_checks() -> Checks:
    fall = measured.vibrated[0] - measured.vibrated[1]
    name = "measured fall of friction from rest to 0.05 mm/s [N]"
    yield Check.at_least(name, fall, 2 * np.hypot(ERROR_WITH, ERROR_WITH), "two errors of a difference of bars")
    for face in measured.faces:
        for bar in measured.bars:
            forces, _ = measured.found[face, "constant", bar]
            name = f"least rise of predicted friction between bars [N], {face}: constant limit, fixed by the bar {bar}"
            yield Check.at_least(name, np.diff(forces).min(), 0.0, "friction never falls with velocity: uniqueness")
            off = np.abs(forces - measured.vibrated)[:2].max()
            name = f"worst |predicted less measured| [N], at rest or 0.05 mm/s, {face}: constant limit, fixed {bar}"
            yield Check.at_least(name, off, fall, "one of the two bars is missed by the whole fall, and more")


def _falling_checks() -> Checks:
    punch, rough = _off("flat punch", "falling", "at rest"), _off(ROUGH, "falling", "at rest")
    forces, deflections = measured.found["flat punch", "falling", "at rest"]
    why = "half of 0.2 N of its own bar and of that at rest without vibration, 0.1 N of both with it"
    for v, off in zip(measured.v_0[1:], punch[1:], strict=True):
        name = f"predicted less measured [N], flat punch whose friction falls, {1e3 * v:g} mm/s"
        yield Check(name, off, 0.0, np.sqrt(2 * (ERROR / 2) ** 2 + 2 * ERROR_WITH**2), why)
    name = "worst |predicted less measured| over that of a flat punch, rough face: friction falls"
    yield Check.at_least(name, np.abs(rough).max() / np.abs(punch).max(), 3.0, "the other face with the other law")
    mean = 0.5 * (measured.without[0] + measured.without[1]) - (measured.without[0] - measured.vibrated[0])
    way = measured.without[1] / deflections[1] * measured.v_0[1] * 2 * np.pi / measured.omega
    name = "flat punch whose friction falls, 0.05 mm/s, less (μ_s + μ_k)/2 F_N less the force of the amplitude [N]"
    yield Check(name, forces[1] - mean, 0.0, way, "the way of the pull in a period")
    slow, fast = _constant_fall()
    name = "predicted less measured [N], flat punch whose two coefficients are constant"
    yield Check(f"{name}, 0.05 mm/s", slow, 0.0, 0.2, why)
    yield Check.at_least(f"{name}, 1 mm/s", fast, 0.2, "measured friction falls on, that of springs rises")
    s = np.linspace(0, 40, 40001)  # compressions of a rough face, over l_e
    pulled = (np.where(s < x, s, _stick() * x) @ np.exp(-s) * s[1] for x in np.linspace(0.1, 10, 100))
    name = "greatest friction over that of slip of a rough face that is slowly pulled from rest"
    yield Check(name, max(pulled), _peak(), 1e-3, "springs one by one, for its closed form")


def _stiff_checks() -> Checks:
    name = "measured over the force of a contact that does not deflect, at 0.05 mm/s"
    yield Check.at_least(name, measured.vibrated[1] / measured.rigid[1], 100.0, "0.50 N beside 2 mN")
    for face in SMOOTH:
        for v in (measured.v_0[1], measured.v_0[-1]):
            known = 2 / np.pi * np.arcsin(v / (measured.omega * measured.du_x))
            name = f"kept by springs of a small deflection, l = 0.1 µm, over that without, {face}, {1e3 * v:g} mm/s"
            yield Check.between(name, measured.kept(face, STIFF, v) / known, 1.0, 1.5, "the rest falls like l")
    at_rest = measured.kept(ROUGH, 0.2, 0.0)
    known = np.expm1(0.8 * measured.FOLDS) / np.expm1(measured.FOLDS)
    name = "kept at rest by a rough face, amplitude 0.2 of its depth"
    yield Check(name, at_rest, known, 1e-9, "F_N(d - du_x/(mu_0 kappa))/F_N(d)")


def _figure() -> Figure:
    return Figure(
        "bars",
        "Forces of a vibrated steel slide (squares; their errors are 0.03 to 0.2 N) and of springs, fixed by the bar at"
        " rest (full lines) or at 0.05 mm/s (dotted). Left, a rough face fixed at rest goes through all bars, smooth"
        " ones do not. Middle, where friction falls from its value at rest to that of slip, a flat punch does, and a"
        " rough face does not. Right, with one limit springs rise wherever they are fixed, and cannot meet both.",
        measured.figure(),
        "Three panels, force under vibration at rest and at five velocities, measured and predicted for three faces.",
    )

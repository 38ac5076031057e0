"""Shaken along the slide as well: v_c by direction is that of depth and shake together, as vectors.

Forward every spring in contact slips at v_0 + x' + y' - mu_0 kappa u_z', where x is the way on which the shake takes
the indenter; pulled the other way the sign of u_z' and y' turns. With one frequency v_c = omega |mu_0 (kappa + K_z H)
u_1 -+ X_1|. Alone the shake has omega |X_1|, which knows no shape, depth or material. In phase with the depth, with X_1
= mu_0 kappa u_1, it leaves nothing of v_c forward, and doubles it the other way.

Symbols: alpha = du_z/u_z0, chi = du_x/(mu_0 kappa u_z0), phi_x phase of the shake, T = omega tau.
"""

import math
from dataclasses import replace
from itertools import product

import numpy as np

import mdr
from validation.cases import BODY, LOOKS, OMEGA, SHAPES, loss, shaken, shape_label
from validation.figures import figure
from validation.report import Check, Checks, Claim, told

ALPHA, CHI = 0.4, 0.6  #: of the figure
WAYS = {1: "forward", -1: "the other way"}
BRACKET = "half the bracket of a measurement, twice the accuracy it is asked for"


def claim(effort: str) -> Claim:
    """Shaken along the slide too, v_c is that of depth and shake together, and differs by direction

    How: Measure v_c both ways over phases, shapes, materials and pulls, beside the closed form.

    Quote: The reduction of static and sliding friction by ultrasonic oscillation in various directions is a well-known
    phenomenon with many applications … and production of directed motion, as in ultrasonic motors and linear actuators.
    (Section 1)

    Range: Flat punch, cone, paraboloid and r^4, elastic, Kelvin (ωτ = 1) and with a Maxwell arm; normal oscillation of
    Δu_z/u_z0 up to {ALPHA:g}, or none, with a longitudinal one of Δu_x up to μ_0 κ u_z0 in any phase, at the tool or at
    the pulling point; rigid pull and a body on a spring.

    Measured: A rigidly pulled contact has v_c = ω|μ_0 κ Δu_z ∓ Δu_x e^{{iφ}}|, upper sign forward, for any shape, depth
    and material, as long as contact is kept, or closed at the moment of greatest slip velocity: the difference of two
    pointers forward, their sum the other way. With a body the first pointer is that of Eq. (15), μ_0 (κ + K_z H) Δu_z,
    and a shaken pulling point reaches the indenter through spring, damper and mass. At finite amplitude a curved
    contact under a body leaves this formula as it leaves Eq. (15), and the full-slip condition with all harmonics takes
    its place. A longitudinal oscillation alone has v_c = ω Δu_x both ways, to the last digit of the measurement. In
    phase with the depth and of the size μ_0 κ Δu_z it costs no friction forward at any velocity, and the other way
    friction is reduced up to twice the velocity of Eq. (1).

    Verdict: holds

    Sentence: With contact at the greatest slip velocity, and a body where Eq. (15) holds, normal and longitudinal
    oscillation have v_c = ω|μ_0 (κ + K_z H) Δu_z ∓ X|, minus forward, plus the other way.
    """
    quick = effort == "quick"
    phases = np.linspace(0, 2 * math.pi, 4 if quick else 9)[:-1]
    return Claim(
        **told(claim, locals()),
        checks=(*_rigid_checks(phases), *_body_checks(phases[1:3]), *_alone_checks(quick), *_in_phase_checks()),
        figures=(_figure(quick),),
    )


def _pointers(case: mdr.SlidingContact, way: int) -> float:
    """|mu_0 kappa du_z -+ du_x exp(i phi)| omega of a rigid pull, written out."""
    depth = case.oscillation
    pressed = depth.du_z if isinstance(depth, mdr.NormalOscillation) else 0.0
    X = case.shake.du_x * np.exp(1j * case.shake.phi_x)
    return float(OMEGA * abs(case.mu_0 * case.material.mindlin_ratio * pressed - way * X))


def _measured(case: mdr.SlidingContact, way: int) -> float:
    return mdr.measure_critical_velocity(case, way).v_c or math.nan


def _rigid_checks(phases: np.ndarray) -> Checks:
    arm = mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6, tau_1=1 / OMEGA, nu=0.5)
    materials = {"elastic": None, "ωτ = 1": mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1 / OMEGA), "with an arm": arm}
    kinds = (*((one, "elastic") for one in SHAPES), ("paraboloid", "ωτ = 1"), ("cone", "with an arm"))
    for (shape, material), way in product(kinds, WAYS):
        cases = [shaken(shape, ALPHA, CHI, phi) for phi in phases]
        cases = [replace(case, material=materials[material] or case.material) for case in cases]
        off = [_measured(case, way) / _pointers(case, way) - 1 for case in cases]
        name = f"v_c measured over ω|μ_0 κ Δu_z ∓ Δu_x e^iφ|, less 1, worst phase: {shape}, {material}, {WAYS[way]}"
        yield Check(name, max(off, key=abs), 0.0, 1e-4, BRACKET)


def _body_checks(phases: np.ndarray) -> Checks:
    kinds = (("flat punch", 1.0, "tool"), ("paraboloid", 0.0, "pull"), ("cone", 1.0, "pull"))
    for (shape, T, at), way in product(kinds, WAYS):
        cases = [shaken(shape, ALPHA / 2, CHI, phi, T, at=at, **BODY) for phi in phases]
        off = [_measured(case, way) / mdr.full_slip_critical_velocity(case, way) - 1 for case in cases]
        where = f"{shape}, {loss(T)}, body, shaken at the {at}, {WAYS[way]}"
        name = f"v_c measured over that of full slip with all harmonics, less 1, worst phase: {where}"
        yield Check(name, max(off, key=abs), 0.0, 1e-4, BRACKET)
        if shape == "flat punch":
            name = f"the closed form over that of full slip, less 1, worst phase: {where}"
            why = "a punch that keeps contact has one harmonic, so that both are the same"
            yield Check(name, max((_from_full_slip(case, way) for case in cases), key=abs), 0.0, 1e-7, why)
    # the amplitude at which the formula leaves full slip, as Eq. (15) does: in proportion to it
    one, two = (_from_full_slip(shaken("cone", alpha, alpha / 2, 0.9, 1.0, **BODY), 1) for alpha in (0.02, 0.04))
    name = "power of the amplitude by which the closed form differs from full slip: cone under a body, shaken tool"
    why = "the next order is smaller by the amplitude, with a factor of order one"
    yield Check(name, math.log2(two / one), 1.0, 0.04, why)


def _from_full_slip(case: mdr.SlidingContact, way: int) -> float:
    """The closed form over the full-slip value, less 1."""
    return mdr.critical_velocity(case, way) / mdr.full_slip_critical_velocity(case, way) - 1


def _alone_checks(quick: bool) -> Checks:
    """A longitudinal oscillation alone."""
    off = []
    for shape, T, depth in product(SHAPES, (0.0, 1.0), (5e-6, 80e-6)):
        if quick and depth > 5e-6 and shape != "cone":
            continue
        case = shaken(shape, 0.0, 1.0, 0.3, T, u_z0=depth)
        off.append(_measured(case, 1) / (OMEGA * case.shake.du_x) - 1)
    light: dict[str, float] = {"k_ratio": 0.5, "omega_0_ratio": 0.6, "damping_ratio": 0.1}
    bodies = ((0.0, light), (1.0, light | {"k_ratio": 3.0, "omega_0_ratio": 2.0}))
    cases = [shaken("paraboloid", 0.0, 1.0, T=T, **groups) for T, groups in bodies]
    body = [_measured(case, -1) / _pointers(case, -1) - 1 for case in cases]
    far = shaken("paraboloid", 0.0, 1.0, at="pull", **light)
    m, c_x, k_x = far.pull.coefficients
    passed = abs((k_x + 1j * OMEGA * c_x) / (k_x - m * OMEGA**2 + 1j * OMEGA * c_x))
    through = _measured(far, 1) / (passed * _pointers(far, 1)) - 1
    name = "v_c measured over ω Δu_x, less 1, worst"
    got = max(off, key=abs)
    yield Check(f"{name}: four shapes, two depths, elastic and ωτ = 1, rigid pull", got, 0.0, 1e-4, BRACKET)
    yield Check(f"{name}: two bodies, shaken at the tool", max(body, key=abs), 0.0, 1e-4, BRACKET)
    yield Check("v_c measured over ω Δu_x |(k_x + iωc_x) H|, less 1: shaken at the pull", through, 0.0, 1e-4, BRACKET)


def _in_phase_checks() -> Checks:
    """A shake that goes with the depth, x = mu_0 kappa (u_z - u_z0)."""
    for shape in ("flat punch", "paraboloid"):
        case = shaken(shape, ALPHA, ALPHA, 0.0)
        slow = mdr.slide(case, 1e-3 * case.unit_velocity)
        name = f"COF/μ_0 forward at a thousandth of Eq. (1), shaken in phase by μ_0 κ Δu_z: {shape}"
        yield Check(name, slow.cof / case.mu_0, 1.0, 1e-9, "every spring slips at the velocity of the pull")
        back = _measured(case, -1) / case.unit_velocity
        yield Check(f"the same the other way: v_c over Eq. (1): {shape}", back, 2.0, 2e-4, BRACKET)


@figure("shaken_velocity", 1, 2, size=(11.0, 4.3), sharex=True)
def _figure(fig, axes, quick: bool):
    """Critical velocities over the phase of the shake, for both directions of the pull

    Critical velocity against the phase between normal (Δu_z/u_z0 = {alpha:g}) and longitudinal oscillation (Δu_x =
    {chi:g} μ_0 κ u_z0): closed form (lines) and measurements, filled forward, hollow the other way. Left, all shapes
    lie on one curve each way: least forward in phase, where depth and shake go together. Right, with a body: the flat
    punch stays on the formula, the cone leaves it at this amplitude, as it leaves Eq. (15).
    """
    both, body = axes
    phi = np.linspace(0, 2 * math.pi, 241)
    unit = shaken("flat punch", ALPHA, CHI).unit_velocity
    for way, look in ((1, "-"), (-1, "--")):
        cases = [shaken("flat punch", ALPHA, CHI, one) for one in phi]
        both.plot(phi / math.pi, [_pointers(one, way) / unit for one in cases], f"k{look}", lw=1, label=WAYS[way])
        cases = [shaken("flat punch", ALPHA, CHI, one, 1.0, **BODY) for one in phi]
        body.plot(phi / math.pi, [mdr.critical_velocity(one, way) / unit for one in cases], f"k{look}", lw=1)
    for (shape, (colour, marker)), shift in zip(LOOKS.items(), (0.0, 0.09, 0.18, 0.27), strict=True):
        at = np.arange(0.1 + shift, 2, 0.5 if quick else 0.36)
        for way, (ax, T, groups) in product(WAYS, ((both, 0.0, {}), (body, 1.0, BODY))):
            if not T or shape in ("flat punch", "cone"):
                cases = [shaken(shape, ALPHA, CHI, one * math.pi, T, **groups) for one in at]
                name = shape_label(shape) if way == 1 and not T else None
                look = {"mfc": colour if way == 1 else "white", "mec": colour, "ls": "", "label": name}
                ax.plot(at, [_measured(case, way) / unit for case in cases], marker, **look)
    both.set(title="rigid pull, elastic", ylabel=r"$v_c/(\mu_0\kappa\omega\Delta u_z)$")
    body.set(title=r"body on a spring, $\omega\tau = 1$")
    for ax in axes:
        ax.set(xlabel=r"phase of the shake $\varphi_x/\pi$", ylim=(0, None))
    fig.legend(loc="outside lower center", ncols=6)
    return {"alpha": ALPHA, "chi": CHI}

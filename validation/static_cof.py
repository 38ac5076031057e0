"""At vanishing velocity friction is that of the least normal force, Eq. (7), and how fast a curve leaves this limit.

What a slow pull adds to the static value follows from the motion of one spring (`small_velocity` of
mdr/closed_forms/rigid_pull.py; `mdr.laws.rise_of_lost_punch`):

* elastic: a foot is dragged since its contact began or since the depth was least, in proportion to v_0;
* Kelvin: while the force is least the foot slips for a time ~ v_0^(1/3) and creeps back, and the rise is ~ v_0^(2/3).
  It needs that time to be short against tau;
* Kelvin, contact lost everywhere: the free spring relaxes and forgets; in proportion to v_0 again.

Symbols: alpha = du_z/u_z0, T = omega tau.
"""

from dataclasses import dataclass

import numpy as np

import mdr
from mdr import laws
from mdr.closed_forms import paper as theory
from mdr.closed_forms.rigid_pull import Asymptote, small_velocity
from mdr.tools.arrays import Array
from validation.cases import contact, shape_label
from validation.figures import COLOURS, figure
from validation.full_slip import full_slip
from validation.report import Check, Checks, Claim, Equation, told

QUICK = (
    ("flat punch", 0.2, 0.0),
    ("cone", 0.9, 0.0),
    ("flat punch", 0.2, 1.0),
    ("paraboloid", 0.2, 1.0),
    ("flat punch", 1.5, 1.0),
)
FULL = (
    *QUICK,
    ("paraboloid", 0.2, 0.0),
    ("r^4", 0.9, 0.0),
    ("cone", 1.5, 0.0),
    ("cone", 0.2, 1.0),
    ("r^4", 0.2, 1.0),
    ("flat punch", 0.05, 5.0),
)  # shape, alpha, T
SAMPLED = (2 * np.pi / 8192) ** 2 / 8  # what 8192 instants may miss of the least value of a cosine of amplitude 1


@dataclass(frozen=True)
class Approach:
    """COF less its static limit, over mu_0, at falling velocities (n_v,)."""

    name: str
    v: Array  #: v_0/v_c
    rise: Array  #: (cof - static)/mu_0
    error: Array  #: of the rise
    power: float  #: expected, 1 or 2/3
    factor: float  #: expected rise over v**power

    @property
    def ratio(self) -> Array:
        """Measured over expected rise."""
        return np.asarray(self.rise / (self.factor * self.v**self.power))


_EQUATIONS = (
    Equation(
        "", r"\mu(v_0 \to 0) = \mu_0 \frac{\min F_N}{\langle F_N \rangle}", "Eq. (7) for any shape and normal force."
    ),
    Equation(
        "elastic",
        r"\frac{\mu - \mu(0)}{\mu_0} \to \frac{2 \hat{v}}{\pi} \frac{\Delta u_z}{\langle F_N \rangle}"
        r" \int_0^{\pi} \varphi k_{z,c}(u_{z0} + \Delta u_z \cos \varphi) d\varphi",
        "The law of the rise, v̂ = v_0/v_c.",
    ),
    Equation(
        "Kelvin",
        r"\frac{\mu - \mu(0)}{\mu_0} \to \frac{R^{1/3}}{2} (3\pi \omega\tau \hat{v})^{2/3} k_{z,c}(u_{z0} - R"
        r" \Delta u_z) \frac{\Delta u_z}{\langle F_N \rangle}, \quad R = \sqrt{1 + (\omega\tau)^2}",
        "The same where the core stays pressed. For a punch that is lost, see"
        " <code>mdr.laws.rise_of_lost_punch</code>.",
    ),
)


def claim(effort: str) -> Claim:
    """At vanishing velocity friction is μ_0 times the least normal force

    How: Static limit in closed form, and runs at falling velocity that tend to it.

    Quote: The static force of friction is equal to the minimal normal force during an oscillation cycle, multiplied
    with the coefficient of friction, Eq. (7). … First, the velocity-dependences all start from the static value at
    vanishing velocity. (Section 3)

    Range: {n_contacts} contacts: {shapes}; ωτ from 0 to {most_T:g}, with contact kept, lost at the edge, and lost
    altogether; rigid pull at v_0/v_c from 10^-1 to 10^{power}.

    Measured: Every curve starts at mu_0 min F_N/⟨F_N⟩, with the normal force of the whole contact; for a punch that
    keeps contact this is Eq. (7). How it starts depends on the material. An elastic contact leaves the static value in
    proportion to v_0, flat or curved. A Kelvin contact whose core stays pressed leaves it like v_0^{{2/3}}, flat or
    curved: its curve rises vertically from the static value, since a foot that slips only while the force is least has
    too little time to creep back. A Kelvin contact that is lost altogether starts from zero and in proportion to v_0
    again. Powers and factors are those derived from the motion of one spring, without a fit.

    Verdict: holds

    Sentence: Under a rigid pull friction starts from μ_0 times the least normal force; an elastic contact leaves it
    like v_0, a Kelvin contact that stays pressed like v_0^{{2/3}}.
    """
    v = {"quick": np.logspace(-1, -4, 4), "full": np.logspace(-1, -4, 7), "long": np.logspace(-1, -5, 13)}[effort]
    chosen = QUICK if effort == "quick" else FULL
    approaches = [approach(*which, v) for which in chosen]
    n_contacts, shapes = len(approaches), ", ".join(dict.fromkeys(c[0] for c in chosen))
    most_T, power = max(c[2] for c in chosen), round(float(np.log10(v[-1])))
    return Claim(
        **told(claim, locals()),
        checks=(*_static_checks(), *(check for a in approaches for check in _approach_checks(a))),
        figures=(_figure(approaches),),
        equations=_EQUATIONS,
    )


def approach(shape: str, alpha: float, T: float, v: Array) -> Approach:
    """Slide at falling velocities."""
    case = contact(shape, alpha, T)
    v_c, static = mdr.critical_velocity(case), mdr.static_cof(case)
    runs = [mdr.slide(case, x * v_c) for x in v]
    rise = np.array([run.cof - static for run in runs]) / case.mu_0
    mean = float(np.mean(full_slip(case)[0]))
    miss = alpha * np.hypot(1, T) * SAMPLED * case.k_zc * case.oscillation.u_z0 / mean
    error = np.array([run.cof_error / case.mu_0 if run.settled else np.inf for run in runs]) + miss
    law = _law(case, mean)
    return Approach(f"{shape}, ωτ = {T:g}, Δu_z/u_z0 = {alpha:g}", v, rise, error, law.power, law.coefficient)


def _law(case: mdr.SlidingContact, mean: float) -> Asymptote:
    """Leading term of the rise; mean: of the normal force [N]."""
    if case.T == 0 or case.keeps_contact:
        return small_velocity(case)
    drag = laws.rise_of_lost_punch(1 / case.alpha, case.T)
    return Asymptote(1.0, case.k_zc * case.cycle.du_z / mean * drag)


# --- checks ---


def _static_checks() -> Checks:
    for alpha, T in ((0.2, 0.0), (0.9, 0.0), (0.5, 0.7), (0.05, 10.0)):
        case = contact("flat punch", alpha, T)
        o = case.oscillation
        F_s = theory.eq_7(case.mu_0, o.u_z0, o.du_z, o.omega, case.k_zc, case.gamma_zc)
        bound = case.mu_0 * alpha * np.hypot(1, T) * SAMPLED + 1e-14
        why = "Eq. (6) times h²/8: 8192 instants miss the least force by that at most"
        name = f"static COF against Eq. (7) over F_N: flat punch, ωτ = {T:g}, Δu_z/u_z0 = {alpha:g}"
        yield Check(name, mdr.static_cof(case), F_s / (case.k_zc * o.u_z0), bound, why)
    for shape, mean in (("cone", lambda a: 1 + a**2 / 2), ("paraboloid", _mean_of_hertz)):
        alpha, power = 0.5, 2.0 if shape == "cone" else 1.5
        case = contact(shape, alpha)
        why = "F_N is a power of the depth; the least one lies on an instant, the mean of a smooth periodic function"
        why += " is exact to rounding"
        name = f"static COF, elastic {shape}, Δu_z/u_z0 = 0.5: (1 − 0.5)^{power:g} over the mean of"
        name += f" (1 + 0.5 cos)^{power:g}"
        yield Check(name, mdr.static_cof(case), case.mu_0 * (1 - alpha) ** power / mean(alpha), 1e-12, why)


def _mean_of_hertz(alpha: float) -> float:
    """Mean of (1 + alpha cos phi)^(3/2), by its binomial series."""
    from scipy.special import binom

    n = np.arange(0, 60, 2)
    return float(np.sum(binom(1.5, n) * alpha**n * binom(n, n // 2) / 2.0**n))


def _approach_checks(a: Approach) -> Checks:
    """Local power and extrapolated factor from the two slowest runs.

    The next term of the rise is smaller by v^(1/2) for elastic and v^(1/3) for Kelvin contacts, the share of a period
    spent slipping; contacts that are lost forget, and their next term is smaller by v.
    """
    gap = 0.5 if "ωτ = 0," in a.name else (1 / 3 if a.power < 1 else 1.0)
    v_2, v_1 = a.v[-2:]
    power = np.log(np.abs(a.rise[-2] / a.rise[-1])) / np.log(v_2 / v_1)
    noise = float(np.sum(a.error[-2:] / np.abs(a.rise[-2:])))
    why = "the next term is smaller by v to the 1/2 (elastic), 1/3 (Kelvin) or 1 (lost), with a factor of order one;"
    why += " and the error of the runs"
    bend = gap * np.sqrt(v_1 * v_2) ** gap + noise / np.log(v_2 / v_1)
    grow = (v_2 / v_1) ** gap
    limit = (grow * a.ratio[-1] - a.ratio[-2]) / (grow - 1)
    left = v_2 ** (2 * gap) + noise * grow / (grow - 1)
    yield Check(f"power of v_0 in COF − static: {a.name}", float(power), a.power, float(bend), why)
    why = "the next but one term at the faster of the two runs, and the error of the runs"
    yield Check(f"COF − static over the derived law, to v_0 → 0: {a.name}", limit, 1.0, left, why)


# --- figure ---


@figure("approach", size=(7.6, 4.4))
def _figure(fig, ax, approaches: list[Approach]):
    """Double logarithmic plot of COF less static COF over velocity with lines of slope one and two thirds.

    How friction leaves its static value: runs (symbols) and the leading laws, none of them fitted (lines). Elastic
    contacts, and Kelvin contacts that are lost, rise like v_0; Kelvin contacts with a core that stays pressed rise like
    v_0^{{2/3}}: at 10^-4 v_c the Kelvin punch is seventeen times further above its static value than the elastic punch
    of the same amplitude.
    """
    shown = [a for a in approaches if a.name.split(",")[0] in ("flat punch", "paraboloid", "cone")][:7]
    for a, colour, marker in zip(shown, COLOURS, "osD^vPX", strict=False):
        v = np.geomspace(a.v[-1], a.v[0])
        ax.loglog(v, a.factor * v**a.power, color=colour, lw=1, ls="-" if a.power == 1 else "--")
        shape, T, alpha = a.name.split(", ")
        label = f"{shape_label(shape)}, $\\omega\\tau={T[5:]}$, $\\Delta u_z/u_{{z0}}={alpha.split('= ')[1]}$"
        ax.loglog(a.v, a.rise, marker, mfc="white", color=colour, ms=5.5, label=label)
    ax.plot([], [], color="0.3", lw=1, label="law of power 1")
    ax.plot([], [], color="0.3", lw=1, ls="--", label="law of power 2/3")
    ax.set(xlabel="pulling velocity $v_0/v_c$", ylabel=r"$(\mu-\mu_{\mathrm{static}})/\mu_0$")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

"""`mdr velocity`: critical velocity and friction at rest in closed form; of a shaken contact both ways and unloaded."""

from __future__ import annotations

import argparse
import math
from typing import Any, NamedTuple

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity, formula_of
from mdr.commands.output import DONE, print_json, print_rows, velocity_text
from mdr.friction.shaken import HoldingBand, band_of_pull, blocked_cof, holding_band, no_load_velocity
from mdr.normal.doubts import edge, frequencies
from mdr.normal.resolved import resolved


def velocity(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print Eq. (15) and what stands beside it."""
    from mdr.closed_forms.full_slip import static_cof
    from mdr.closed_forms.full_slip_body import full_slip_critical_velocity

    if case.is_shaken:
        return _shaken(args, case)
    v_c, full_slip, static = critical_velocity(case), full_slip_critical_velocity(case), static_cof(case)
    known = resolved(case)
    (equation, how), kappa = equation_of(case), case.material.mindlin_ratio
    loss = float(case.material.loss_tangent(case.omega))
    if args.json:
        values = {
            "equation": equation, "v_c": v_c, "full_slip": full_slip, "static_cof": static, "mu_0": case.mu_0,
            "alpha": known.alpha, "T": case.T, "loss_tangent": loss, "mindlin_ratio": kappa,
            "keeps_contact": known.keeps_contact, **Size.of(known).values,
        }  # fmt: skip
        return print_json(args, values, case)
    print_rows([
        (equation, velocity_text(v_c), f"critical velocity, {how}"),
        ("full slip", velocity_text(full_slip), "critical velocity, any amplitude, all harmonics of the force"),
        ("static COF", f"{static:.6g}", f"friction as v_0 -> 0; mu_0 = {case.mu_0:.6g}"),
        ("alpha", f"{known.alpha:.6g}", "amplitude of the depth over the mean depth, du_z/u_z0"),
        ("loss", f"{loss:.6g}", "loss tangent of the material at omega; omega tau of a Kelvin body"),
        ("kappa", f"{kappa:.6g}", "E*/G*, Mindlin ratio"),
        ("contact", "kept" if known.keeps_contact else "lost in part of the period", "at its centre, Eq. (5)"),
        *Size.of(known).rows,
    ])  # fmt: skip
    return DONE


def _shaken(args: argparse.Namespace, case: SlidingContact) -> int:
    """The same of a contact that is shaken in the plane, for each way of the pull, and what it does at rest."""
    from mdr.closed_forms.full_slip_body import full_slip_critical_velocity

    known, (equation, how) = resolved(case), equation_of(case)
    v_c, full = ([one(case, way) for way in (1, -1)] for one in (critical_velocity, full_slip_critical_velocity))
    ends = Ends.of(case)
    if args.json:
        values = {
            "equation": equation, "v_c": v_c[0], "v_c_back": v_c[1], "full_slip": full[0], "full_slip_back": full[1],
            "mu_0": case.mu_0, **ends.values,
            "alpha": known.alpha, "chi": known.chi, "T": case.T, "mindlin_ratio": case.material.mindlin_ratio,
            "keeps_contact": known.keeps_contact, **Size.of(known).values,
        }  # fmt: skip
        return print_json(args, values, case)
    print_rows([
        ("forward", velocity_text(v_c[0]), f"critical velocity by {equation} {how}"),
        ("other way", velocity_text(v_c[1]), "the same, pulled the other way"),
        ("full slip", velocity_text(full[0]), "critical velocity forward, any amplitude, all harmonics of the force"),
        ("other way", velocity_text(full[1]), "the same, pulled the other way"),
        *ends.rows,
        ("alpha", f"{known.alpha:.6g}", "amplitude of the depth over the mean depth, du_z/u_z0"),
        ("chi", f"{known.chi:.6g}", "amplitude of the shake over the deflection at which springs slip"),
        ("contact", "kept" if known.keeps_contact else "lost in part of the period", "at its centre, Eq. (5)"),
        *Size.of(known).rows,
    ])  # fmt: skip
    return DONE


NOT_KNOWN = "not known"  #: the meaning then says why


class Size(NamedTuple):
    """The numbers by which a mistake in a case file shows: how large, how steep, how loaded, how stiff."""

    contact_radius: float  #: [m]
    edge_slope: float
    mean_load: float  #: [N], over the period
    k_zc: float  #: [N/m]
    k_xc: float  #: [N/m]
    omega_0_over_omega: float | None  #: None of a rigid pull, infinite of a body without mass
    omega_z_over_omega: float | None  #: of the mass that a load moves, on the contact; None without one
    at_depth: float  #: of radius, slope and stiffnesses [m]: the mean one, of tapping the greatest

    @classmethod
    def of(cls, known: SlidingContact) -> Size:
        """Those of a case of known depth."""
        from mdr.closed_forms.full_slip import mean_normal_force

        d, E_star = known.contact_depth, known.material.E_star
        a, slope = edge(known.indenter, d)
        k_zc = float(known.indenter.stiffness(d, E_star))
        ratios = [known.pull.omega_0 / one for one in frequencies(known)]
        ratio = None if known.pull.is_rigid else min(ratios, key=lambda one: abs(math.log(one)))
        k_xc = k_zc / known.material.mindlin_ratio
        m_z = getattr(known.oscillation.load, "m_z", 0.0)
        bounce = math.sqrt(k_zc / m_z) / known.oscillation.omega if m_z > 0 else None
        return cls(a, slope, mean_normal_force(known), k_zc, k_xc, ratio, bounce, d)

    @property
    def values(self) -> dict[str, Any]:
        """What JSON says of them."""
        return self._asdict()

    @property
    def rows(self) -> list[tuple[str, str, str]]:
        """The same in words."""
        ratio = self.omega_0_over_omega
        body = "rigid" if ratio is None else "no mass" if math.isinf(ratio) else f"{ratio:.6g}"
        bounce, meaning = self.omega_z_over_omega, "natural frequency of m_z on the contact over that of the load"
        return [
            ("radius", f"{self.contact_radius:.6g} m", f"of the contact at the depth of {self.at_depth:.4g} m"),
            ("slope", f"{self.edge_slope:.6g}", "of the shape at the edge of the contact; well below 1"),
            ("load", f"{self.mean_load:.6g} N", "mean normal force over a period"),
            ("k_zc", f"{self.k_zc:.6g} N/m", "normal stiffness of the contact"),
            ("k_xc", f"{self.k_xc:.6g} N/m", "tangential stiffness of the contact"),
            ("body", body, "natural frequency of the body over that of the vibration, omega_0/omega"),
            *([] if bounce is None else [("m_z", f"{bounce:.6g}", meaning)]),
        ]


class Ends(NamedTuple):
    """The ends of the characteristic of a contact that is shaken in the plane; in words, what is not known."""

    band: HoldingBand  #: of loads that it holds at rest
    blocked: float | str | HoldingBand  #: friction where the pull stands still
    free: float | str  #: velocity without load [m/s]

    @classmethod
    def of(cls, case: SlidingContact) -> Ends:
        """The ends of this case."""
        try:
            held = band_of_pull(resolved(case))
            blocked: float | str | HoldingBand = blocked_cof(case) if held.is_one_number else held
        except ValueError as unknown:
            blocked = str(unknown)
        try:
            free: float | str = no_load_velocity(case)
        except ValueError as unknown:
            free = str(unknown)
        return cls(holding_band(case), blocked, free)

    @property
    def values(self) -> dict[str, Any]:
        """What JSON says of them."""
        band, blocked = [self.band.low, self.band.high], self.blocked
        number = None if isinstance(blocked, HoldingBand) else blocked
        held = {"blocked_band": [blocked.low, blocked.high]} if isinstance(blocked, HoldingBand) else {}
        return {"holding_band": band, "blocked_cof": number, **held, "no_load_velocity": self.free}

    @property
    def rows(self) -> list[tuple[str, str, str]]:
        """The same in words."""
        band, blocked, free = self
        one = NOT_KNOWN if isinstance(blocked, str) else _span(blocked)
        at_rest = blocked if isinstance(blocked, str) else "the same under its own pull, standing still"
        velocity = NOT_KNOWN if isinstance(free, str) else f"{free:.6g} m/s"
        unloaded = free if isinstance(free, str) else "velocity at which it runs by itself, where no force holds it"
        return [
            ("band", _span(band), "mean F_x over mean F_z at rest, under a rigid pull that stands still"),
            ("blocked", one, at_rest),
            ("no load", velocity, unloaded),
        ]


def _span(held: HoldingBand | float) -> str:
    """A band of forces, or one force."""
    if not isinstance(held, HoldingBand):
        return f"{held:.6g}"
    return f"{held.high:.6g} (one value)" if held.is_one_number else f"{held.low:.6g} to {held.high:.6g}"


def equation_of(case: SlidingContact) -> tuple[str, str]:
    """Number and circumstances of the closed form."""
    number, closing, rest = formula_of(case).partition(")")
    usual = "" if case.is_shaken else "contact stiffness at the mean depth"
    return number + closing, rest.strip() or usual

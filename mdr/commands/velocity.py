"""`mdr velocity`: critical velocity and static friction in closed form."""

from __future__ import annotations

import argparse

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity, formula_of
from mdr.commands.output import DONE, print_json, print_rows, velocity_text
from mdr.normal.resolved import resolved


def velocity(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print Eq. (15) and what stands beside it."""
    from mdr.closed_forms.full_slip import static_cof
    from mdr.closed_forms.full_slip_body import full_slip_critical_velocity

    v_c, full_slip, static = critical_velocity(case), full_slip_critical_velocity(case), static_cof(case)
    known = resolved(case)
    (equation, how), kappa = equation_of(case), case.material.mindlin_ratio
    loss = float(case.material.loss_tangent(case.oscillation.omega))
    if args.json:
        values = {
            "equation": equation, "v_c": v_c, "full_slip": full_slip, "static_cof": static, "mu_0": case.mu_0,
            "alpha": known.alpha, "T": case.T, "loss_tangent": loss, "mindlin_ratio": kappa,
            "keeps_contact": known.keeps_contact,
        }  # fmt: skip
        return print_json(args, values, case)
    print_rows([
        (equation, velocity_text(v_c), f"critical velocity, {how}"),
        ("full slip", velocity_text(full_slip), "critical velocity, any amplitude, all harmonics of the force"),
        ("static COF", f"{static:.6g}", f"friction as v_0 -> 0; mu_0 = {case.mu_0:.6g}"),
        ("alpha", f"{known.alpha:.6g}", "half the swing of the depth over its mean, du_z/u_z0"),
        ("loss", f"{loss:.6g}", "loss tangent of the material at omega; omega tau of a Kelvin body"),
        ("kappa", f"{kappa:.6g}", "E*/G*, Mindlin ratio"),
        ("contact", "kept" if known.keeps_contact else "lost in part of the period", "at its centre, Eq. (5)"),
    ])  # fmt: skip
    return DONE


def equation_of(case: SlidingContact) -> tuple[str, str]:
    """Number and circumstances of the closed form."""
    number, closing, rest = formula_of(case).partition(")")
    return number + closing, rest.strip() or "contact stiffness at the mean depth"

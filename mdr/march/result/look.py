"""The last periods of a march, which can be looked at closely: stepped again with modes of contact, forces, energies.

A COF that contradicts a theorem (theorems.py) is not called settled.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np

from mdr.march.dynamics.stepper import TOLERANCE, PeriodRecord
from mdr.march.periodic.steady import MarchEnd, out_of_range
from mdr.march.periodic.theorems import outside
from mdr.march.periodic.waiting import NO_STEP
from mdr.tools.arrays import Array

SEEN = 16  #: periods that tell shares and energies of a motion that does not come back


def looked_at(end: MarchEnd) -> tuple[MarchEnd, list[PeriodRecord], list[PeriodRecord]]:
    """The end of a march after further periods; those that modes and energies are taken from, all after which a state
    comes back, and those that are to be kept, one at least.
    """
    stepper, state, n = end.stepper, end.orbit.state, end.resolution.record
    repeats = end.settling.periods if end.settling.solved else SEEN if end.settling.kind == "averaged" else 1
    records: list[PeriodRecord] = []
    while len(records) < max(repeats, n, 1):
        state, record = stepper.observe(state, keep=n > 0)
        records.append(record)
    if not all(np.isfinite(record.period.cof).all() for record in records):
        raise out_of_range(end.v_0)
    end = replace(end, n_periods=end.n_periods + len(records))
    if end.awaits and end.waited is not None:
        waited = copy(end.waited)
        for record in records:
            waited.append(record.period)
        end = end.judged(waited.assess())
    accounts = records[-1:] if end.awaits else records[:repeats]  # the same periods however many are kept
    why = next(filter(None, (_contradiction(end, one) for one in accounts)), "") if end.settling.settled else ""
    return end.unsettled(why, contradicts=True) if why else end, accounts, records[-max(1, n) :]


def _contradiction(end: MarchEnd, account: PeriodRecord) -> str:
    """Why the COF that a march has settled at cannot be one; nothing if it can."""
    scaled, settling = end.scaled, end.settling
    if not account.solved:
        return NO_STEP
    most = float(scaled.limit.bears.stick[0])
    least = float(scaled.limit.end.min()) / scaled.limit.mean
    least = -most if scaled.drive.is_shaken or scaled.limit.falls else least
    # between two nodes it may be lower by h²/8 times its bend, and means over nodes miss as much
    why = outside(settling.mean, least, settling.spread + TOLERANCE + 10 * scaled.drive.h**2, most)
    slack = (end.error or 0.0) + settling.spread + TOLERANCE
    return why or ("" if end.error is None else outside(settling.mean, -most, slack, most))


def may_rest_elsewhere(end: MarchEnd, account: PeriodRecord) -> bool:
    """Whether some spring can stick for good with its foot at more than one place, so that the end depends on the
    start.

    At v_0 = 0, with x the displacement of its top, -c the place of its foot and R what friction bears, the force
    L[x] + c must stay within R. More than one c does so if 0 < min(R - L[x]) + min(R + L[x]).
    """
    scaled = end.scaled
    if end.v_0 != 0:
        return False
    top, z = account.u[1:] + end.stepper.motion.x[1:], scaled.drive.z[1:]
    forces = np.fft.rfft([z, top.real, top.imag]) * scaled.rheology.response(np.arange(scaled.drive.steps // 2 + 1))
    press, along, across = np.fft.irfft(forces, scaled.drive.steps)
    # of a foot so at rest that the force goes about zero
    away = np.hypot(*(one - 0.5 * (one.min() + one.max()) for one in (along, across)))

    def holds(R: Array) -> bool:
        if scaled.n_axes == 2:
            return float((R - away).min()) > 0
        return float((R - along).min() + (R + along).min()) > 0

    return any(map(holds, scaled.limit.borne(press)))

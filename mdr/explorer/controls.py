"""What can be set in a state, and to which values: one control for each field, group or velocity.

Unit and meaning are those of the field. A slider moves on a grid: a decade to both sides of the first value on a
logarithmic scale, or the whole range where it has two ends. What is typed may lie beyond; the grid then moves there.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, as_given
from mdr.case.in_plane import MOST_RATIO, PLACES
from mdr.case.paths import GROUPS, facts_at, fields_at, fields_set, slot_of
from mdr.closed_forms.critical_velocity import UP_TO, velocity_scale
from mdr.explorer.state import DECADE, State, group_values, scales_of
from mdr.files.examples import PARTS
from mdr.tools.checks import positive
from mdr.tools.fields import Facts, Rule, facts_of

STEPS = 200  #: of a slider: as many as it has pixels
HIDDEN = ("k_y", "c_y")  #: of a body that is not guided across: files and scripts have them


@dataclass(frozen=True)
class Control:
    """One quantity that can be set."""

    path: str
    facts: Facts
    value: Any
    grid: tuple[float, ...] = ()  #: where a slider can stand, rising; empty where it has none
    words: tuple[str, ...] = ()  #: what can be chosen, of a word

    @property
    def name(self) -> str:
        """The field, without its part."""
        return self.path if self.path in GROUPS else self.path.rpartition(".")[2]

    @property
    def place(self) -> int:
        """Where on the grid the slider stands: the nearest value."""
        return int(np.argmin(np.abs(np.array(self.grid) - self.value)))

    def of(self, state: State) -> Control:
        """The control at the value of the state, on the same grid as long as that suits."""
        value = state.value(self.path)
        known = not self.grid or self.grid[0] <= value <= self.grid[-1]
        if self.path == "v_0":  # of a case whose velocity scale has moved
            known &= 1.0 <= self.grid[-1] / velocity_scale(state.case) <= DECADE
        return replace(self, value=value) if known else control_of(state, self.path, self.facts)


def controls_of(state: State) -> dict[str, list[Control]]:
    """The controls of a state, under the part that they belong to; "" are those of the contact as a whole."""
    case = as_given(state.case)
    groups = group_values(case) if state.in_groups else {}
    found = {"": [control_of(state, "v_0/v_c" if state.in_groups and state.v_c else "v_0")]}
    for slot in KINDS:
        part = getattr(case, slot)
        own = {one.name: facts_of(one) for one in fields(part) if one.name not in HIDDEN} if is_dataclass(part) else {}
        set_by = {fields_set(path)[0]: path for path in groups}
        found[slot] = [control_of(state, path) for at, path in set_by.items() if at.startswith(f"{slot}.")]
        fields_of_it = [path for path in fields_at(slot, part) if path not in set_by and slot_of(path)[1] in own]
        found[slot] += [control_of(state, path, own[slot_of(path)[1]]) for path in fields_of_it]
    return found


def control_of(state: State, path: str, facts: Facts | None = None) -> Control:
    """The control at a path."""
    facts, value = facts or facts_at(path), state.value(path)
    if isinstance(value, str | tuple):
        return Control(path, facts, value, words=PLACES if path.endswith(".at") else tuple(PARTS.get(path, ())))
    return Control(path, facts, value, tuple(float(one) for one in _grid(state, path, facts, value)))


def _grid(state: State, path: str, facts: Facts, value: float) -> Iterable[float]:
    """Values of a slider, which the rule of the field accepts."""
    case, name, rule = state.case, path.rpartition(".")[2], facts.rule
    if path in ("v_0", "v_0/v_c"):  # of both signs where something shakes in the plane
        top = max(UP_TO * (velocity_scale(case) if path == "v_0" else 1.0), abs(value))
        return np.linspace(-top, top, STEPS + 1) if case.is_shaken else np.linspace(0, top, STEPS + 1)[1:]
    if path in GROUPS:  # as the field that it sets
        rule = positive if path == "omega_0/omega" else facts_at(fields_set(path)[0]).rule
    if path == "shake.omega" and case.oscillation.omega:
        # multiples and parts: of short periods
        ratios = {ratio for n in range(1, MOST_RATIO + 1) for ratio in (n, 1 / n)}
        return sorted({*(ratio * case.oscillation.omega for ratio in ratios), value})
    if facts.unit == "rad" and _accepts(rule, name, -1.0):
        return np.linspace(-np.pi, np.pi, STEPS + 1)
    if path not in GROUPS and facts.unit == "-" and not _accepts(rule, name, DECADE):  # a ratio with two ends
        return _accepted(np.linspace(0.0, 1.0, STEPS + 1), rule, name)
    middle = value or scales_of(case).get(name, 1.0)
    if value < 0 or (value == 0 and name == "u_z0"):
        return np.linspace(-DECADE * abs(middle), DECADE * abs(middle), STEPS + 1)
    return _accepted(middle * np.geomspace(1 / DECADE, DECADE, STEPS + 1), rule, name)


def _accepted(values: Iterable[float], rule: Rule | None, name: str) -> list[float]:
    """The values that a rule accepts, to three digits, and zero where it is the least that it accepts."""
    rounded = [*([] if _accepts(rule, name, -1.0) else [0.0]), *(float(f"{value:.3g}") for value in values)]
    return sorted({value for value in rounded if _accepts(rule, name, value)})


def _accepts(rule: Rule | None, name: str, value: float) -> bool:
    try:
        return rule is None or rule(name, value, "") is not None
    except (TypeError, ValueError):
        return False

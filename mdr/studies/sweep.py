"""sweep(): a grid of cases, computed in parallel, resumed from a store, and returned as one Study."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.friction.cof_curve import require_knobs
from mdr.given.mean_load import warn_of_mean_loads
from mdr.given.vary import load_asked, still_held
from mdr.march.periodic.steady import BUDGET, accuracy_of
from mdr.normal.resolved import at_rest
from mdr.studies.axes import read_axes
from mdr.studies.engine import Call
from mdr.studies.quantities import Quantity, read_quantities
from mdr.studies.store import Store
from mdr.studies.study import Study
from mdr.studies.work import MOST_NUMBERS, Work
from mdr.tools.checks import positive
from mdr.tools.keywords import offering
from mdr.tools.messages import short


@offering
def sweep(
    case: SlidingContact,
    axes: Mapping[str, Any],
    store: str | PathLike[str] | None = None,
    executor: Any = None,
    quantities: Iterable[str | Quantity] = ("cof",),
    *,
    chunk_seconds: float = 5.0,
    shard: str | tuple[int, int] | None = None,
    n_springs: int | None = None,
    steps_per_period: int | None = None,
    accuracy: float = BUDGET,
    held: Mapping[str, Any] | None = None,
) -> Study:
    """Quantities, each in its unit, over a grid of cases: a parameter study.

    It is computed in parallel, and goes on where it was interrupted.

    Parameters
    ----------
    case : SlidingContact
        The contact that the axes vary.
    axes : mapping of str to array_like
        Values by path (`mdr.studies.axes`): a field ("oscillation.u_z0", "indenter"), what a rig is set to ("load",
        "frequency", "tan_delta"), a dimensionless group ("alpha", "T", "k_x/k_xc", "omega_0/omega") or the velocity
        ("v_0" in m/s, "v_0/v_c").
    store : str or path-like, optional
        Folder that finished chunks are kept in. The same call goes on from there, however the last one ended. None
        keeps the study in memory.
    executor : concurrent.futures.Executor, optional
        Who computes: None computes here, and after two seconds with a process for each further core, unless a shape or
        a quantity is defined in the script itself. Any Executor will do, of processes that are spawned, or of a cluster
        (Dask: `client.get_executor()`).
    quantities : iterable of str or Quantity
        Names of `mdr.studies.CATALOGUE`, derivatives such as "d cof/d oscillation.du_z" (`mdr.sensitivity`), or records
        of your own. Over "v_0" it has "v_c" too, which its maps show.
    chunk_seconds : float
        Length of a chunk of work [s].
    shard : str or tuple of int, optional
        "k/n" or (k, n) computes every n-th chunk, from the k-th on, k = 1 ... n. The points of the other chunks are
        missing until all are in the store.
    n_springs, steps_per_period : int, optional
        Springs and time steps of every run, as in `slide`.
    accuracy : float
        Bound on the error of every friction over mu_0 [-] that is asked for, as in `slide`.
    held : mapping of str to float, optional
        What every case of the study has besides: "load" [N], "frequency" [Hz] or "tan_delta" [-], unless an axis sets
        the same. A load is held where shape or material vary, by another depth in every case; a loss tangent where the
        frequency varies, by another tau. A study file holds the load and the loss tangent that it gives. Beside a load
        "hold" says what stays: "depth", at which it rests, or "load", its mean over the period. Where that is not said
        of a driven depth, the study has the quantity "mean_F_N" too, and a warning says where it differs from the load.

    Returns
    -------
    Study
        Values with named axes. A point that cannot be computed is NaN, with its reason. No value depends on store,
        shard or executor.

    Raises
    ------
    TypeError, ValueError
        For what can never be computed.
    StudyError
        For a store that cannot be used, and for workers that were lost.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> study = mdr.sweep(case, {"alpha": [0.05, 0.1], "v_0/v_c": [0.2, 0.6]})
    >>> study["cof"].shape, study.complete
    ((2, 2), True)
    """
    case = as_given(case)
    with suppress(ValueError):  # the base case may be one that cannot be; its points say so themselves
        at_rest(case)  # warns of what is unlikely
    axes_read, held = read_axes(case, axes), still_held(held or {}, axes)
    knobs: dict[str, Any] = {"n_springs": n_springs, "steps_per_period": steps_per_period}
    require_knobs(**knobs)
    knobs["accuracy"] = accuracy_of(accuracy)
    is_asked = load_asked({**held, **axes}, case) is not None and "mean_F_N" not in axes
    columns = read_quantities(quantities, axes, ["mean_F_N"] if is_asked else [], held, knobs["accuracy"])
    work = Work(case, axes_read, columns, knobs, held)
    _require_room(work)
    chunk_seconds, part = positive("chunk_seconds", chunk_seconds, "length of a chunk in s"), _shard(shard)
    _require_executor(executor)
    if store is None and shard is not None:
        raise ValueError("a shard needs a store that the others are kept in: store= in Python, --store in a shell")
    if not isinstance(store, str | PathLike | None):
        raise TypeError(f"store must be a folder, got {short(repr(store))}")
    study = Call(work, None if store is None else Store(fsdecode(store)), executor).study(chunk_seconds, part)
    if is_asked:
        _warn_of_loads(study, held)
    return study


def _warn_of_loads(study: Study, held: Mapping[str, Any]) -> None:
    """Warn of points whose mean load is another than the load at rest, once for all."""
    mean, asked = study["mean_F_N"], np.asarray(held.get("load", 0.0))
    for i, axis in enumerate(study.grid):
        if axis.path == "load":
            asked = np.asarray(axis.values).reshape([-1 if i == j else 1 for j in range(mean.ndim)])
    asked, known = np.broadcast_to(asked, mean.shape), np.isfinite(mean)
    pairs = list(zip(asked[known].tolist(), mean[known].tolist(), strict=True))
    warn_of_mean_loads(pairs, "at {n} of {of} points ")


def _require_room(work: Work) -> None:
    n_points, n_quantities = work.layout.n_points, len(work.quantities)
    if n_points * n_quantities > MOST_NUMBERS:
        raise ValueError(
            f"the grid has {n_points} points of {n_quantities} quantities, more than memory holds (at most "
            f"{MOST_NUMBERS} numbers); cut it into several studies"
        )


def _shard(shard: Any) -> tuple[int, int]:
    """k and n; 1 and 1 for all of it."""
    if shard is None:
        return 1, 1
    text = "/".join(map(str, shard)) if isinstance(shard, tuple | list) else str(shard)
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", text, re.ASCII)
    k, n = map(int, found.groups()) if found else (0, 0)
    if not 1 <= k <= n:
        raise ValueError(f"shard must be k/n with k from 1 to n, such as 3/16, got {short(repr(shard))}")
    return k, n


def _require_executor(executor: Any) -> None:
    if executor is None:
        return
    from concurrent.futures import Executor

    if not isinstance(executor, Executor):
        hint = "; write client.get_executor()" if hasattr(executor, "get_executor") else ""
        raise TypeError(f"executor must be a concurrent.futures.Executor, got {short(repr(executor))}{hint}")

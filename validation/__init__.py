"""What the paper claims, one claim a module, each measured with the springs of `mdr`.

A module, or a package of parts, has `claim(effort) -> Claim` with effort "quick", "full" or "long" and is listed here,
in the order of the report. `python -m validation` runs them all and writes the page.
"""

import importlib
import multiprocessing
import os
import signal
import sys
import threading
import time
import traceback
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import mdr
from validation.report import Claim

warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # claims go to extremes on purpose

#: title of a group -> what it is about, and its claims, in the order of the report
GROUPS = {
    "The model": (
        "Independent springs stand for the contact: they carry its forces, lose no energy, and runs are accurate.",
        ("mapping", "normal_contact", "fields", "energy", "resolution"),
    ),
    "The claims of the paper": (
        "On friction, critical velocity and Eq. (15), tested beyond the one spring for which they were derived.",
        ("full_slip_motion", "static_cof", "rigid_pull", "spring_pull", "generalisation", "uniqueness", "maps"),
    ),
    "Beyond the paper": (
        "The whole curve, waveforms and random vibration, lost contact, resonances, oscillation along and across.",
        ("one_curve", "damping", "waveforms", "random_vibration", "lost_contact", "resonances", "shaken_velocity",
         "shaken_curves", "drive", "shaken_across", "shear_strength", "two_coefficients", "stick_slip", "sequel"),
    ),
    "Measured forces": (
        "The springs beside forces that were measured on a real contact.",
        ("steel_slide",),
    ),
    "Three dimensions": (
        "A half-space, solved with no springs at all, shows what independent springs leave out.",
        ("judge", "uncoupled", "coupled", "end_of_stick", "coupling_law", "transverse_slip", "vector_springs",
         "falling_in_space"),
    ),
}  # fmt: skip
CLAIMS = tuple(name for _, names in GROUPS.values() for name in names)


class Outcome(NamedTuple):
    """A claim as it ended."""

    claim: Claim
    seconds: float
    trace: str = ""  #: of the exception, where there was one


def run_claim(name: str, effort: str, package: str = "validation") -> Outcome:
    """Run one claim; an exception becomes a claim that is not tested."""
    begin = time.perf_counter()
    try:
        claim = importlib.import_module(f"{package}.{name}").claim(effort)
        if not isinstance(claim, Claim):
            raise TypeError(f"claim() of {name} must return a Claim, got {type(claim).__name__}")
        if claim.name != name:
            raise ValueError(f"the claim of {name} must carry its module's name, got {claim.name!r}")
    except (Exception, SystemExit) as error:
        return not_tested(name, error, time.perf_counter() - begin)
    return Outcome(claim, time.perf_counter() - begin)


def send_claim(pipe: Any, name: str, effort: str, package: str) -> None:
    """Run one claim in a process of its own and send the outcome; whoever began the process answers Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with pipe:
        pipe.send(run_claim(name, effort, package))


def _end_with_parent() -> None:
    """End this process with the one that began it, however that ends."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def not_tested(name: str, error: BaseException, seconds: float) -> Outcome:
    """Say what went wrong, without the machine's paths, which have no place in a report."""
    text = "".join(traceback.format_exception_only(error)).strip().splitlines()[-1]
    text = text.replace(f"{Path.cwd()}{os.sep}", "").replace(sys.prefix, "...")
    return Outcome(Claim.broken(name, text), seconds, "".join(traceback.format_exception(error)))

"""The foot of the report: the command, the commit, the day, the machine and how long it took, without its names."""

import os
import platform
import re
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from html import escape
from math import ceil
from pathlib import Path

from mdr.tools.provenance import versions
from validation import CLAIMS
from validation.report import Claim


@dataclass(frozen=True)
class Made:
    """How a report is made, besides its effort."""

    asked: tuple[str, ...] = ()  #: names of the claims; () for those that there are
    seconds: float | None = None  #: of the run; None where it was not timed
    n_kept: int = 0  #: claims that an earlier run had done

    def missing(self, claims: Sequence[Claim]) -> int:
        """How many claims that were asked for are not there."""
        return len(set(self.asked) - {claim.name for claim in claims})

    def command(self, claims: Sequence[Claim], effort: str) -> str:
        """The command that makes the same report."""
        names = self.asked or tuple(claim.name for claim in claims)
        effort = "" if effort == "full" else f" --{effort}"
        some = "" if set(names) == set(CLAIMS) or not set(names) <= set(CLAIMS) else f" --only {' '.join(names)}"
        return f"python -m validation{effort}{some}"

    def foot(self, claims: Sequence[Claim], effort: str) -> str:
        """The sentence at the foot."""
        took = "" if self.seconds is None else f", in {ceil(self.seconds / 60)} min"
        kept = f"; {self.n_kept} of the claims by a run before, which was stopped" if self.n_kept else ""
        return (
            f"Made by <code>{escape(self.command(claims, effort))}</code> {commit()}, on {datetime.now(UTC):%Y-%m-%d}"
            f"{took} on {escape(machine())}, with {versions()}{kept}."
        )


def commit() -> str:
    """The commit of the sources, and whether they were edited since."""
    git = ["git", "-C", str(Path(__file__).parents[2])]
    with suppress(OSError, subprocess.CalledProcessError):
        asked = {"capture_output": True, "text": True, "check": True}
        name = subprocess.run([*git, "rev-parse", "--short=12", "HEAD"], **asked).stdout.strip()
        edited = subprocess.run([*git, "status", "--porcelain", "--untracked-files=no"], **asked).stdout
        return f"at commit {name}{' with edits' if edited.strip() else ''}"
    return "of no known commit"


def machine() -> str:
    """Cores, processor and system."""
    name = platform.processor() or platform.machine()
    with suppress(OSError):  # of Linux
        told = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
        name = told[1] if told else name
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return f"{cores} core{'s' if cores > 1 else ''} of {name}, {platform.system()} {platform.machine()}"

"""What several commands take: accuracy and whole numbers; quantities with a unit, or as multiples of v_c or mu_0."""

from __future__ import annotations

import argparse
import math
import re
import shlex
import warnings
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, TypeVar

import mdr
from mdr.case.paths import require_apart
from mdr.commands.output import WrongInput
from mdr.files.toml_text import StandardInput
from mdr.tools.notation import is_number, is_unit, number_in, parted, value_in

OF_V_C, OF_MU_0 = "v_c", "mu_0"  #: units of multiples
#: how a value begins that is no option, as -1e-3 and -0.5v_c; argparse itself knows -1 and -0.001 alone
NEGATIVE = re.compile(r"-[\d.]")
T = TypeVar("T")


def read_as(must_be: str, read: Callable[[str], T]) -> Callable[[str], T]:
    """What argparse reads an argument with: where `read` raises ValueError, it says what the argument must be."""

    def checked(text: str) -> T:
        try:
            return read(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be {must_be}, got {text!r}") from None

    return checked


def joined(given: Sequence[str]) -> list[str]:
    """The arguments, a unit that stands alone behind a number put to it: 5 mm/s without quotes."""
    found: list[str] = []
    for one in given:
        stands_behind = bool(found) and is_number(found[-1]) and parted(f"1 {one}") == ("1", one)
        if stands_behind and (is_unit(one) or one in (OF_V_C, OF_MU_0)):
            found[-1] += one
        else:
            found.append(one)
    return found


def path_of(text: str) -> str:
    """The path of a file as the command line gives it; - is standard input."""
    return StandardInput("standard input") if text == "-" else text


def whole_number(least: int, most: int = 100_000) -> Callable[[str], int]:
    """What argparse reads a whole number with; more springs, steps or points than `most` do not fit into memory."""

    def read(text: str) -> int:
        if not text.isascii() or not text.isdigit() or not least <= int(text[: len(str(most)) + 1]) <= most:
            raise ValueError
        return int(text)

    return read_as(f"a whole number from {least} to {most}", read)


def add_accuracy(command: argparse.ArgumentParser, of_what: str) -> None:
    """How accurate an answer is to be."""
    from mdr.march.periodic.steady import BUDGET, accuracy_of

    read = plain_number("-", "a number from 1e-8 to 1e-3", accuracy_of)
    meaning = f"{of_what}, 1e-8 to 1e-3 (default: {BUDGET:g})"
    command.add_argument("--accuracy", metavar="share", type=read, default=BUDGET, help=meaning)


def add_limit(command: argparse.ArgumentParser, what: str) -> None:
    """The end of a search that answers the best of `what` so far."""
    limit = f"computing time after which the best {what} so far are printed (status 1), as at Ctrl-C or SIGTERM (130)"
    read = plain_number("s", "a time such as 60s or 5min")
    command.add_argument("--limit", metavar="60s", type=read, help=limit)


def add_reading(command: argparse.ArgumentParser, *, of_time: bool = False) -> None:
    """What a CSV file does not say of itself; of one over time its rate too."""
    for name, value, what in (
        ("columns", "head", "what the header calls a column, or its number: a_x=x a_z=3; an empty head leaves it out"),
        ("units", "unit", "unit of a column whose header has none, such as t=ms a_x=g"),
    ):
        read = read_as(f"column={value}", _pair)
        command.add_argument(f"--{name}", metavar=f"column={value}", nargs="+", type=read, default=[], help=what)
    skip = "lines above the header of the CSV file (default: it is found)"
    command.add_argument("--skip", metavar="n", type=whole_number(0), help=skip)
    which, number_or_words = "which table of a file with several, from 1, or words above it", read_as("n", _which)
    command.add_argument("--table", metavar="n", type=number_or_words, help=which)
    if of_time:
        rate, what = plain_number("Hz", "a frequency such as 1kHz"), "samples a second, in the place of a column t"
        command.add_argument("--rate", metavar="1kHz", type=rate, help=what)
        volts = "of a sensor whose voltage was recorded: 100mV/g, 125mm/s/V; or of each, a_x=99mV/g a_z=101mV/g"
        command.add_argument("--sensitivity", metavar="100mV/g", nargs="+", help=volts)


def read_file(read: Callable[..., T], path: str, args: argparse.Namespace) -> T:
    """What a reader of the library makes of a CSV file; what it says names options in the place of its arguments."""
    given = {"columns": dict(args.columns), "units": dict(args.units), "skip": args.skip, "table": args.table}
    if hasattr(args, "rate"):
        of = args.sensitivity
        each = dict(one.split("=", 1) for one in of or () if "=" in one)
        given |= {"rate": args.rate, "sensitivity": each or (of and " ".join(of))}
    try:
        with warnings.catch_warnings(record=True) as told:
            return read(path, **given)
    except ValueError as refusal:
        raise WrongInput(in_options(str(refusal), vars(args))) from None
    finally:  # what was told on the way stands beside a refusal too
        for one in told:
            warnings.warn(in_options(str(one.message), vars(args)), one.category)


def each_once(pairs: Sequence[tuple[str, T]]) -> dict[str, T]:
    """Pairs of a path and what is said of it, by path. ValueError where two are of the same."""
    require_apart([path for path, _ in pairs])
    return dict(pairs)


def in_options(message: str, options: Iterable[str]) -> str:
    """A message in which arguments of a reader, as columns={"t": 1}, are options, --columns t=1."""

    def pairs(name: str, given: str) -> str:
        found = re.findall(r'"([^"]*)": (?:"([^"]*)"|([^,"]+))', given)
        return " ".join([f"--{name}", *(shlex.quote(f"{key}={word or bare}") for key, word, bare in found)])

    def option(given: re.Match[str]) -> str:
        if given[1]:
            return pairs(given[1], given[2])
        value = given[5].strip('()"').replace(",", " ")
        return " ".join([f"--{given[4].replace('_', '-')}", *value.split()]).removesuffix(" True")

    of_pairs = r"\b(columns|units)=\{([^{}]*)\}(,(?= units=))?"
    return re.sub(rf'{of_pairs}|\b({"|".join(options)})=(\([^()]*\)|"[^"]*"|[\w.+-]*)', option, message)


def _which(text: str) -> int | str:
    return int(text) if text.isdecimal() else text


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name and equals):
        raise ValueError
    return name, value


def plain_number(unit: str, must_be: str, checked: Callable[[float], float] = float) -> Callable[[str], float]:
    """What argparse reads a number with, in this unit where it has none; it says what the argument must be.

    `checked` raises ValueError for a number that it must not be.
    """
    return read_as(must_be, lambda text: checked(value_in("it", text, unit)))


class Asked(NamedTuple):
    """A quantity as it was given."""

    number: float  #: in SI, or a multiple
    of: str = ""  #: of v_c or mu_0, "" in SI

    def on(self, case: mdr.SlidingContact) -> float:
        """The value [SI] for a case. Raises WrongInput for a multiple where v_c is infinite or zero."""
        if self.of != OF_V_C:
            if self.of and not case.friction.is_coulomb:
                raise WrongInput(
                    f"{self.number:g} mu_0: with a shear strength mu_0 is not the friction; give a number, or in "
                    "`mdr find` --share"
                )
            return self.number * (case.mu_0 if self.of else 1)
        v_c = mdr.critical_velocity(case, -1 if self.number < 0 else 1)
        if wrong := no_scale(v_c):
            raise WrongInput(f"{self.number:g} v_c: {wrong}; give the velocity in m/s")
        return self.number * v_c


def quantity(name: str, unit: str, of: str = "") -> Callable[[str], Asked]:
    """What argparse reads a quantity with, in this unit where it has none; `of`: what it may be a multiple of."""

    def read(text: str) -> Asked:
        number, symbol = parted(text)
        if of == OF_MU_0 and symbol == "%":
            raise argparse.ArgumentTypeError(
                f"a COF in per cent may be of the load or of mu_0, got {text!r}: give the COF itself, as 0.2 or "
                f"0.7{OF_MU_0}, or in `mdr find` --share {text} of the friction without vibration"
            )
        try:
            if of and symbol == of:
                return Asked(number_in(number), of)
            return Asked(value_in(name, text, unit, of))
        except ValueError as wrong:
            raise argparse.ArgumentTypeError(str(wrong)) from None

    return read


velocity = quantity("a velocity", "m/s", OF_V_C)


def add_velocity(command: argparse.ArgumentParser) -> None:
    """The pulling velocity, without which nothing is done."""
    meaning = "pulling velocity: in m/s, with a unit or over v_c, as 1e-3, 1mm/s, 0.5v_c"
    command.add_argument("--v-0", required=True, metavar="velocity", type=velocity, help=meaning)
    command.usage = "%(prog)s case.toml --v-0 velocity [options]"


def no_scale(v_c: float) -> str:
    """Why velocities cannot be multiples of this v_c; empty where they can."""
    return "" if 0 < v_c < math.inf else f"v_c is {'zero' if v_c == 0 else 'infinite'} here"

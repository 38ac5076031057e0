"""`mdr export`: the contact of a case as a C header, or as a co-simulation unit."""

from __future__ import annotations

import argparse
import re
from functools import partial
from pathlib import Path
from textwrap import shorten

import mdr
from mdr.case.domain import COULOMB, Domain
from mdr.commands.arguments import plain_number, whole_number
from mdr.commands.output import WrongInput, answer, complain
from mdr.commands.written import require_free, write
from mdr.element.fmu import NoCompiler, fmu, sources
from mdr.normal.springs import MIN_SPRINGS
from mdr.tools.checks import positive

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")  #: what names in C may begin with


def add_options_of_export(command: argparse.ArgumentParser) -> None:
    """Where to write, how deep and how fine."""
    files = "the header, name.h, or the unit, name.fmu; all names in it begin with this one"
    command.add_argument("-o", "--output", metavar="file", type=Path, required=True, help=files)
    depth = "greatest depth of a step (default: 5 %% above that of the case)"
    read = plain_number("m", "a depth above zero such as 40um", partial(positive, ""))
    command.add_argument("--u-z-max", metavar="m", type=read, help=depth)
    # by default forces to some 1e-3, a step of an elastic contact in about 1 µs
    size = whole_number(MIN_SPRINGS, 4096)  # whose state a stack still holds
    command.add_argument("--n-springs", metavar="n", type=size, default=64, help="springs (default: 64)")


def export(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Write the header, or the unit; where nothing compiles it, its sources."""
    path: Path = args.output
    if path.suffix not in (".h", ".fmu"):
        raise WrongInput(f"-o {path}: the file must end in .h, a C header, or .fmu, a unit for co-simulation")
    name = path.stem
    Domain((COULOMB,), "mdr run or mdr curve").seen(case, "ContactElement")
    if not NAME.fullmatch(name):
        raise WrongInput(f"-o {path}: {name!r} must be a word for names in C: at most 40 letters, digits and _")
    require_free([path])
    # a little more than the greatest depth of the case, where none is asked for
    u_z_max = args.u_z_max or 1.05 * mdr.resolved(case).u_z_max
    element = mdr.ContactElement(case.indenter, case.material, case.mu_0, u_z_max=u_z_max, n_springs=args.n_springs)
    texts = sources(element, name, told(args, case))  # of the unit; its header is the one that is asked for alone
    try:
        write(path, texts[path.name].encode() if path.suffix == ".h" else fmu(texts, name))
    except NoCompiler as fault:
        files = {path.with_name(file): text.encode() for file, text in texts.items()}
        require_free([*files])
        for file, data in files.items():
            write(file, data)
        return complain(f"{path}: {fault}\nwritten are the sources: {', '.join(map(str, files))}")
    values = {"file": str(path), "u_z_max": u_z_max, "n_springs": element.n_springs, "n_state": element.n_state}
    size = f"{element.n_springs} springs, {element.n_state} numbers of state"
    text = f"{path}: depths up to u_z_max = {u_z_max:.6g} m, {size}"
    return answer(args, values, text, case)


def told(args: argparse.Namespace, case: mdr.SlidingContact) -> str:
    """The command, and shape, material and mu_0 of the case, a table a line."""
    tables = mdr.write_case(case).rstrip().split("\n\n")
    kept = [one for one in tables if one.startswith(("mu_0", "[fric", "[ind", "[mat"))]
    lines = [one.replace("]\n", "] ").replace("\n", ", ") for one in kept]
    return "\n".join(shorten(line, 116) for line in (args.command, *lines))  # fits a line of C

"""`mdr explore`: a page in the browser with the controls of a case and what they change."""

from __future__ import annotations

import argparse

import mdr
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.commands.arguments import path_of, whole_number
from mdr.commands.output import Exit, WrongInput, answer
from mdr.files.examples import example

INSTALL = (
    "mdr explore needs Panel and Bokeh, which are not installed ({missing}); in a checkout of the repository: "
    "python3 -m pip --python .venv install -e '.[explore]'"
)


def add_options(command: argparse.ArgumentParser) -> None:
    """The case, the port, and whether a browser is opened."""
    file = "the case file; - is standard input (default: the example of mdr case)"
    command.add_argument("case", metavar="case.toml", nargs="?", type=path_of, help=file)
    port = "port, 0 for a free one (default: %(default)s)"
    command.add_argument("--port", type=whole_number(0, 2**16 - 1), default=5006, help=port)  # Bokeh's own
    command.add_argument("--no-browser", action="store_true", help="print the address and open no browser")


def explore(args: argparse.Namespace, _: None) -> int:
    """Serve the page on this machine alone, until Ctrl-C."""
    case = example() if args.case is None else mdr.read_case(args.case)
    try:
        from mdr.explorer.server import server_of
    except ModuleNotFoundError as missing:
        if missing.name is None or missing.name.partition(".")[0] not in ("panel", "bokeh"):
            raise
        raise WrongInput(INSTALL.format(missing=missing)) from None
    try:
        velocity_scale(case)  # asks for its depth
    except ValueError as fault:
        raise WrongInput(f"{args.case}: {fault}") from None
    try:
        server, address = server_of(case, args.port)
    except OSError as taken:
        reason = taken.strerror or taken
        way_out = "give another, or --port 0 for a free one"
        raise WrongInput(f"port {args.port} cannot be used ({reason}); {way_out}") from None
    server.start()
    served = f"mdr explore: {address} on this machine alone; end it with Ctrl-C"
    answer(args, {"address": address}, served, case)
    if not args.no_browser:
        server.show("/")
    try:
        server.io_loop.start()
    except KeyboardInterrupt:  # how it is meant to end
        server.stop()
    return Exit.DONE

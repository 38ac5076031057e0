"""`mdr explore`: a page in the browser with the controls of a case and what they change."""

from __future__ import annotations

import argparse
from urllib.parse import urlsplit

import mdr
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.commands.arguments import path_of, read_as, whole_number
from mdr.commands.output import Exit, WrongInput, answer
from mdr.files.examples import example

INSTALL = "mdr explore needs Panel and Bokeh, which are not installed ({missing}): pip install panel bokeh"


def add_options_of_explore(command: argparse.ArgumentParser) -> None:
    """The case, the port, and whether a browser is opened."""
    file = "the case file; - is standard input (default: the example of mdr case)"
    command.add_argument("case", metavar="case.toml", nargs="?", type=path_of, help=file)
    port = "port, 0 for a free one (default: %(default)s)"
    command.add_argument("--port", type=whole_number(0, 2**16 - 1), default=5006, help=port)  # Bokeh's own
    beyond = "address of the page in a browser that comes by a tunnel to another port, or a proxy: localhost:8080"
    address = read_as(beyond.partition(": ")[2], _address)
    command.add_argument("--address", metavar="host:port", type=address, help=beyond)
    command.epilog = (
        "The page is served to this machine alone. From another one: ssh -L 5006:localhost:5006 this-machine, and open"
        " http://localhost:5006 there. Where the tunnel begins at another port, -L 8080:localhost:5006, add --address"
        " localhost:8080."
    )
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
        server, own = server_of(case, args.port, args.address or "")
    except OSError as taken:
        reason = taken.strerror or taken
        way_out = "give another, or --port 0 for a free one"
        raise WrongInput(f"port {args.port} cannot be used ({reason}); {way_out}") from None
    server.start()
    where = f"{args.address}, served at {own} on this machine" if args.address else f"{own} on this machine alone"
    answer(args, {"address": args.address or own}, f"mdr explore: {where}; end it with Ctrl-C", case)
    if not (args.no_browser or args.address):
        server.show("/")
    try:
        server.io_loop.start()
    except KeyboardInterrupt:  # how it is meant to end
        server.stop()
    return Exit.DONE


def _address(text: str) -> str:
    """An address with its host and, unless it is that of the scheme, its port; a port alone is one of localhost."""
    text = f"localhost:{text}" if text.isdigit() else text
    parts = urlsplit(text if "://" in text else f"http://{text}")
    if parts.scheme not in ("http", "https") or not parts.hostname or parts.port == 0 or parts.netloc.endswith(":"):
        raise ValueError
    return f"{parts.scheme}://{parts.netloc}/"

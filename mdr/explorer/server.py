"""The server of the explorer: on the loopback address alone, with all that the page needs from this machine."""

from __future__ import annotations

import logging
import re
import socket
import sys
from typing import Any
from urllib.parse import urlsplit

import panel as pn
from bokeh.settings import settings
from tornado.websocket import WebSocketClosedError

from mdr.case.contact import SlidingContact
from mdr.explorer.page import page_of

HOST = "127.0.0.1"


def server_of(case: SlidingContact, port: int, address: str) -> tuple[Any, str]:
    """A server that is about to run, and its address. OSError if the port is taken; 0 takes a free one.

    `address`: that of the page in a browser beyond a tunnel or a proxy, where it is another one, else "".
    """
    import matplotlib as mpl

    mpl.use("svg")
    settings.resources = "server"  # whatever the environment says, nothing comes from elsewhere
    logging.getLogger("asyncio").addFilter(is_worth_saying)
    logging.getLogger("bokeh.server.views.ws").addFilter(in_own_words)
    port = port or _free_port()
    own = f"http://{HOST}:{port}/"
    beyond = [urlsplit(address).netloc] if address else []
    server = pn.serve(
        {"/": lambda: page_of(case)}, port=port, address=HOST, title="mdr explore", location=False,
        websocket_origin=[f"{HOST}:{port}", f"localhost:{port}", *beyond], show=False, start=False, verbose=False,
    )  # fmt: skip
    return server, own


def is_worth_saying(record: logging.LogRecord) -> bool:
    """Whether a message of the server is more than that a page was closed while something was sent to it."""
    return not (record.exc_info and isinstance(record.exc_info[1], WebSocketClosedError))


def in_own_words(record: logging.LogRecord) -> bool:
    """False for what Bokeh says, in its own options, of a page that came by another address: it is said here."""
    found = re.search(r"websocket connection from Origin '([^']*)'", record.getMessage())
    if found:
        print(f"mdr: the page was opened as {found[1]}: start with --address {found[1]}", file=sys.stderr, flush=True)
    return found is None


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])

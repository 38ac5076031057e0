"""The server of the explorer: on the loopback address alone, with all that the page needs from this machine."""

from __future__ import annotations

import logging
import socket
from typing import Any

import panel as pn
from bokeh.settings import settings
from tornado.websocket import WebSocketClosedError

from mdr.case.contact import SlidingContact
from mdr.explorer.page import page_of

HOST = "127.0.0.1"


def server_of(case: SlidingContact, port: int) -> tuple[Any, str]:
    """A server that is about to run, and its address. OSError if the port is taken; 0 takes a free one."""
    import matplotlib as mpl

    mpl.use("svg")
    settings.resources = "server"  # whatever the environment says, nothing comes from elsewhere
    logging.getLogger("asyncio").addFilter(is_worth_saying)
    port = port or _free_port()
    server = pn.serve(
        {"/": lambda: page_of(case)}, port=port, address=HOST, title="mdr explore", location=False,
        websocket_origin=[f"{HOST}:{port}", f"localhost:{port}"], show=False, start=False, verbose=False,
    )  # fmt: skip
    return server, f"http://{HOST}:{port}/"


def is_worth_saying(record: logging.LogRecord) -> bool:
    """Whether a message of the server is more than that a page was closed while something was sent to it."""
    return not (record.exc_info and isinstance(record.exc_info[1], WebSocketClosedError))


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])

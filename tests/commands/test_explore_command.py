"""`mdr explore` until its page is served: what it refuses, and what it prints. The page itself: tests/explorer/."""

import logging
import socket
from dataclasses import replace
from types import SimpleNamespace

import matplotlib as mpl
import pytest
from answers import file_of, json_of, words_of
from conftest import contact

import mdr

pytest.importorskip("panel")
from bokeh.server.util import check_allowlist
from tornado.websocket import WebSocketClosedError

from mdr.explorer.server import in_own_words, is_worth_saying, server_of


@pytest.fixture(autouse=True)
def pictures():
    """Those of the page are SVG; other tests want the rows of their pixels."""
    yield
    mpl.use("Agg")


@pytest.fixture
def server(monkeypatch):
    """A server that is interrupted as soon as it listens; what happened to it."""
    said = []

    def wait():
        said.append("waits")
        raise KeyboardInterrupt

    one = SimpleNamespace(
        start=lambda: said.append("starts"),
        show=lambda place: said.append(f"shows {place}"),
        stop=lambda: said.append("stops"),
        io_loop=SimpleNamespace(start=wait),
    )
    monkeypatch.setattr("mdr.explorer.server.server_of", lambda case, port, _: (one, f"http://127.0.0.1:{port}/"))
    return said


def test_it_serves_until_an_interrupt(capsys, server):
    assert words_of(capsys, ["explore", "--port", "5100"]).out == (
        "mdr explore: http://127.0.0.1:5100/ on this machine alone; end it with Ctrl-C\n"
    )
    assert server == ["starts", "shows /", "waits", "stops"]


def test_it_opens_no_browser_and_speaks_to_machines_where_asked(capsys, server):
    told = json_of(capsys, ["explore", "--no-browser", "--json", "--port", "5100"])
    assert told["address"] == "http://127.0.0.1:5100/"
    assert "shows /" not in server


@pytest.mark.parametrize(
    ("given", "address"),
    [("localhost:8080", "http://localhost:8080/"), ("http://10.0.0.7:81/", "http://10.0.0.7:81/"),
     ("https://lab.example", "https://lab.example/"), ("8080", "http://localhost:8080/")],
)  # fmt: skip
def test_behind_a_tunnel_it_prints_the_address_there(capsys, server, given, address):
    said = words_of(capsys, ["explore", "--port", "5100", "--address", given]).out
    assert said.startswith(f"mdr explore: {address}, served at http://127.0.0.1:5100/")
    assert "shows /" not in server  # no browser here knows that address


def test_a_page_by_another_address_is_let_in_where_it_is_named(capsys):
    for address, let_in in (("", False), ("http://localhost:8080/", True)):
        server, own = server_of(contact("flat"), 0, address)
        origins = server._tornado.websocket_origins
        assert check_allowlist("localhost:8080", origins) is let_in
        assert check_allowlist(own.strip("/").removeprefix("http://"), origins)
        server.stop()
    refused = "Refusing websocket connection from Origin '%s'; use --allow-websocket-origin=%s"
    parts = ("http://localhost:8080", "localhost:8080")
    assert not in_own_words(logging.LogRecord("bokeh", 40, "", 0, refused, parts, None))
    assert "start with --address http://localhost:8080" in capsys.readouterr().err
    assert in_own_words(logging.LogRecord("bokeh", 40, "", 0, "something else", (), None))


def test_a_load_without_a_depth_is_status_2(capsys, tmp_path):
    punch, load = mdr.ConcavePunch(1e-3, 1.0), mdr.LoadOscillation(1e-9, 1e-10, 300)
    path = file_of(replace(contact("flat"), indenter=punch, oscillation=load), tmp_path / "case.toml")
    assert path in words_of(capsys, ["explore", path], 2).err


def test_a_port_that_is_taken_is_status_2(capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        said = words_of(capsys, ["explore", "--no-browser", "--port", str(port)], 2).err
    assert f"port {port} cannot be used (" in said


def test_a_page_that_is_closed_is_no_fault():
    """A picture on its way to it is lost, of which the server would print a traceback."""

    def told(error):
        return is_worth_saying(logging.LogRecord("asyncio", 40, "", 0, "", None, error and (type(error), error, None)))

    assert not told(WebSocketClosedError())
    assert told(ValueError())
    assert told(None)

"""Changes of a page as one message to the browser."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def in_one_message(document: Any, change: Callable[[], None]) -> None:
    """Call what changes a page soon, from any thread, and send all of it together. document: that of Bokeh.

    Bokeh calls it with the lock of the document, and sends by itself. What Panel sends without the lock, as its own
    `hold` does, may meet another message and stay behind until the next change (Panel 1.9.4).
    """

    def held() -> None:
        document.hold("combine")
        try:
            change()
        finally:
            document.unhold()

    document.add_next_tick_callback(held)

"""Changes of a page sent together: what one event brings is one message to the browser, in the order of the events."""

from __future__ import annotations

import panel as pn


def together() -> None:
    """Collect all that changes on the page from here on. Its document sends it soon, as one message.

    Bokeh sends then, with the lock of the document. What Panel sends by itself, without the lock, may meet another
    message and stay behind until the next change, or be overtaken by a later one (Panel 1.9.4).
    """
    document = pn.state.curdoc
    if document is not None and not document.callbacks.hold_value:
        document.add_next_tick_callback(document.unhold)
        document.hold("combine")

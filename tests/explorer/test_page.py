"""The page without a browser: what changes it, and what it refuses."""

import pytest

import mdr

pytest.importorskip("panel")
DEPTH = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
CASE = mdr.SlidingContact(mdr.Cone(theta=0.0127), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3), 0.4, DEPTH)


def test_a_value_that_is_refused_leaves_the_state():
    """A dashpot so slow is a record, but no control can show the group that it makes."""
    from bokeh.document import Document
    from panel.io.state import set_curdoc

    from mdr.explorer.page import Page
    from mdr.explorer.state import State

    with set_curdoc(Document()):
        page = Page(State.of(CASE))
    assert "tau = 1e+09 s is more than" in page.attempt(lambda state: state.changed("material.tau", 1e9))
    assert page.state.case == CASE
    assert page.attempt(lambda state: state.changed("material.tau", 2e-3)) == ""
    assert page.state.case.material.tau == 2e-3


def test_empty_pictures_say_what_they_wait_for_and_friction_begins_where_it_is_asked():
    from bokeh.document import Document
    from panel.io.state import set_curdoc

    from mdr.explorer.page import COMPILING, NOTHING, Page
    from mdr.explorer.pictures import at_once, pictures_of
    from mdr.explorer.state import State

    state = State.of(CASE)
    with set_curdoc(Document()):
        page = Page(state)
        words = [page.curve.word, *page.over_period.words]
        for told in (COMPILING.format(7), NOTHING):
            page._wait(told)
            assert [one.text for one in words if one.visible] == [told] * 4
        page._ask()
        page.pictures.drop()
        assert [part.styles["opacity"] for part in page.faded.values()] == ["1", "1"]  # words are read
        page._draw(at_once(state))  # what is known in closed form alone
        assert [one.visible for one in words] == [False, True, True, True]
        page._draw([*pictures_of(state)][-1])
        assert not any(one.visible for one in words)
        page._ask()
        page.pictures.drop()
        assert [part.styles["opacity"] for part in page.faded.values()] == ["0.4", "0.4"]
        axis = page.curve.figure.y_range
        low, high = axis.start, axis.end
        assert 0 < low < high
        page._begin(True)
        assert (axis.start, axis.end, axis.reset_start) == (0.0, high, 0.0)
        page._begin(False)
        assert (axis.start, axis.end) == (low, high)


def test_changes_leave_together_when_the_document_calls():
    from bokeh.document import Document
    from bokeh.document.events import ModelChangedEvent
    from bokeh.models import Div
    from panel.io.state import set_curdoc

    from mdr.explorer.together import together

    document, left, right, seen = Document(), Div(text=""), Div(text=""), []
    for one in (left, right):
        document.add_root(one)
    document.on_change(lambda event: seen.append(event) if isinstance(event, ModelChangedEvent) else None)
    with set_curdoc(document):
        for text in "abc":
            together()
            left.text, right.text = text, "d"
    assert not seen
    (called,) = document.session_callbacks
    called.callback()
    assert {event.model: event.new for event in seen} == {left: "c", right: "d"}
    left.text = "e"
    assert seen[-1].new == "e"

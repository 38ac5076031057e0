"""Times of the explorer: from a slider that moves to new data, and to the picture in the browser.

`python tests/time_of_explorer.py [moves]` prints median and 95 % of them in ms, of three cases. A move is another value
of one slider, once the picture of the move before is there. "first" is the curve without a bound on its error, with the
run; "bounded" the curve that replaces it, begun after a rest (page.REST). Data are timed without that rest, and in
brackets by the time of the processor, which other work on the machine does not change. In the browser the clock runs in
the page, from the value to the frame after the one that draws.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from chromium import Browser, chromium, explorer

import mdr
from mdr.explorer.controls import controls_of
from mdr.explorer.pictures import pictures_of
from mdr.explorer.state import State
from mdr.files.examples import example

CASES = {
    "rigid pull": example(pull="RigidPull"),
    "body on a spring": example(),
    "oblique shake": example(shake="InPlaneOscillation"),
}
PATH = "oscillation.du_z"
#: moves a slider to a place; answers the milliseconds until both pictures were drawn
MOVE = """
const [path, place, answer] = arguments, page = Bokeh.documents[0], times = [];
const models = [...page._all_models.values()];
const slider = models.find(one => one.type === 'Slider' && one.css_classes.includes(path));
const change = page.get_model_by_name('curve').properties.data.change;
const begin = performance.now();
const drawn = () => requestAnimationFrame(() => requestAnimationFrame(() => {
  times.push(performance.now() - begin);
  if (times.length === 2) { change.disconnect(drawn); answer(times); }
}));
change.connect(drawn);
slider.value = place;
"""


def places(control, moves):
    """Places of a slider, to and fro about the middle, none the same as the one before."""
    middle = len(control.grid) // 2
    return [middle + 20 + move % 30 if move % 2 else middle - 20 - move % 30 for move in range(moves)]


def in_model(case, moves):
    """Milliseconds (moves, 4) from a value to the data of both pictures, by the clock and of the processor."""
    state, times = State.of(case), []
    control = next(one for one in controls_of(state)["oscillation"] if one.path == PATH)
    for place in places(control, moves):
        begin = np.array([time.perf_counter(), time.thread_time()])
        state = state.changed(PATH, control.grid[place])
        ends = [np.array([time.perf_counter(), time.thread_time()]) - begin for _ in pictures_of(state)]
        times.append(np.array(ends).T.ravel())
    return 1e3 * np.array(times)


def in_browser(case, moves, folder):
    """The same until they are drawn."""
    path = folder / "case.toml"
    path.write_text(mdr.write_case(case), encoding="utf-8")
    control = next(one for one in controls_of(State.of(case))["oscillation"] if one.path == PATH)
    with explorer(path) as (address, _), chromium(folder) as driver:
        page = Browser(driver, address, folder)
        times = []
        for place in places(control, moves):
            times.append(driver.execute_async_script(MOVE, PATH, place))
            time.sleep(0.1)  # the texts below the pictures
        assert not page.errors()
    return np.array(times)


def main(moves=50):
    print(f"{'ms: median, 95 %':<18}{'data: first':>20}{'bounded':>20}{'browser: first':>16}{'bounded':>16}")
    for name, case in CASES.items():
        in_model(case, 2)  # compiled code is loaded
        with tempfile.TemporaryDirectory() as folder:
            both = np.hstack([in_model(case, moves), in_browser(case, moves, Path(folder))])
        middle, most = np.median(both, axis=0), np.percentile(both, 95, axis=0)
        first, bounded, cpu_first, cpu_bounded, *drawn = [
            f"{a:.0f}, {b:.0f}" for a, b in zip(middle, most, strict=True)
        ]
        cells = f"{f'{first} ({cpu_first})':>20}{f'{bounded} ({cpu_bounded})':>20}"
        print(f"{name:<18}{cells}{drawn[0]:>16}{drawn[1]:>16}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

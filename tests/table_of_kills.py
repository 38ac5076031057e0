"""Twenty kills at random instants of one study: how far each life came, and whether anything was lost or done twice.

`python tests/table_of_kills.py [n]` takes a quarter of a minute. The study has 240 units of 5 ms; its store is compared
in size and in every byte with that of a study that was never interrupted.
"""

import os
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent / "studies"))

from grids import LOG, long_study
from kills import live, same_values


def main(n: int) -> int:
    """Print the table; 0 if the store of the killed study is that of one never killed, and nothing was done twice."""
    rng = np.random.default_rng(20)
    with tempfile.TemporaryDirectory() as folder:
        killed, whole = Path(folder) / "killed", Path(folder) / "whole"
        print(f"{'life':>4} {'lasted':>7} {'end':>8} {'chunks':>9} {'computed':>8} {'again':>6}")
        lives = []
        while not (killed / "study.nc").exists():
            done = len(lives) >= n
            at_work = bool(rng.uniform() < 0.8)
            patience = rng.uniform(0.0, 0.08 if at_work else 0.8)
            lives.append(live(killed, Path(folder) / "log", 600.0 if done else patience, at_work))
            one = lives[-1]
            chunks = f"{one.before:>3} -> {one.after}" if one.killed else f"{one.before:>3} -> all"
            end = "killed" if one.killed else "finished"
            print(f"{len(lives):4} {one.lasted:5.2f} s {end:>8} {chunks:>9} {one.computed:8} {one.twice:6}")
        os.environ[LOG] = str(Path(folder) / "log of the whole")
        long_study(whole)
        sizes = [{path.name: path.stat().st_size for path in sorted(store.iterdir())} for store in (killed, whole)]
        equal = all((killed / name).read_bytes() == (whole / name).read_bytes() for name in sizes[1])
        print(f"store of the killed study  {sizes[0]}\nstore never interrupted    {sizes[1]}")
        print(
            f"equal in every byte: {equal}; units of finished chunks computed again: {sum(one.twice for one in lives)}"
        )
        kills, units = sum(one.killed for one in lives), sum(one.computed for one in lives)
        print(f"{kills} kills; {units} units computed for 240, the others for the plan or in flight")
        sound = equal and sizes[0] == sizes[1] and same_values(killed)
        return 0 if sound and not any(one.twice for one in lives) else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 20))

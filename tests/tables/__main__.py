"""Tables of random contacts, run by hand: `python tests/tables NAME [n]`, exit status 1 where one does not hold.

    turning [n] [bodies] [along]  true error of slide() under a shake across the pull, or along it, beside the twin
    strength [n] [level]  the same on faces with a shear strength, round or level
    errors [n] [coarse | resonant]  true error of slide() against finer steps and springs
    theorems [n]          what no settled run may contradict, on random bodies
    steps [n] [seed] [any | nan]  steps of elements with arms, any material, beside the same in 400 parts
    ways [n] [quick]      one motion written in six ways: no function may tell them apart

Each takes minutes for its n contacts; its docstring says more.
"""

import sys
from importlib import import_module
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    name, *rest = sys.argv[1:]
    sys.exit(import_module(f"tables.{name}").main(*(int(one) if one.isdigit() else one for one in rest)))

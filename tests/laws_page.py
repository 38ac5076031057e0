"""The table of the guide's page of laws: which contacts each closed form holds for, read off its domain.

`.venv/bin/python tests/laws_page.py` writes it anew; the text around it is kept.
"""

from collections import defaultdict
from pathlib import Path

import mdr
from mdr.case.domain import Domain
from mdr.closed_forms import rigid_pull

PAGE = Path(__file__).parents[1] / "docs" / "api" / "laws.md"
#: columns, and the quantities of a case that each is about; what is about none of these stands in the last
COLUMNS = {"friction": "friction", "pull": "pull", "shake": "shake", "depth": "oscillation", "material": "material"}
#: what a name is called by, where it is looked up, and the names in order
ROOMS = {
    "mdr.": (mdr, mdr.__all__),
    "mdr.laws.": (mdr.laws, mdr.laws.__all__),
    "mdr.closed_forms.rigid_pull.": (rigid_pull, ("average_friction", "near_critical", "small_velocity")),
}


def row(names: list[str], domain: Domain) -> str:
    """What laws of one domain take."""
    cells: dict[str, list[str]] = {quantity: [] for quantity in [*COLUMNS.values(), ""]}
    for one in domain.conditions:
        part = one.quantity.partition(".")[0]
        cells[part if part in cells else ""].append(one.words)
    told = [", ".join(f"`{name}`" for name in names), *map(", ".join, cells.values()), domain.instead]
    return f"| {' | '.join(told)} |"


def table() -> str:
    """The table as it must read."""
    head, laws = ["law", *COLUMNS, "and", "else ask"], defaultdict(list)
    for where, (room, names) in ROOMS.items():
        for name in names:
            if isinstance(domain := getattr(getattr(room, name), "domain", None), Domain):
                laws[domain].append(where + name)
    rows = [row(names, domain) for domain, names in laws.items()]
    return "\n".join([f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}", *rows])


def page() -> str:
    """The page as it must read."""
    above, _, below = PAGE.read_text(encoding="utf-8").partition("| law |")
    return f"{above}{table()}\n\n{below[below.index('```{eval-rst}') :]}"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")

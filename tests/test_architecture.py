"""The rooms of mdr/ and who may import whom, read off the imports of every file, also those inside functions.

Pictures read records by attribute, and stand below what makes these, so that `run.plot()` runs down like all else. One
door leads upwards: inside its method `read` a record may import what reads it from a file.
"""

import ast
from pathlib import Path
from typing import NamedTuple

import pytest

import mdr
from mdr.tools import sources

HOUSE = Path(mdr.__file__).parent
#: Rooms from the first to the last; a room imports from itself and from earlier ones. Two of one rank know nothing of
#: each other.
ORDER = (
    ("tools",),
    ("indenters",),
    ("materials",),
    ("case", "spring"),
    ("files", "normal", "plots"),
    ("given",),
    ("closed_forms", "element", "half_space", "march"),
    ("friction",),
    ("studies",),
    ("explorer",),
    ("commands",),
)
RANK = {room: rank for rank, rooms in enumerate(ORDER) for room in rooms}
DOORS = ("read",)  # methods of records that may import upwards
OUTSIDE = {"mdr", "mdr.__main__"}  # of any room: the public names and the command
#: The one place that asks both springs and the half-space, to set them side by side.
JUDGED = {("mdr.friction.verdict", "mdr.half_space")}


class Import(NamedTuple):
    module: str
    imported: str  # a module of the package
    door: bool  # whether it stands in a method that may import upwards


def modules(house):
    """The modules of a package by their names."""
    package = house.name
    names = {}
    for path in sorted(house.rglob("*.py")):
        parts = [package, *path.relative_to(house).with_suffix("").parts]
        names[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return names


def imports_of(module, path, known):
    """What a module imports of the package, wherever in its text the import stands."""
    package, found = module.partition(".")[0], set()

    def visit(node, in_class, door):
        if isinstance(node, ast.ClassDef):
            in_class = True
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            door = door or (in_class and node.name in DOORS)
        elif isinstance(node, ast.Import):
            found.update((one.name, door) for one in node.names if one.name.partition(".")[0] == package)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: imports are written in full"
            if node.module.partition(".")[0] == package:
                for one in node.names:
                    whole = f"{node.module}.{one.name}"
                    found.add((whole if whole in known else node.module, door))
        for child in ast.iter_child_nodes(node):
            visit(child, in_class, door)

    visit(ast.parse(path.read_text(encoding="utf-8")), False, False)
    return {Import(module, one, door) for one, door in found if one != module}


def house_of(folder):
    """Modules of a package and all imports between them."""
    known = modules(folder)
    return known, {one for module, path in known.items() for one in imports_of(module, path, known)}


def reach(imports, start, without=()):
    """Every module that those of `start` import, directly or through others, each with the way to it."""
    onward = {}
    for module, imported, _ in imports:
        if (module, imported) not in without:
            onward.setdefault(module, set()).add(imported)
    ways, todo = {module: (module,) for module in start}, list(start)
    while todo:
        module = todo.pop()
        for one in sorted(onward.get(module, ())):
            if one not in ways:
                ways[one] = (*ways[module], one)
                todo.append(one)
    return ways


def circles(imports):
    """Groups of modules that import each other, directly or through others."""
    reached = {module: set(reach(imports, [module])) for module, _, _ in imports}
    groups = {
        tuple(sorted(one for one in reached[module] if module in reached.get(one, ()))) for module, _, _ in imports
    }
    return sorted(group for group in groups if len(group) > 1)


def room_of(module):
    """The room that a module stands in; "" for what stands in none."""
    return module.split(".")[1] if module.count(".") > 1 or module.partition(".")[2] in RANK else ""


def ways_between(imports, known, start, goals, without=()):
    """The ways from one set of modules to another, as text."""
    ways = reach(imports, sorted(start), without)
    return [" -> ".join(ways[goal]) for goal in sorted(set(goals) & set(ways) - set(start))]


@pytest.fixture(scope="module")
def house():
    return house_of(HOUSE)


def test_every_module_stands_in_a_room(house):
    known, _ = house
    assert [module for module in known if module not in OUTSIDE and room_of(module) not in RANK] == []
    assert set(RANK) <= {room_of(module) for module in known}


def test_a_room_imports_from_itself_and_from_earlier_ones(house):
    _, imports = house
    wrong = [
        f"{module} -> {imported}"
        for module, imported, door in sorted(imports)
        if module not in OUTSIDE and not door and not may_import(room_of(module), room_of(imported))
    ]
    assert wrong == []


def may_import(room, other):
    if room not in RANK or other not in RANK:
        return room == "commands" and not other  # commands use the public names
    return room == other or RANK[other] < RANK[room]


def test_the_door_leads_to_files(house):
    """A method that may import upwards imports what reads the record from a file, and no more."""
    _, imports = house
    upwards = {
        imported for module, imported, door in imports if door and not may_import(room_of(module), room_of(imported))
    }
    assert {room_of(module) for module in upwards} == {"files"}


def test_no_circles(house):
    _, imports = house
    assert circles(imports) == []


SOLVERS = {"normal", "closed_forms", "march", "friction", "studies"}
#: rooms or modules, those that they must not reach by any way, and why
WALLS = {
    "closed forms know no march, so that their agreement is evidence": ({"closed_forms"}, {"march"}),
    "the march knows no closed form": ({"march"}, {"closed_forms"}),
    "the half-space knows no springs, so that they have a judge": (
        {"half_space"}, {"march", "friction", "mdr.normal.springs"}),
    "springs know no half-space": ({"march", "friction", "mdr.normal.springs"}, {"half_space"}),
    "the measured velocity knows no closed form": ({mdr.measure_critical_velocity.__module__}, {"closed_forms"}),
    "a record never solves": ({"case"}, SOLVERS),
    "pictures compute nothing": ({"plots"}, SOLVERS),
    "a reader does not solve": ({"files"}, {"given", *SOLVERS}),
    "the normal problem knows none of the words of users": ({"normal"}, {"given", "mdr.case.paths"}),
}  # fmt: skip


@pytest.mark.parametrize("wall", WALLS)
def test_no_way_leads_through_a_wall(house, wall):
    known, imports = house
    start, goals = ({one for one in known if one in of or room_of(one) in of} for of in WALLS[wall])
    assert start
    assert goals
    no_doors = {one for one in imports if not one.door}
    assert ways_between(no_doors, known, start, goals, JUDGED) == []


def test_the_normal_motion_of_a_spring_has_no_friction_in_it(house):
    """What closed forms use of a spring is `settle`; nothing that it reaches, by any import, moves a spring by
    friction: contact.py is handed None for it, and knows of a face but its limit.
    """
    _, imports = house
    reached = set(reach(imports, ["mdr.spring.settle"]))
    assert "mdr.spring.contact" in reached
    assert not reached & {f"mdr.spring.{name}" for name in ("line", "disc", "dragged", "whole", "row")}


def test_the_compiled_march_knows_numbers_alone(house):
    """No shape, no case and no spring array."""
    _, imports = house
    assert {room_of(module) for module in reach(imports, ["mdr.march.dynamics.loop"])} == {"march", "spring", "tools"}


def test_the_cache_of_compiled_code_sees_all_that_is_compiled_in(house):
    _, imports = house
    compiled = {one.module for one in imports if one.imported == "mdr.tools.jit"}
    assert set(reach(imports, sorted(compiled))) <= sources.compiled()
    assert len(sources.compiled()) < 44  # an edit of any other file compiles nothing


def test_commands_do_not_need_the_page(house):
    """Of the explorer, commands know what serves it."""
    _, imports = house
    asked = {imported for module, imported, _ in imports if room_of(module) == "commands"}
    assert {module for module in asked if room_of(module) == "explorer"} == {"mdr.explorer.server"}


def test_imports_are_found_wherever_they_stand(tmp_path):
    """Also under TYPE_CHECKING, in functions and in methods; circles through them are circles."""
    package = tmp_path / "toy"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "a.py").write_text("def solve():\n    from toy import b\n")
    (package / "b.py").write_text("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from toy.c import C\n")
    (package / "c.py").write_text("class C:\n    def read(self):\n        import toy.a\n")
    _, imports = house_of(package)
    assert sorted(imports) == [("toy.a", "toy.b", False), ("toy.b", "toy.c", False), ("toy.c", "toy.a", True)]
    assert circles(imports) == [("toy.a", "toy.b", "toy.c")]

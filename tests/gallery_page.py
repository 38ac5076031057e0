"""The gallery of the guide: every script of geometries/ with its question, its picture and a link to it.

`.venv/bin/python tests/gallery_page.py` draws all pictures and writes docs/gallery.md anew; with names of scripts it
draws theirs alone. The text above the first entry of the page is kept.
"""

import ast
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE, PICTURES, SCRIPTS = ROOT / "docs" / "gallery.md", ROOT / "docs" / "figures" / "gallery", ROOT / "geometries"
WIDTH, COLOURS = 960, (128, 64, 32)  #: of a picture, in pixels, and how many: the most that its file has room for
MOST_BYTES = 4e4
SYMBOL = re.compile(r"\b\w_\w\b|\b[fg]\([rx]\)")  #: v_c or g(x) in a caption


def names() -> list[str]:
    """Scripts in the order of the page: those about all shapes last, whose small pictures want a full screen."""
    last = ["depths", "gallery"]
    return sorted({path.stem for path in SCRIPTS.glob("*.py")} - set(last)) + last


def entry(name: str) -> str:
    """One script on the page: the first line of its docstring, and of that of its figure()."""
    tree = ast.parse((SCRIPTS / f"{name}.py").read_text(encoding="utf-8"))
    title, _, question = (ast.get_docstring(tree) or "").partition("\n")[0].partition(": ")
    figure = next((one for one in tree.body if isinstance(one, ast.FunctionDef) and one.name == "figure"), None)
    shown = ((figure and ast.get_docstring(figure)) or "").partition("\n")[0]
    if not (question and shown):
        raise SystemExit(f"{name}.py must begin with '<title>: <question>', and its figure() with a caption")
    caption = SYMBOL.sub(r"$\g<0>$", shown)
    return (
        f"## {title}\n\n{question[0].upper()}{question[1:]}\n\n"
        f"![{title}](figures/gallery/{name}.png)\n\n*{caption}* [{name}.py](../geometries/{name}.py)\n"
    )


def page() -> str:
    """The page as it must read."""
    head = PAGE.read_text(encoding="utf-8").partition("\n## ")[0]
    return "\n".join([head.rstrip() + "\n", *map(entry, names())])


def draw(name: str) -> None:
    """Run a script and keep its figure as a small picture."""
    import matplotlib.pyplot as plt
    from PIL import Image
    from test_geometries import script

    module = script(name)
    figure = getattr(module, "in_gallery", module.figure)()
    path = PICTURES / f"{name}.png"
    figure.savefig(path, dpi=WIDTH / figure.get_size_inches()[0])
    plt.close(figure)
    with Image.open(path) as drawn:
        picture = drawn.convert("RGB")
    for colours in COLOURS:
        picture.quantize(colours, dither=Image.Dither.NONE).save(path, optimize=True)
        if path.stat().st_size < MOST_BYTES:
            break
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


def main() -> None:
    """Draw, and write the page."""
    import matplotlib as mpl

    mpl.use("Agg")
    sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "guide")]
    PICTURES.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[1:] or names():
        draw(name)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()

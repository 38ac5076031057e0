"""The outputs of the student's notebook, as its file keeps them: what is printed, and small pictures.

`.venv/bin/python tests/notebook_outputs.py` runs docs/springs.ipynb in a kernel and stores them anew.
"""

import os
import tempfile
from base64 import b64decode, b64encode
from io import BytesIO
from pathlib import Path

ROOT = Path(__file__).parents[1]
NOTEBOOK = ROOT / "docs" / "springs.ipynb"
COLOURS = 32  #: of a picture


def main() -> None:
    """Run, and write the file."""
    import nbformat
    from nbclient import NotebookClient

    os.environ["PYTHONPATH"] = str(ROOT)
    notebook = nbformat.read(NOTEBOOK, 4)
    about = dict(notebook.metadata)
    with tempfile.TemporaryDirectory() as folder:
        place = {"metadata": {"path": folder}}
        NotebookClient(notebook, kernel_name="python3", timeout=None, record_timing=False, resources=place).execute()
    notebook.metadata = about  # a kernel adds its version
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = [compact(one) for one in cell.outputs if one.get("name") != "stderr"]  # progress
    nbformat.write(notebook, NOTEBOOK)
    print(f"{NOTEBOOK.name}: {NOTEBOOK.stat().st_size / 1000:.0f} kB")


def compact(output):
    """An output whose picture has few colours."""
    from PIL import Image

    if png := output.get("data", {}).get("image/png"):
        small = BytesIO()
        with Image.open(BytesIO(b64decode(png))) as picture:
            picture.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(small, "png", optimize=True)
        output.data["image/png"] = b64encode(small.getvalue()).decode()
    return output


if __name__ == "__main__":
    main()

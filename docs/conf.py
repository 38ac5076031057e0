"""The guide as a site: `python -m sphinx -W docs site` writes pages into site/ that need no network.

Pages are plain Markdown, readable as they are. What a page cannot say of itself stands here: their order, and how
equations are set (extensions/). Docstrings are numpydoc; the notebook is shown with its stored outputs (myst-nb).
"""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "mdr-friction"
author = copyright = "The mdr-friction developers"
version = release = version_of("mdr-friction")

PAGES = {  #: in the order of the navigation, under their headings
    "Guide": ["tutorial", "explorer", "rig", "recipes", "trust", "gallery"],
    "In depth": [
        "design",
        "shaken",
        "dither",
        "drive",
        "other_contacts",
        "which_law",
        "element",
        "paths",
        "own_data",
        "studies",
    ],
    "Physics": ["claims", "theory", "limits", "glossary"],
    "Teaching": ["springs"],
    "Reference": ["questions", "api/shapes", "api/contact", "api/friction", "api/laws", "api/normal", "api/studies"],
}

extensions = ["myst_nb", "sphinx.ext.autodoc", "numpydoc", "facts", "equations", "navigation"]
exclude_patterns = ["extensions", "paper.md"]  # the paper is set by the journal
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
default_role = "literal"  # `name` in a docstring is code
nb_execution_mode = "off"  # the notebook is stored with its outputs
nb_merge_streams = True
nb_ipywidgets_js = {}  # no script from elsewhere
numpydoc_show_class_members = False  # autodoc lists them
smartquotes = False  # a prime is no apostrophe
highlight_language = "none"
html_math_renderer = "mathml"

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"
autodoc_preserve_defaults = True
python_maximum_signature_line_length = 88
add_module_names = False
toc_object_entries_show_parents = "hide"

LONGEST = 100  #: characters of the signature of a class; a longer one is a result, which nobody makes by hand


def shorten(app, what, name, obj, options, signature, answer):
    """No signature for results; a default that a factory makes as one would write it."""
    if what == "class" and signature and len(signature) > LONGEST:
        return "", answer
    return signature and signature.replace("<factory>", "RigidPull()"), answer


def setup(app):
    """Listen to autodoc."""
    app.connect("autodoc-process-signature", shorten)


html_theme = "furo"
html_title = "mdr-friction"
html_static_path = ["extensions/guide.css"]
html_css_files = ["guide.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False

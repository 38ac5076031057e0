"""The guide as a site: `python -m sphinx -W docs site` writes pages into site/ that need no network.

Pages are plain Markdown, readable as they are. What a page cannot say of itself stands here: their order, and how
equations and docstrings are set (extensions/).
"""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "mdr-friction"
author = copyright = "The mdr-friction developers"
version = release = version_of("mdr-friction")

PAGES = {  #: in the order of the navigation, under their headings
    "Guide": ["tutorial", "springs", "own_data", "studies", "extending", "report"],
    "Physics": ["theory", "limits"],
    "Reference": ["api/shapes", "api/contact", "api/friction", "api/laws", "api/normal", "api/studies"],
}

extensions = ["myst_parser", "sphinx.ext.autodoc", "equations", "docstrings", "notebooks", "navigation"]
exclude_patterns = ["extensions", "paper.md"]  # the paper is set by the journal
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
smartquotes = False  # a prime is no apostrophe
highlight_language = "none"
html_math_renderer = "mathml"

autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"
autodoc_preserve_defaults = True
python_maximum_signature_line_length = 88
add_module_names = False
toc_object_entries_show_parents = "hide"

html_theme = "furo"
html_title = "mdr-friction"
html_static_path = ["extensions/guide.css"]
html_css_files = ["guide.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False

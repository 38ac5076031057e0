"""Figures of runs, curves, shapes and studies. They are drawn of records as they are; nothing is computed here."""

from mdr.plots.figures import *  # noqa: F403

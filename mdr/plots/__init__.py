"""Figures of runs, curves, shapes and studies. They are drawn of records as they are; nothing is computed here."""

from mdr.plots.curves import plot_curve, plot_fit, plot_force_curve
from mdr.plots.figures import COLOURS, edges_of, prefix, save, style
from mdr.plots.profile import plot_profile
from mdr.plots.runs import (
    MODES,
    around,
    limit_of,
    periods_of,
    plot_forces,
    plot_run,
    plot_spring_map,
    plot_spring_maps,
    plot_traces,
)

__all__ = [
    "COLOURS",
    "MODES",
    "around",
    "edges_of",
    "limit_of",
    "periods_of",
    "plot_curve",
    "plot_fit",
    "plot_force_curve",
    "plot_forces",
    "plot_profile",
    "plot_run",
    "plot_spring_map",
    "plot_spring_maps",
    "plot_traces",
    "prefix",
    "save",
    "style",
]

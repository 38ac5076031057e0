"""A figure that a notebook shows once. In a file of its own, as it needs matplotlib when it is imported."""

from typing import Any

from matplotlib import pyplot as plt
from matplotlib.figure import Figure


class Picture(Figure):
    """A Figure that pyplot has and a function returns: where the last line of a cell shows it, pyplot lets go of it."""

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        """Nothing: Jupyter asks here first, and then for the picture itself. At the end of a cell its inline backend
        shows what pyplot still has.
        """
        if "inline" in plt.get_backend():
            plt.close(self)
        return {}

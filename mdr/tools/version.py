"""Versions of installed distributions, and of this library."""

from importlib.metadata import PackageNotFoundError, version


def version_of(name: str, otherwise: str = "(not installed)") -> str:
    """The installed version of a distribution."""
    try:
        return version(name)
    except PackageNotFoundError:
        return otherwise


__version__ = version_of("mdr-friction", "0+unknown")  # unknown when run from a folder that was never installed

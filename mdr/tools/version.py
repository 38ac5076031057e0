"""The version of the installed library."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("mdr-friction")
except PackageNotFoundError:  # run from a folder that was never installed
    __version__ = "0+unknown"

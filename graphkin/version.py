"""The version, for all that bear it: figures, handouts, the command line, the package."""

__version__ = "0.2.0"

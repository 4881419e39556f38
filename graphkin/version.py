"""The version, for all that bear it: figures, handouts, the command line, the package."""

__all__ = ["__version__"]

__version__ = "0.1.0"

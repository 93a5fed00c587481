"""The parts of matplotlib used for pictures and films; without it, an error that says what to install."""

try:
    from matplotlib.animation import FuncAnimation, writers
    from matplotlib.colors import LinearSegmentedColormap, to_rgb
    from matplotlib.ticker import LogLocator, MaxNLocator
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection
except ImportError as error:
    raise ImportError(f"pictures and films need matplotlib ({error}): pip install matplotlib h5py") from error

__all__ = [
    "FuncAnimation",
    "Line3DCollection",
    "LinearSegmentedColormap",
    "LogLocator",
    "MaxNLocator",
    "Poly3DCollection",
    "to_rgb",
    "writers",
]

"""The parts of matplotlib used for pictures and films; without it, an error that says what to install."""

try:
    from matplotlib.animation import FuncAnimation as FuncAnimation
    from matplotlib.animation import writers as writers
    from matplotlib.colors import LinearSegmentedColormap as LinearSegmentedColormap
    from matplotlib.colors import to_rgb as to_rgb
    from matplotlib.ticker import LogLocator as LogLocator
    from matplotlib.ticker import MaxNLocator as MaxNLocator
    from mpl_toolkits.mplot3d.art3d import Line3DCollection as Line3DCollection
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection as Poly3DCollection
except ImportError as error:
    raise ImportError(f"pictures and films need matplotlib ({error}): pip install matplotlib h5py") from error

"""Tables drawn with matplotlib."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np


def _label(table: Any, name: str) -> str:
    """The column's words and its unit, with which some names end."""
    unit = table.units[name]
    words = name.removesuffix("_" + unit.replace("/", "_per_").replace(".", "_")).replace("_", " ")
    return f"{words} ({unit})" if unit else words


def _axes_of(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def plot(table: Any, ax: Any = None, *, column: Optional[str] = None, kind: Optional[str] = None, **style: Any) -> Any:
    """As ``Table.plot``."""
    if column is not None and column not in table:
        raise ValueError(f"column = {column!r}: admissible are {', '.join(table)}")
    if kind not in (None, "phase", "time", "points"):
        raise ValueError(f"kind = {kind!r}: admissible are time, phase and points")
    if len(table.axes) == 2:
        return _map(table, _axes_of(ax), column, style)
    if len(table.axes) > 2:
        raise ValueError("a picture is of one or two axes: take a slice of to_xarray()")
    drawing = _proved if "proved" in table else _DRAWINGS.get(table.job, _lines)
    return drawing(table, _axes_of(ax), column, kind, style)


def _map(table: Any, ax: Any, column: Optional[str], style: dict[str, Any]) -> Any:
    slow, fast = table.axes
    data = [name for name in table if name not in table.axes]
    name = column or next((n for n in ("ratio_to_uncontrolled", "spectral_radius") if n in data), data[0])
    values = table[name]
    if values.dtype.kind in "US":
        words, values = np.unique(values, return_inverse=True)
        values = values.reshape(table[name].shape)
        style.setdefault("cmap", "tab10")
    else:
        words = None
    mesh = ax.pcolormesh(table[fast], table[slow], values.astype(float), shading="nearest", **style)
    bar = ax.figure.colorbar(mesh, ax=ax, label=_label(table, name))
    if words is not None:
        bar.set_ticks(range(len(words)), labels=words)
    if name == "spectral_radius" and np.nanmin(values) < 1.0 < np.nanmax(values):
        ax.contour(table[fast], table[slow], values, levels=[1.0], colors="black")
    ax.set_xlabel(_label(table, fast))
    ax.set_ylabel(_label(table, slow))
    return ax


def _proved(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    """Boxes that are proved stable or left undecided; those that are unstable stay white."""
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Patch

    p0, p1, d0, d1 = (table[name] for name in list(table)[:4])
    corners = np.stack([[p0, p1, p1, p0], [d0, d0, d1, d1]]).transpose(2, 1, 0)
    colours = {"stable": "#cfe3ef", "undecided": "#d55e00"}
    for words, colour in colours.items():
        boxes = corners[table["proved"] == words]
        ax.add_collection(PolyCollection(boxes, facecolor=colour, edgecolor=colour, **style))
    ax.set_xlim(p0.min(), p1.max())
    ax.set_ylim(d0.min(), d1.max())
    ax.set_xlabel("proportional gain (N/m)")
    ax.set_ylabel("differential gain (N s/m)")
    ax.legend(handles=[Patch(color=colour, label=f"{words}, proved" if words == "stable" else words)
                       for words, colour in colours.items()])
    return ax


def _named(table: Any, ax: Any, x: str, y: str) -> Any:
    ax.set_xlabel(_label(table, x))
    ax.set_ylabel(_label(table, y))
    return ax


def _lines(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    """The columns of numbers over the first one."""
    x, *others = [name for name in table if table[name].dtype.kind in "fib"]
    names = [column] if column else others
    if not names:
        raise ValueError(f"the table of {table.job} has nothing to be drawn over {x}")
    for name in names:
        ax.plot(table[x], table[name], "." if kind == "points" else "-", label=name, **style)
    _named(table, ax, x, names[0])
    if len(names) > 1:
        ax.set_ylabel("")
        ax.legend()
    return ax


def _motion(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    if kind == "phase":
        ax.plot(table["z1_m"], table["v1_m_per_s"], **{"linewidth": 0.5, **style})
        ax.locator_params(axis="x", nbins=5)
        return _named(table, ax, "z1_m", "v1_m_per_s")
    return _lines(table, ax, column or "z1_m", kind, style)


def _boundary(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    if "curve" not in table:
        return _lines(table, ax, column, kind, style)
    for curve in dict.fromkeys(table["curve"]):
        of = table["curve"] == curve
        ax.plot(table["differential_gain"][of], table["proportional_gain"][of], label=curve, **style)
    ax.legend()
    return _named(table, ax, "differential_gain", "proportional_gain")


def _points(x: str, y: str) -> Any:
    def draw(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
        first = x or next(iter(table))
        ax.plot(table[first], table[column or y], ",", **{"color": "black", **style})
        return _named(table, ax, first, column or y)

    return draw


def _spectrum(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    ax.semilogy(table["frequency_Hz"], np.maximum(table["amplitude_m"], 1e-300), **style)
    return _named(table, ax, "frequency_Hz", "amplitude_m")


def _exponents(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    if "time_s" in table:
        return _lines(table, ax, column, kind, style)
    ax.bar(table["exponent"], table["per_second"], yerr=np.nan_to_num(table["standard_error"]), **style)
    return _named(table, ax, "exponent", "per_second")


def _dampings(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    names = [column] if column else [name for name in table if name.startswith("damping_ratio")]
    for name in names:
        ax.semilogy(table["mode"], table[name], ".", label=name, **style)
    ax.legend()
    return _named(table, ax, "mode", names[0])


def _diagram(table: Any, ax: Any, column: Optional[str], kind: Optional[str], style: dict[str, Any]) -> Any:
    names = [name for name in table if table[name].dtype.kind == "f"]
    y = column or next(name for name in names[1:])
    ax.plot(table[names[0]], table[y], ",", **{"color": "black", **style})
    return _named(table, ax, names[0], y)


_DRAWINGS = {
    "simulate": _motion,
    "boundary": _boundary,
    "section": _points("z1_m", "v1_m_per_s"),
    "diagram": _diagram,
    "spectrum": _spectrum,
    "lyapunov": _exponents,
    "modal-damping": _dampings,
}

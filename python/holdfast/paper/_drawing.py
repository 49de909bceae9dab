"""How each kind of the report's figures is drawn with matplotlib.

Names of axes and curves, colours and ranges come from the texts; here stands which columns they are.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, Optional

import numpy as np

from .._table import Table
from ._texts import Curve, Picture, number

#: How many of the second unit the first one has.
_FACTORS = {("m", "mm"): 1e3, ("s", "ms"): 1e3, ("", "%"): 100.0}


class _Drawn:
    """A picture on its way: its texts, its tables and where it goes."""

    def __init__(self, picture: Picture, tables: dict[str, Table], place: Any) -> None:
        self.picture = picture
        self.tables = tables
        self.place = place
        self.plots = picture.curves()

    def table(self, suffix: str = "") -> Table:
        return self.tables[self.picture.entry.name + suffix]

    def axes(self, rows: int = 1, columns: int = 1, **shared: Any) -> Any:
        return self.place.subplots(rows, columns, **shared)

    def named(self, ax: Any, x: int = 0, y: int = 0) -> Any:
        """The x-th and y-th names and the ranges of the script."""
        ax.set_xlabel(self.picture.labels("x")[x])
        ax.set_ylabel(self.picture.labels("y")[y])
        return ax

    def limited(self, ax: Any, x: int = 0, y: int = 0) -> None:
        for axis, k, limit in (("x", x, ax.set_xlim), ("y", y, ax.set_ylim)):
            limits = self.picture.limits(axis)
            if len(limits) > k:
                limit(*limits[k])

    def over(self, ax: Any, table: Table, x: str, y: str, curve: Curve, **change: Any) -> None:
        """One column over another in the units of the axes' names."""
        lay(ax, curve, in_unit(table, x, ax.get_xlabel()), in_unit(table, y, ax.get_ylabel()), **change)


def in_unit(table: Table, column: str, label: str) -> np.ndarray:
    """A column in the unit that stands in brackets at the end of the label."""
    stands = re.search(r"\(([^()]*)\)$", label)
    unit, wanted = table.units[column].replace(".", " "), stands[1] if stands else ""
    return table[column] if unit == wanted or not wanted else table[column] * _FACTORS[unit, wanted]


def lay(ax: Any, curve: Curve, x: np.ndarray, y: np.ndarray, error: Optional[np.ndarray] = None) -> None:
    """Draws as the script's plot command does."""
    style = {"label": curve.title, **curve.style}
    if curve.how == "impulses":
        ax.vlines(x, ax.get_ylim()[0], y, color=style["color"], linewidth=0.8, label=curve.title)
    elif curve.how == "yerrorbars":
        ax.errorbar(x, y, error, **{**style, "linestyle": "none", "capsize": 3})
    elif curve.how == "points":
        ax.plot(x, y, **{"marker": ".", **style, "linestyle": "none"})
    else:
        ax.plot(x, y, **{**style, "marker": ""}, drawstyle="steps-post" if curve.how == "steps" else "default")


def _legend(ax: Any, *others: Any) -> None:
    entries = [entry for one in (ax, *others) for entry in zip(*one.get_legend_handles_labels())]
    if entries:
        few = sum(len(label) + 8 for _, label in entries) < 85
        ax.figure.legend(*zip(*entries), loc="outside lower center", ncols=len(entries) if few else 2, frameon=False)


# -- kinds -----------------------------------------------------------------------------------------


def _columns(drawn: _Drawn, x: str, columns: Sequence[str]) -> Any:
    ax = drawn.named(drawn.axes())
    for column, curve in zip(columns, drawn.plots[0]):
        drawn.over(ax, drawn.table(), x, column, curve)
    return ax


def _statics(drawn: _Drawn) -> Any:
    ax = _columns(drawn, "force_N", ("linear_m", "irvine_m", "exact_m", "elements_m"))
    ax.lines[-1].set_markevery(4)
    return ax


def _decay(drawn: _Drawn) -> Any:
    return _columns(drawn, "time_s", ("elements_m", "two_dof_m"))


def _peaks(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    elements, masses, discrepancy = drawn.plots[0]
    for column, curve in (("elements_peak_m", elements), ("two_dof_peak_m", masses)):
        lay(ax, curve, table["force_N"], -in_unit(table, column, ax.get_ylabel()))
    right = ax.twinx()
    right.set_ylabel(drawn.picture.labels("y2")[0])
    lay(right, discrepancy, table["force_N"], in_unit(table, "discrepancy", right.get_ylabel()))
    ax.set_ylim(bottom=0.0)
    right.set_ylim(*drawn.picture.limits("y2")[0])
    _legend(ax, right)
    return None


def _shade(ax: Any, chart: Table) -> None:
    """Cells of stable gains."""
    from matplotlib.colors import ListedColormap

    d, p = chart["differential_gain"], chart["proportional_gain"]
    ax.pcolormesh(
        p, d, chart["stable"].T, cmap=ListedColormap(["white", "#cfe3ef"]), shading="nearest", rasterized=True
    )


def _gains(drawn: _Drawn, ax: Any, suffix: str, curves: Sequence[Curve]) -> None:
    """The chart and, over it, the curves of the boundary that its plot command names."""
    _shade(ax, drawn.table(suffix + "-chart"))
    boundary = drawn.table(suffix + "-boundary")
    roots = list(dict.fromkeys(re.findall(r"root\('(\w+)'\)", drawn.picture.script)))
    for root, curve in zip(roots, curves):
        on = boundary["curve"] == root
        lay(ax, curve, boundary["proportional_gain"], np.where(on, boundary["differential_gain"], np.nan))
    drawn.limited(ax)


def _stability(drawn: _Drawn) -> Any:
    ax = drawn.named(drawn.axes())
    _, stable, *curves = drawn.plots[0]
    _gains(drawn, ax, "", curves)
    ax.fill_between([], [], color=stable.style["color"], label=stable.title)
    return ax


def _delay_charts(drawn: _Drawn) -> None:
    panels = drawn.picture.panels
    for k, (ax, panel) in enumerate(zip(drawn.axes(1, len(panels), sharey=True), panels), 1):
        ax.set_title(f"δ = {panel['share']}", fontsize="medium")
        ax.set_xlabel(drawn.picture.labels("x")[0])
        _gains(drawn, ax, f"-{k}", drawn.plots[k - 1][1:])
        if k == 1:
            ax.set_ylabel(drawn.picture.labels("y")[0])


def _longest_period(drawn: _Drawn) -> Any:
    ax = drawn.named(drawn.axes())
    for suffix, curve in zip(("-stable", "-attenuates"), drawn.plots[0]):
        drawn.over(ax, drawn.table(suffix), "frequency_Hz", "max_sampling_period_s", curve)
    ax.set_yscale("log")
    drawn.limited(ax)
    arrow = re.search(r"set arrow from ([\d.]+), graph 0", drawn.picture.script)
    if arrow:  # the frequency that the paper marks
        ax.axvline(float(arrow[1]), color="#444444", linestyle=":")
        text, x, y = re.search(r"set label '(.*?)' at ([\d.]+), ([\d.]+)", drawn.picture.script).groups()
        ax.text(float(x), float(y), text, color="#444444")
    return ax


def _design(drawn: _Drawn) -> None:
    best, gained = drawn.axes(2, 1, sharex=True)
    best.set_ylabel(drawn.picture.labels("y")[0])
    gained.set_ylabel(drawn.picture.labels("y")[1])
    gained.set_xlabel(drawn.picture.labels("x")[0])
    for ax, column, curves in zip((best, gained), ("least_amplitude_gain", "attenuation_dB"), drawn.plots):
        for k, curve in enumerate(curves[:3], 1):
            lay(ax, curve, drawn.table(f"-{k}")["frequency_Hz"], drawn.table(f"-{k}")[column])
    gained.axhline(0.0, color=drawn.plots[1][-1].style["color"], linestyle=":")
    drawn.limited(best)
    drawn.limited(gained, y=1)
    _legend(best)


def _several(drawn: _Drawn, suffixes: Sequence[str], x: str, y: str) -> Any:
    ax = drawn.named(drawn.axes())
    for suffix, curve in zip(suffixes, drawn.plots[0]):
        drawn.over(ax, drawn.table(suffix), x, y, curve)
    drawn.limited(ax)
    return ax


def _history(drawn: _Drawn) -> Any:
    return _several(drawn, ("-no-control", "-ideal", "-loop"), "time_s", "z1_m")


def _kick(drawn: _Drawn) -> Any:
    return _several(drawn, ("-kicked", "-undisturbed"), "time_s", "z1_m")


def _phase(drawn: _Drawn) -> Any:
    return _several(drawn, ("-no-control", "-loop", "-ideal"), "z1_m", "v1_m_per_s")


def _contact(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    relative, contact = drawn.plots[0]
    lay(ax, relative, table["time_s"], table["v2_m_per_s"] - table["v1_m_per_s"])
    outside = float(re.search(r"== 1 \? 0 : ([\d.]+)", drawn.picture.script)[1])
    lay(ax, contact, table["time_s"], np.where(table["in_backlash"] == 1, 0.0, outside))
    drawn.limited(ax)
    return ax


def _spectrum(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    ax.set_yscale("log")
    left, right = drawn.picture.limits("x")[0]
    shown = (table["frequency_Hz"] > left) & (table["frequency_Hz"] <= right)
    frequency, amplitude = table["frequency_Hz"][shown], table["amplitude_m"][shown]
    top = 10.0 ** np.ceil(np.log10(amplitude.max()))
    ax.set(xlim=(left, right), ylim=(1e-5 * top, top))
    lay(ax, drawn.plots[0][0], frequency, np.maximum(amplitude, 1e-5 * top))
    return ax


def _deviation(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    ax.set_yscale("log")
    drawn.limited(ax)
    lay(ax, drawn.plots[0][0], table["time_s"], np.maximum(np.abs(table["z1_deviation_m"]), ax.get_ylim()[0]))
    return ax


def _filling(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    drawn.limited(ax)
    x, y = in_unit(table, "z1_m", ax.get_xlabel()), table["v1_m_per_s"]
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    shown = (x > left) & (x < right) & (y > low) & (y < high)
    lay(ax, drawn.plots[0][0], x[shown], y[shown])
    return ax


def _exponents(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    *curves, zero = drawn.plots[0]
    for k, curve in enumerate(curves, 1):
        lay(ax, curve, table["time_s"], table[f"lambda{k}"])
    ax.axhline(0.0, color=zero.style["color"], linestyle=":")
    drawn.limited(ax)
    return ax


def _exponent_table(drawn: _Drawn) -> Any:
    ax = drawn.named(drawn.axes())
    printed, consistent, paper = drawn.plots[0]
    for suffix, curve, beside in (("-printed", printed, -0.12), ("-consistent", consistent, 0.12)):
        table = drawn.table(suffix)
        lay(ax, curve, table["exponent"] + beside, table["per_sample"], table["standard_error"])
    rows = re.search(r"<< END\n(.*?)END", drawn.picture.script, re.DOTALL)[1].split()
    lay(ax, paper, *np.array([row.split(",") for row in rows], dtype=float).T)
    ax.set_xticks(range(1, 5))
    drawn.limited(ax)
    shown = [y for line in ax.lines for x, y in line.get_xydata() if x < ax.get_xlim()[1] and np.isfinite(y)]
    room = 0.1 * (max(shown) - min(shown))
    ax.set_ylim(min(shown) - room, max(shown) + room)
    return ax


def _orbits(drawn: _Drawn) -> None:
    panels = drawn.picture.panels
    for k, (ax, panel) in enumerate(zip(drawn.axes(1, len(panels)), panels), 1):
        ax.set_title(panel["title"], fontsize="medium")
        ax.set_xlabel(drawn.picture.labels("x")[0])
        ax.set_ylabel(drawn.picture.labels("y")[0])
        for curve in drawn.plots[k - 1]:
            drawn.over(ax, drawn.table(f"-{k}"), "z1_m", "v1_m_per_s", curve)


def _section(drawn: _Drawn) -> Any:
    ax, table = drawn.named(drawn.axes()), drawn.table()
    for curve, rising in zip(drawn.plots[0], (1, 0)):
        of = table["rising"] == rising
        lay(ax, curve, in_unit(table, "z1_m", ax.get_xlabel())[of], table["v1_m_per_s"][of])
    return ax


def _diagram(drawn: _Drawn) -> None:
    table = drawn.table()
    scale = float(re.search(r"using \(\$1\*([\d.]+)\)", drawn.picture.script)[1])
    x = scale * table[next(iter(table))]
    both = drawn.axes(2, 1, sharex=True, sharey=True)
    both[1].set_xlabel(drawn.picture.labels("x")[-1])
    titles = re.findall(r"set title '(?:@[^@]*@)?(.*?)'", drawn.picture.script)
    for ax, (curve,), title, upward in zip(both, drawn.plots, titles, (1, 0)):
        ax.set_title(title, fontsize="medium")
        ax.set_ylabel(drawn.picture.labels("y")[0])
        of = table["upward"] == upward
        lay(ax, curve, x[of], in_unit(table, "z1_m", ax.get_ylabel())[of])


def _basins(drawn: _Drawn) -> Any:
    from matplotlib.colors import ListedColormap

    ax, states, shares = drawn.named(drawn.axes()), drawn.table("-states"), drawn.table("-shares")
    ax.set_aspect("equal")
    colours = re.findall(r"\d '(#\w+)'", re.search(r"set palette defined \((.*)\)", drawn.picture.script)[1])
    last = len(colours) - 2  # the first are those of -1, no orbit found, and 0, diverges
    x, y = (in_unit(states, axis, label) for axis, label in zip(states.axes, (ax.get_xlabel(), ax.get_ylabel())))
    shown = np.clip(states["attractor"], -1, last).T
    ax.pcolormesh(
        x, y, shown, cmap=ListedColormap(colours), vmin=-1.5, vmax=last + 0.5, shading="nearest", rasterized=True
    )
    for k, period, share in zip(shares["attractor"], shares["period_s"], shares["fraction"]):
        fate = {-1: "no orbit found", 0: "diverges"}.get(int(k), f"period {period:.3g} s")
        ax.plot([], [], "s", color=colours[min(int(k), last) + 1], label=f"{fate}: {100 * share:.3g} %")
    return ax


_KINDS = {
    "statics": _statics,
    "peaks": _peaks,
    "decay": _decay,
    "stability": _stability,
    "delay_charts": _delay_charts,
    "longest_period": _longest_period,
    "design": _design,
    "history": _history,
    "kick": _kick,
    "contact": _contact,
    "phase": _phase,
    "spectrum": _spectrum,
    "deviation": _deviation,
    "filling": _filling,
    "exponents": _exponents,
    "exponent_table": _exponent_table,
    "orbits": _orbits,
    "section": _section,
    "diagram": _diagram,
    "basins": _basins,
}

#: Where a printed value stands in the picture: what its words say of the abscissa ("": the value is
#: the abscissa itself), and the unit of the value.
_PRINTED = {
    "statics": (r"by ([−\d.]+) N$", "mm"),
    "stability": (r"at P = ([−\d.]+) N/m", "N s/m"),
    "longest_period": (r"at ([−\d.]+) Hz$", "ms"),
    "spectrum": ("", "Hz"),
}


def _printed(drawn: _Drawn, ax: Any) -> None:
    """What the paper prints, where it is a point or an abscissa of the picture."""
    at, unit = _PRINTED[drawn.picture.kind]
    points = []
    for what, value in drawn.picture.entry.printed:
        printed, place = re.search(rf"([−\d.]+) {re.escape(unit)}$", value), re.search(at, what)
        if printed and place:
            points.append((number(place[1]), number(printed[1])) if at else (number(printed[1]), 0.97))
    if points:
        how = {"marker": "x", "markersize": 9} if at else {"marker": "v", "transform": ax.get_xaxis_transform()}
        x, y = zip(*dict.fromkeys(points))
        ax.plot(x, y, color="black", linestyle="none", zorder=5, label="printed in the paper", **how)


def draw(picture: Picture, tables: dict[str, Table], place: Any) -> None:
    """Draws the picture where a figure or a part of one has its place."""
    drawn = _Drawn(picture, tables, place)
    place.suptitle(picture.entry.title, fontsize="medium")
    ax = _KINDS[picture.kind](drawn)
    if ax is not None:
        if picture.kind in _PRINTED:
            _printed(drawn, ax)
        _legend(ax)

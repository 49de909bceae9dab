"""Results: columns as NumPy arrays, with their units and what made them."""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np


class Table(Mapping[str, "np.ndarray[Any, Any]"]):
    """A job's result: NumPy arrays by the name of their column.

    Over a grid of axes (a chart, a response, basins, a sweep) each column is an array with a
    dimension for each axis, the first slowest, and the axes' values stand under their names too;
    else all columns have one dimension. Whole numbers are ``int64``, words ``str``, ``stable`` is ``bool``.

    >>> chart = holdfast.Case().chart(p=(-1000, 200, 121), d=(-40, 20, 121))
    >>> chart["stable"].shape, chart.units["proportional_gain"]
    ((121, 121), 'N/m')

    A column is an attribute as well; of a table of one row its only value:
    ``holdfast.Case().orbit().period_samples``.
    """

    def __init__(self, job: str, received: Mapping[str, Any]) -> None:
        self._job = job
        self._given_origin = received["origin"]  # a text, or what makes it
        self._axes = tuple(name for name, *_ in received["axes"])
        self._columns: dict[str, np.ndarray] = {}
        self._units: dict[str, str] = {}
        self._descriptions: dict[str, str] = {}
        for name, unit, description, values in received["axes"]:
            self._take(name, unit, description, values)
        for name, unit, description, values, words in received["columns"]:
            if words is not None:
                values = np.asarray(words or [""], dtype=str)[values]
            self._take(name, unit, description, values)

    def _take(self, name: str, unit: str, description: str, values: np.ndarray) -> None:
        if name == "stable":  # bytes of 0 and 1 need no copy
            values = values.view(bool) if values.dtype.itemsize == 1 else values.astype(bool)
        elif values.dtype.kind == "i":
            values = values.view(np.int64)  # some libraries know no other type of 64 bits
        self._columns[name] = values
        self._units[name] = unit
        self._descriptions[name] = description

    # -- a mapping -------------------------------------------------------------------------------
    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name}: the columns are {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """How many columns there are, axes counted."""
        return len(self._columns)

    def __getattr__(self, name: str) -> Any:
        columns = self.__dict__.get("_columns", {})
        if name not in columns:
            raise AttributeError(f"{name}: neither of the table nor one of its columns {', '.join(columns)}")
        values = columns[name]
        return values[0].item() if not self._axes and values.shape == (1,) else values

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    @property
    def _origin(self) -> str:
        if callable(self._given_origin):
            self._given_origin = self._given_origin()
        return self._given_origin

    # -- what it is ------------------------------------------------------------------------------
    @property
    def job(self) -> str:
        """The program's job that made it."""
        return self._job

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes of a grid, the first slowest; none of other tables."""
        return self._axes

    @property
    def rows(self) -> int:
        """Rows of the table, or cells of its grid."""
        data = [name for name in self._columns if name not in self._axes]
        return int(self._columns[data[0]].size) if data else 0

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column, such as ``N.s/m``; ``""`` without dimension."""
        return dict(self._units)

    @property
    def descriptions(self) -> dict[str, str]:
        """What each column is."""
        return dict(self._descriptions)

    @property
    def metadata(self) -> dict[str, Any]:
        """What made the table: version, job, options and the whole case; where fewer than six digits
        are to be trusted also ``trusted_digits`` and ``trusted_until_s``."""
        return json.loads(self._origin)

    def value(self, quantity: str) -> float:
        """Of a table with the columns ``quantity`` and ``value``: the value of one of them."""
        names = self["quantity"]
        found = np.flatnonzero(names == quantity)
        if found.size == 0:
            raise KeyError(f"{quantity}: the quantities are {', '.join(names)}")
        return float(self["value"][found[0]])

    # -- other containers ------------------------------------------------------------------------
    def _index(self) -> str | None:
        """The column over which the others stand: the first, where it rises."""
        name = next(iter(self._columns))
        values = self._columns[name]
        rises = values.dtype.kind in "fi" and values.size > 1 and bool(np.all(np.diff(values) > 0))
        return name if rises else None

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset``: axes are coordinates (of other tables the first column, where it
        rises), with the attributes ``units`` and ``long_name``; what made it in its attributes. A key of the
        case is named with an underscore for its point, as in a file of netCDF and in a store:
        ``backlash_width``."""
        import xarray

        def named(name: str) -> str:
            return name.replace(".", "_")

        index = None if self._axes else self._index()
        dimensions = tuple(named(name) for name in self._axes or (index or "row",))
        coordinates = self._axes or ((index,) if index else ())

        def attributes(name: str) -> dict[str, str]:
            return {"units": self._units[name] or "1", "long_name": self._descriptions[name]}

        return xarray.Dataset(
            {
                named(name): (dimensions, values, attributes(name))
                for name, values in self._columns.items()
                if name not in coordinates
            },
            {named(name): ((named(name),), self._columns[name], attributes(name)) for name in coordinates},
            {"job": self._job, "holdfast": self._origin},
        )

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each row, or for each cell of a grid with the axes as
        its index."""
        import pandas

        if not self._axes:
            frame = pandas.DataFrame(self._columns)
        else:
            index = pandas.MultiIndex.from_product([self._columns[name] for name in self._axes], names=self._axes)
            data = {name: values.ravel() for name, values in self._columns.items() if name not in self._axes}
            frame = pandas.DataFrame(data, index=index)
        frame.attrs["units"] = self.units
        return frame

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws the table with matplotlib as its job is usually drawn: a chart and basins as a map, a
        boundary as curves, a motion over time (``kind="phase"``: in the phase plane), an orbit
        diagram and a section as points.

        :param ax: axes of matplotlib to draw in; without them a figure of its own
        :param style: handed to matplotlib, but for ``column`` (which one is drawn) and ``kind``
        :return: the axes
        """
        from . import _plots

        return _plots.plot(self, ax, **style)

    # -- on a screen -----------------------------------------------------------------------------
    def _shape_text(self) -> str:
        if self._axes:
            return " x ".join(f"{name} {self._columns[name].size}" for name in self._axes)
        return f"{self.rows} row" + ("" if self.rows == 1 else "s")

    def __repr__(self) -> str:
        names = ", ".join(name for name in self._columns if name not in self._axes)
        if not self._axes and self.rows == 1:
            names = ", ".join(f"{name}={values[0]}" for name, values in self._columns.items())
        return f"<holdfast.Table {self._job}: {self._shape_text()}; {names}>"

    def _picture(self) -> str:
        """A chart or a curve over axes as an image of a page; nothing where it cannot be drawn."""
        if not 1 <= len(self._axes) <= 2:
            return ""
        try:
            from matplotlib.figure import Figure

            figure, drawn = Figure(layout="constrained"), io.BytesIO()
            self.plot(figure.subplots())
            figure.savefig(drawn, format="png", dpi=80)
        except (ImportError, ValueError):
            return ""
        return f'<br><img alt="{html.escape(repr(self))}" src="data:image/png;base64,{base64.b64encode(drawn.getvalue()).decode()}">'

    def _repr_html_(self) -> str:
        def cell(text: Any, tag: str = "td") -> str:
            return f"<{tag}>{html.escape(str(text))}</{tag}>"

        columns = {name: values for name, values in self._columns.items() if name not in self._axes}
        head = "".join(cell(name + (f" ({self._units[name]})" if self._units[name] else ""), "th") for name in columns)
        body = ""
        if not self._axes:
            for row in range(min(self.rows, 10)):
                body += "<tr>" + "".join(cell(values[row]) for values in columns.values()) + "</tr>"
        caption = html.escape(f"{self._job}: {self._shape_text()}")
        return f"<table><caption>{caption}</caption><tr>{head}</tr>{body}</table>{self._picture()}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._job, self._origin, self._axes, self._columns, self._units, self._descriptions)


def _restored(job, origin, axes, columns, units, descriptions) -> Table:
    table = Table(job, {"origin": origin, "axes": [], "columns": []})
    table._axes, table._columns = axes, columns
    table._units, table._descriptions = units, descriptions
    return table

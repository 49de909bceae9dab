"""The figures of L. E. Kollár, Nonlinear Dynamics (2022), computed and drawn anew.

>>> import holdfast
>>> holdfast.paper.figure(4)          # Fig. 4, all of its panels
>>> holdfast.paper.figure("9c")       # one panel; "table 2"; "orbits", which is beyond the paper
>>> holdfast.paper.tables("9c")       # what it is drawn of
>>> for entry in holdfast.paper.figures():
...     print(entry.name, entry.title)

The figures are those of the program's report: settings, axes, names of curves and what the paper prints
come from the same texts. matplotlib draws them.
"""

from __future__ import annotations

from typing import Any, Union

from .._case import Case
from .._table import Table
from ._texts import Entry, Picture, entries, found, picture

__all__ = ["Entry", "figure", "figures", "tables"]


def figures() -> tuple[Entry, ...]:
    """All figures: the paper's and those that the report adds to them.

    :return: of each its ``name``, which :func:`figure` takes, its ``title`` and ``caption``, what the paper
        prints about it (``printed``: pairs of what and value) and the ``commands`` of the program that make
        its tables
    """
    return entries()


def tables(which: Union[int, str]) -> dict[str, Table]:
    """The tables that a figure is drawn of, by their names in the report: ``"fig09c-loop"``.

    :param which: as of :func:`figure`
    """
    return {name: table for entry in found(which) for name, table in _computed(picture(entry)).items()}


def figure(which: Union[int, str], **options: Any) -> Any:
    """A figure of the paper, computed now.

    :param which: the number of a figure, ``4``, all of its panels; a panel, ``"4a"``; ``"table 2"``; or a name
        of :func:`figures`
    :param options: of ``matplotlib.pyplot.figure``, such as ``figsize``
    :return: the ``matplotlib.figure.Figure``; its axes have names with units, its curves labels
    :raises ValueError: there is no such figure; the message says which there are
    """
    import matplotlib.pyplot as plt

    from ._drawing import draw

    pictures = [picture(entry) for entry in found(which)]
    columns = min(len(pictures), 2)
    rows = -(-len(pictures) // columns)
    size = (6.4 * columns, sum(max(p.height for p in pictures[k * columns : (k + 1) * columns]) for k in range(rows)))
    drawn = plt.figure(**{"figsize": size, "layout": "constrained", **options})
    places = drawn.subfigures(rows, columns, squeeze=False).ravel()
    for one, place in zip(pictures, places):
        draw(one, _computed(one), place)
    return drawn


def _computed(one: Picture) -> dict[str, Table]:
    """Each table by the job that the report runs for it."""
    return {name: Case()._run(words[0], words[1:], {}) for name, words in one.commands.items()}

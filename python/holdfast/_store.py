"""Zarr stores of cells: written by jobs, filled by processes, read while they grow."""

from __future__ import annotations

import errno
import html
import json
import math
import os
import pathlib
from typing import TYPE_CHECKING, Any, Union

from ._typing import How, Path

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._table import Table



class Store:
    """A Zarr store of the cells of a sweep, a chart, a response or basins: a folder that xarray, zarr
    and others read, also while it grows.

    >>> store = case.sweep({"backlash.width": (0, 0.003, 31)}, "verdict", store="map.zarr")
    >>> store.to_xarray()["verdict"]
    >>> holdfast.open_store("map.zarr").chunks_done

    What has not been computed yet is NaN in doubles, -1 in words, -2**63 in whole numbers.
    """

    __slots__ = ("path",)

    def __init__(self, path: Path) -> None:
        #: the folder
        self.path = pathlib.Path(os.path.abspath(os.fspath(path)))
        self._description()

    def _attributes(self) -> dict[str, Any]:
        try:
            return json.loads((self.path / "zarr.json").read_text(encoding="utf-8"))["attributes"]
        except (FileNotFoundError, NotADirectoryError, ValueError, KeyError, TypeError):
            return {}

    def _description(self) -> dict[str, Any]:
        """What holdfast itself needs of the store."""
        description = self._attributes().get("holdfast")
        if not isinstance(description, dict) or "chunk" not in description:
            raise ValueError(f"{self.path} is no Zarr 3 store that holdfast has written")
        return description

    @property
    def job(self) -> str:
        """The program's job whose cells these are."""
        return self._description()["job"]

    @property
    def metadata(self) -> dict[str, Any]:
        """What makes the cells: version, job, options, instruction set and the whole case."""
        from ._case import Case

        attributes = self._attributes()
        description = self._description()
        return {
            "version": description["version"],
            "job": description["job"],
            "options": json.loads(attributes["options"]),
            "instructions": description.get("instructions", ""),
            "case": Case.from_toml(attributes["case"]).to_dict(),
        }

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis, the first slowest."""
        return tuple(self._description()["shape"])

    @property
    def chunk_shape(self) -> tuple[int, ...]:
        """Cells of a chunk along each axis."""
        return tuple(self._description()["chunk"])

    @property
    def chunks(self) -> int:
        """How many chunks the store has once all are computed."""
        return math.prod(-(-cells // of_chunk) for cells, of_chunk in zip(self.shape, self.chunk_shape))

    @property
    def chunks_done(self) -> int:
        """How many of them are computed. A chunk is done when that of the first column is there."""
        column = self._description()["columns"][0]["name"].replace(".", "_")
        try:
            names = os.listdir(self.path / column)
        except FileNotFoundError:
            return 0
        return sum(1 for name in names if name[0] == "c")

    @property
    def complete(self) -> bool:
        """Whether every chunk is computed."""
        return self.chunks_done == self.chunks

    def to_xarray(self, **options: Any) -> Any:
        """The store as an ``xarray.Dataset`` that reads its cells when they are asked for, in chunks
        where dask is installed. One that grows is opened anew to see what came after a read.

        :param options: handed to ``xarray.open_zarr``
        """
        import xarray

        return xarray.open_zarr(self.path, **options)

    def to_table(self, **how: Unpack[How]) -> Table:
        """All cells in memory, as the :class:`Table` that the job gives without a store: words are texts, and
        ``plot()`` and ``to_pandas()`` are at hand. ``progress`` as of a job.

        :raises holdfast.NoAnswer: chunks are missing or damaged; the message names the first one
        """
        from ._case import Case

        table = Case()._run("convert", [os.fspath(self.path)], how)
        table._job = self.job
        return table

    def convert(self, file: Path, **how: Any) -> None:
        """As :func:`holdfast.convert`."""
        convert(self, file, **how)

    def __fspath__(self) -> str:
        return str(self.path)

    def __eq__(self, other: object) -> bool:
        return self.path == other.path if isinstance(other, Store) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.path)

    def __repr__(self) -> str:
        cells = " x ".join(str(count) for count in self.shape)
        return f"<holdfast.Store {self.job}: {cells} cells, {self.chunks_done} of {self.chunks} chunks; {self.path}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"


def open_store(path: Path) -> Store:
    """A store that was written before, or that grows.

    :raises FileNotFoundError: nothing lies there
    :raises ValueError: what lies there is no store of holdfast's
    """
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), os.fspath(path))
    return Store(path)


def convert(store: Union[Store, Path], file: Path, *, yes: bool = False, progress: Any = None) -> None:
    """Writes a complete store as a table.

    :param file: ``.csv`` or ``.nc``
    :param yes: a text of more than ten million cells is meant
    :raises FileNotFoundError: nothing lies at ``store``
    :raises holdfast.NoAnswer: chunks are missing or damaged; the message names the first one
    """
    from ._case import Case

    source = store if isinstance(store, Store) else open_store(store)
    Case()._run("convert", [os.fspath(source), os.fspath(file)], {"yes": yes, "progress": progress})


def is_store_name(path: Path) -> bool:
    """Whether a result of that name is a store."""
    return os.fspath(path).rstrip("/").endswith(".zarr")


def store_name(path: Any) -> str:
    """The folder of a store that is to be written."""
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"store = {path!r}: admissible is the name of a folder that ends in .zarr")
    name = os.path.abspath(os.fspath(path))
    if not is_store_name(name):
        raise ValueError(f"store = {os.fspath(path)!r}: admissible is the name of a folder that ends in .zarr")
    return name

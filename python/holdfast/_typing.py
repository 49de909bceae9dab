"""Kinds of arguments, for those who check types; of the same names and words as the program's options."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypedDict, Union

import numpy as np

Path = Union[str, "os.PathLike[str]"]
#: (min, max, count), an array in equal steps as numpy.linspace gives it, or one number.
Range = Union[float, "tuple[float, float, int]", "np.ndarray[Any, Any]", "Sequence[float]", None]
#: (min, max).
Interval = Union["tuple[float, float]", "Sequence[float]", "np.ndarray[Any, Any]", None]

Switching = Literal["sampled", "exact"]


class How(TypedDict, total=False):
    """The keywords of every job, but for ``output``."""

    threads: int
    instructions: Literal["baseline", "avx2", "avx512"]
    progress: Union[bool, Callable[[int, int], Any]]
    yes: bool
    family: bool
    draws: int

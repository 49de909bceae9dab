"""Options of a job as its command line has them."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ._typing import Range


def finite_number(value: Any, name: str) -> float:
    """The number, or a ValueError that names it."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {value!r}: admissible is a number") from None
    if not np.isfinite(number):
        raise ValueError(f"{name} = {number}: admissible is a finite number")
    return number


def number_text(value: Any, name: str) -> str:
    """A finite number with all of its digits."""
    number = finite_number(value, name)
    whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    return str(int(value)) if whole else repr(number)


def threads_of(threads: Any) -> int | None:
    """None, or a number of threads, 0: all."""
    if threads is None:
        return None
    if not isinstance(threads, (int, np.integer)) or isinstance(threads, bool) or not 0 <= threads <= 1024:
        raise ValueError(f"threads = {threads!r}: admissible is a whole number, 0 (all) to 1024")
    return int(threads)


def axis_of(value: Range, name: str) -> tuple[float, float, int]:
    """The two ends and the number of the values of an axis, first to last ascending."""
    if isinstance(value, tuple):
        if len(value) != 3:
            raise ValueError(f"{name} = {value!r}: admissible is (min, max, count)")
        low, high, count = value
        if not isinstance(count, (int, np.integer)) or isinstance(count, bool) or count < 1:
            raise ValueError(f"{name} = {value!r}: admissible is (min, max, count), count a whole number from 1 on")
        number_text(low, name), number_text(high, name)
        if float(low) > float(high):
            raise ValueError(f"{name} = {value!r}: admissible is min <= max")
        return float(low), float(high), int(count)
    if np.ndim(value) == 0 and not isinstance(value, str):
        return float(number_text(value, name)), float(value), 1
    try:
        values = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {value!r}: admissible is (min, max, count) or an array of numbers") from None
    if values.ndim != 1 or values.size < 1:
        raise ValueError(f"{name} has the shape {values.shape}: admissible is one dimension and a value at least")
    if not np.all(np.isfinite(values)):
        raise ValueError(f"{name}: admissible are finite values")
    if values.size > 1:
        even = np.linspace(values[0], values[-1], values.size)
        if not values[-1] > values[0] or np.max(np.abs(even - values)) > 1e-9 * (values[-1] - values[0]):
            raise ValueError(
                f"{name}: admissible is an array that rises in equal steps, such as numpy.linspace gives, or (min, max, count)"
            )
    return float(values[0]), float(values[-1]), int(values.size)


def axis_text(value: Range, name: str) -> str:
    """MIN:MAX:COUNT, or one number."""
    low, high, count = axis_of(value, name)
    return repr(low) if count == 1 else f"{low!r}:{high!r}:{count}"


def interval_text(value: Any, name: str) -> str:
    """MIN:MAX."""
    try:
        low, high = value
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {value!r}: admissible is (min, max)") from None
    return f"{number_text(low, name)}:{number_text(high, name)}"


def part_text(part: Any) -> str:
    """K/N."""
    try:
        number, of = part
        return f"{operator.index(number)}/{operator.index(of)}"
    except (TypeError, ValueError):
        raise ValueError(f"part = {part!r}: admissible are two whole numbers (K, N), 1 <= K <= N") from None


def list_text(values: Any, name: str) -> str:
    """Numbers between commas."""
    entries = [values] if np.ndim(values) == 0 else list(values)
    if not entries:
        raise ValueError(f"{name}: admissible is one number at least")
    return ",".join(number_text(entry, name) for entry in entries)


def key_axis_text(key: str, value: Any) -> str:
    """KEY=MIN:MAX:COUNT, KEY=log:MIN:MAX:COUNT or KEY=VALUE,VALUE,…"""
    if isinstance(value, tuple) and len(value) == 4 and value[0] == "log":
        low, high, count = axis_of(value[1:], key)
        return f"{key}=log:{low!r}:{high!r}:{count}"
    if isinstance(value, tuple) and len(value) == 3 and isinstance(value[2], (int, np.integer)):
        low, high, count = axis_of(value, key)
        return f"{key}={low!r}:{high!r}:{count}"
    return f"{key}={list_text(value, key)}"


def axes_texts(axes: Mapping[str, Any], exactly: int | None = None, option: str = "--axis") -> list[str]:
    """``--axis`` options, or others, of a mapping from keys of the case to their values."""
    if not isinstance(axes, Mapping):
        raise TypeError(f"axes are a dict from keys of the case to their values, not {axes!r}")
    if exactly is not None and len(axes) != exactly:
        raise ValueError(f"{len(axes)} axes: admissible are {exactly}")
    return [text for key, value in axes.items() for text in (option, key_axis_text(key, value))]


def arguments(options: Mapping[str, Any]) -> list[str]:
    """Words of a command line: None and False are left out, True is a flag."""
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, str):
            words.append(f"{option}={value}")
        elif isinstance(value, Iterable) and not np.ndim(value) == 0:
            raise TypeError(f"{name} = {value!r}: admissible is one value")
        else:
            words.append(f"{option}={number_text(value, name)}")
    return words

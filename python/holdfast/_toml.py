"""Values and tables as TOML, in which a case is written."""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterator, Mapping
from typing import Any


def value_text(value: Any, key: str) -> str:
    """One value as TOML; numbers with all of their digits."""
    if hasattr(value, "tolist"):  # numbers and arrays of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        number = float(value)
        if math.isnan(number):
            raise ValueError(f"{key} = nan: admissible are numbers")
        if math.isinf(number):
            return "inf" if number > 0 else "-inf"
        return repr(number)
    if isinstance(value, str):
        return '"' + "".join(_escaped(character) for character in value) + '"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(entry, key) for entry in value) + "]"
    raise ValueError(f"{key} = {value!r}: admissible are numbers, texts and lists of them")


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    code = ord(character)
    return f"\\u{code:04X}" if code < 0x20 or code == 0x7F else character


def key_texts(tables: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """The keys of nested tables as dotted names with their values, devices left out."""
    for name, value in tables.items():
        if not isinstance(name, str):
            raise TypeError(f"a key of a case is a text, not {name!r}")
        if name == "device":
            continue
        yield from _keys_within(name, value)


def _keys_within(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    if not isinstance(value, Mapping):
        yield name, value
        return
    for key, inner in value.items():
        yield from _keys_within(f"{name}.{key}", inner)


def overrides(tables: Mapping[str, Any]) -> list[str]:
    """``key=value`` texts, in their order."""
    return [f"{key}={value_text(value, key)}" for key, value in key_texts(tables)]


def device_text(device: Mapping[str, Any]) -> str:
    """A ``[[device]]`` of a case file."""
    if not isinstance(device, Mapping):
        raise TypeError(f"a device is a dict of its keys, not {device!r}")
    lines = [f"{key} = {value_text(value, 'device.' + str(key))}" for key, value in device.items()]
    return "\n[[device]]\n" + "\n".join(lines) + "\n"


def tables_text(tables: Mapping[str, Any]) -> str:
    """A case file of nested or dotted tables."""
    by_table: dict[str, list[str]] = {}
    for key, value in key_texts(tables):
        table, dot, short = key.partition(".")
        if not dot:
            raise ValueError(f"{key}: a key of a case is TABLE.KEY, such as control.sampling_period")
        short = f'"{short}"' if "." in short else short  # of [uncertain]
        by_table.setdefault(table, []).append(f"{short} = {value_text(value, key)}")
    text = "".join(f"[{table}]\n" + "\n".join(lines) + "\n" for table, lines in by_table.items())
    return text + "".join(device_text(device) for device in _devices(tables))


def _devices(tables: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    devices = tables.get("device", [])
    return [devices] if isinstance(devices, Mapping) else list(devices)


def devices_text(tables: Mapping[str, Any]) -> str:
    """The devices of keyword arguments."""
    return "".join(device_text(device) for device in _devices(tables))

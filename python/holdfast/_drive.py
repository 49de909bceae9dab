"""Controllers and forces of the user's own."""

from __future__ import annotations

import ctypes
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

#: Of a compiled controller.
WANTED = "double (int64_t k, double t, double displacement, double velocity)"
_ARGUMENTS = ["int64", "double", "double", "double"]
_DATA = ["void *"]
#: Other names of both kinds of numbers; those of C's integers where they have 64 bits.
_NAMES = {"float64": "double", "int64_t": "int64", "ssize_t": "int64", "Py_ssize_t": "int64", "ptrdiff_t": "int64"}
_NAMES.update({name: "int64" for name, kind in (("long", ctypes.c_long), ("long long", ctypes.c_longlong))
               if ctypes.sizeof(kind) == 8})  # fmt: skip
#: Of a function of ctypes that needs the interpreter's lock.
_NEEDS_LOCK = 4


def controller_of(controller: Any) -> Any:
    """None, a callable, or the address of a compiled one with that of its data.

    :raises TypeError: it is none of these, or a compiled one of another signature
    """
    if controller is None:
        return None
    if isinstance(controller, ctypes._CFuncPtr):
        return _of_ctypes(controller), None
    if type(controller).__name__ == "LowLevelCallable":
        return _of_low_level_callable(controller)
    if hasattr(controller, "_sig") and isinstance(getattr(controller, "address", None), int):
        signature = controller._sig
        _require(str(signature.return_type), [str(kind) for kind in signature.args], _ARGUMENTS)
        return controller.address, None
    if callable(controller):
        return controller
    raise TypeError(
        f"controller = {controller!r}: admissible are a callable (k, t, displacement, velocity) -> force, "
        "a ctypes function, a numba.cfunc and a scipy.LowLevelCallable"
    )


def _require(result: str, arguments: Sequence[str], *admissible: list[str]) -> None:
    found = [_NAMES.get(kind, kind) for kind in arguments]
    if _NAMES.get(result, result) != "double" or found not in admissible:
        data = "" if _ARGUMENTS in admissible else ", and void *data as the last"
        raise TypeError(f"the controller is {result} ({', '.join(arguments)}); admissible is {WANTED}{data}")


def _kind(of_ctypes: Any) -> str:
    if of_ctypes in (ctypes.c_int64, ctypes.c_longlong):
        return "int64"
    named = {None: "void", ctypes.c_double: "double", ctypes.c_void_p: "void *"}
    return named.get(of_ctypes, getattr(of_ctypes, "__name__", str(of_ctypes)))


def _of_ctypes(function: Any, *admissible: list[str]) -> int:
    if any(type(kept).__name__ == "CThunkObject" for kept in (function._objects or {}).values()):
        raise TypeError("the controller is a function of Python that ctypes wraps: hand over the function itself")
    if function._flags_ & _NEEDS_LOCK:
        raise TypeError("the controller needs the interpreter's lock: hand over a function of a ctypes.CDLL")
    if function.argtypes is None:
        raise TypeError(f"the controller's argtypes are not set; admissible is {WANTED}")
    _require(_kind(function.restype), [_kind(kind) for kind in function.argtypes], *(admissible or [_ARGUMENTS]))
    address = ctypes.cast(function, ctypes.c_void_p).value
    if not address:
        raise ValueError("the controller is a null pointer")
    return address


def _of_low_level_callable(controller: Any) -> tuple[int, Any]:
    function, data = controller.function, controller.user_data
    # Without data of the user's the fifth argument is a null pointer, as for scipy.
    admissible = [_ARGUMENTS + _DATA] + ([_ARGUMENTS] if data is None else [])
    if isinstance(function, ctypes._CFuncPtr):
        address = _of_ctypes(function, *admissible)
        arguments = [_kind(kind) for kind in function.argtypes]
    else:
        result, arguments = _types_of(controller.signature)
        _require(result, arguments, *admissible)
        address = _address_of(function, controller.signature)
    if data is not None:
        return address, ctypes.cast(data, ctypes.c_void_p).value
    return address, 0 if len(arguments) == len(_ARGUMENTS) + 1 else None


def _types_of(signature: str) -> tuple[str, list[str]]:
    """``double (long, double, void *)`` as the types of its result and of its arguments."""
    parts = re.fullmatch(r"\s*([\w ]+?)\s*\((.*)\)\s*", signature or "")
    if parts is None:
        return str(signature), []
    return parts[1], [re.sub(r"\s*\*\s*", " *", kind.strip()) for kind in parts[2].split(",")]


def _address_of(function: Any, signature: str) -> int:
    if type(function).__name__ == "PyCapsule":
        get_name = ctypes.pythonapi.PyCapsule_GetName
        get_name.restype, get_name.argtypes = ctypes.c_char_p, [ctypes.py_object]
        get_pointer = ctypes.pythonapi.PyCapsule_GetPointer
        get_pointer.restype, get_pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        return get_pointer(function, get_name(function))
    try:
        import cffi

        return int(cffi.FFI().cast("intptr_t", function))
    except (ImportError, TypeError):
        raise TypeError(f"the controller is a LowLevelCallable of {function!r}; admissible is {WANTED}") from None


def force_of(excitation: Any, duration: float, period: float) -> Any:
    """Instants (s), forces (N) and whether they are held between."""
    if callable(excitation):
        samples = int(np.floor(duration / period * (1.0 + 1e-12))) + 3
        times = np.arange(samples) * period
        forces = np.array([float(excitation(float(t))) for t in times])
    else:
        try:
            times, forces = (np.ascontiguousarray(values, dtype=float) for values in excitation)
        except (TypeError, ValueError):
            raise ValueError("excitation: admissible are a callable f(t) -> N and a pair of arrays (t, F)") from None
    if times.ndim != 1 or times.shape != forces.shape or times.size < 2:
        raise ValueError(
            f"excitation: t has the shape {times.shape} and F {forces.shape}; admissible is one dimension, the same, "
            "of two values or more"
        )
    return times, forces, False

"""Controllers and forces of the user's own."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

#: Of a compiled controller.
SIGNATURE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double)


def controller_of(controller: Any) -> Any:
    """None, a callable, or the address of a compiled one with that of its data."""
    if controller is None:
        return None
    if isinstance(controller, ctypes._CFuncPtr):
        return _of_ctypes(controller), None
    address = getattr(controller, "address", None)  # numba.cfunc
    if isinstance(address, int):
        return address, None
    if type(controller).__name__ == "LowLevelCallable":
        return _of_low_level_callable(controller)
    if callable(controller):
        return controller
    raise TypeError(
        f"controller = {controller!r}: admissible are a callable (k, t, displacement, velocity) -> force, "
        "a ctypes function, a numba.cfunc and a scipy.LowLevelCallable"
    )


def _of_ctypes(function: Any) -> int:
    arguments = function.argtypes
    if arguments is not None and tuple(arguments) != tuple(SIGNATURE._argtypes_):
        raise TypeError("the controller's arguments are not (int64 k, double t, double displacement, double velocity)")
    if function.restype is not ctypes.c_double:
        raise TypeError("the controller gives no double: set its restype to ctypes.c_double")
    address = ctypes.cast(function, ctypes.c_void_p).value
    if not address:
        raise ValueError("the controller is a null pointer")
    return address


def _of_low_level_callable(controller: Any) -> tuple[int, Any]:
    function = controller.function
    if isinstance(function, ctypes._CFuncPtr):
        address = ctypes.cast(function, ctypes.c_void_p).value
    else:
        get_name = ctypes.pythonapi.PyCapsule_GetName
        get_name.restype, get_name.argtypes = ctypes.c_char_p, [ctypes.py_object]
        get_pointer = ctypes.pythonapi.PyCapsule_GetPointer
        get_pointer.restype, get_pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        address = get_pointer(function, get_name(function))
    data = controller.user_data
    if data is not None:
        data = ctypes.cast(data, ctypes.c_void_p).value
    return address, data


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

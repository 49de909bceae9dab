"""Linear plants of the user's own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._case import Case, _made

Port = Union[int, "np.ndarray", "list[float]", None]


class Plant:
    """A linear plant of order N between a computer's command u (N) and a force F (N) on it:

        x' = A x + b u + c F,   z = h x,   Dz = r x

    z (m) is the displacement that the computer reads, its rate h A x what it reads as velocity, and Dz
    (m) what the drive's gap sees: its relative displacement, over which the play of the drive lies.
    :func:`plant` makes one; ``case()`` closes a loop on it and gives all methods of
    :class:`holdfast.Case` that are not about a cable: chart, boundary, stable_intervals, margins, design,
    response, simulate, spectrum, section, deviation, coverage, orbit, lyapunov, verdict, diagram.
    """

    def __init__(
        self,
        state_matrix: np.ndarray,
        command_input: np.ndarray,
        excitation_input: np.ndarray,
        displacement: np.ndarray,
        velocity: Optional[np.ndarray],
        relative: Optional[np.ndarray],
        initial_state: Optional[np.ndarray],
        lifts: Optional[tuple[np.ndarray, np.ndarray]],
    ) -> None:
        #: A, (N, N), 1/s
        self.state_matrix = _array(state_matrix, 2, "A")
        n = self.order
        if self.state_matrix.shape != (n, n):
            raise ValueError(f"A has the shape {self.state_matrix.shape}; admissible: square")
        #: b, (N,), and c, (N,)
        self.command_input = _array(command_input, 1, "b")
        self.excitation_input = _array(excitation_input, 1, "c")
        #: h, (N,)
        self.displacement = _array(displacement, 1, "the displacement's row")
        for row in (self.command_input, self.excitation_input, self.displacement):
            if row.shape != (n,):
                raise ValueError(f"a row or column has the shape {row.shape}; admissible: ({n},), as A has {n} states")
        #: what the computer reads as velocity, (N,)
        self.velocity = (
            self._rate(self.displacement, "the displacement")
            if velocity is None
            else _array(velocity, 1, "the velocity's row")
        )
        #: r, (N,), and its rate
        self.relative_displacement = (
            self.displacement if relative is None else _array(relative, 1, "the relative displacement's row")
        )
        self.relative_velocity = self._rate(self.relative_displacement, "the relative displacement")
        #: the state at t = 0, (N,)
        self.initial_state = np.zeros(n) if initial_state is None else _array(initial_state, 1, "the initial state")
        answer = float(self.relative_velocity @ self.command_input)
        size = np.linalg.norm(self.relative_velocity) * np.linalg.norm(self.command_input)
        if not abs(answer) > 1e-12 * size:
            raise ValueError(
                "the command does not move the drive's gap: r A b = 0; say with `relative` what the gap sees"
            )
        if lifts is None:
            lifts = self._lifts()
        self.displacement_lift, self.velocity_lift = (_array(lift, 1, "a lift") for lift in lifts)
        self._core = _core.OwnPlant(
            _core.PlantArrays(
                self.state_matrix,
                self.command_input,
                self.excitation_input,
                self.displacement,
                self.velocity,
                self.relative_displacement,
                self.relative_velocity,
                self.displacement_lift,
                self.velocity_lift,
                self.initial_state,
            )
        )

    @property
    def order(self) -> int:
        """N."""
        return self.state_matrix.shape[0]

    def _rate(self, row: np.ndarray, name: str) -> np.ndarray:
        """The rate of a reading as a reading of the state."""
        if row.shape != (self.order,):
            raise ValueError(f"{name}'s row has the shape {row.shape}; admissible: ({self.order},)")
        for column, force in ((self.command_input, "the command"), (self.excitation_input, "the excitation")):
            if abs(row @ column) > 1e-12 * np.linalg.norm(row) * np.linalg.norm(column):
                raise ValueError(
                    f"{name} has a rate that jumps with {force}: it answers to a force with a velocity, not with an "
                    "acceleration, as no displacement does"
                )
        return row @ self.state_matrix

    def _lifts(self) -> tuple[np.ndarray, np.ndarray]:
        """States that move the gap's far side alone: by 1 m, and by 1 m/s. They are impulses of the two
        forces under which the displacement that is read keeps its velocity, so that they do not depend on
        the choice of states; where there are none the drive's own."""
        b, c = self.command_input, self.excitation_input
        h_v, r_v = self.displacement @ self.state_matrix, self.relative_velocity
        answers = np.array([[h_v @ b, h_v @ c], [r_v @ b, r_v @ c]])
        if abs(np.linalg.det(answers)) > 1e-9 * np.prod(np.linalg.norm(answers, axis=1) + 1e-300):
            alone = np.linalg.inv(answers)
            far = alone @ np.array([0.0, 1.0])
            near = alone @ np.array([1.0, 0.0])
            of_far, of_near = far[0] * b + far[1] * c, near[0] * b + near[1] * c
            moved = self.state_matrix @ of_far
            moved = moved - of_far * (r_v @ moved) - of_near * (h_v @ moved)
            return moved, of_far
        of_drive = b / (r_v @ b)
        moved = self.state_matrix @ of_drive
        return moved - of_drive * (r_v @ moved), of_drive

    def case(self, values: Optional[Mapping[str, Any]] = None, /, **tables: Any) -> Case:
        """A case on the plant: ``plant.case(control={"proportional_gain": -500, "sampling_period": 1e-3},
        backlash={"width": 5e-4})``. What is not given is that of the built-in case, but for the gains and
        the play, which are 0. [conductor], [absorber], [plant] and [initial] do not count here."""
        if "device" in tables or "device" in (values or {}):
            raise ValueError("device: the plant is one of your own, which has no place for it")
        begin = {"control.proportional_gain": 0.0, "control.differential_gain": 0.0, "backlash.width": 0.0}
        return Case._of(_made(None, "case", begin, self), self).with_(values, **tables)

    def eigenvalues(self) -> np.ndarray:
        """Those of A, (N,), 1/s."""
        return np.linalg.eigvals(self.state_matrix)

    def to_control(self) -> Any:
        """The plant as a continuous ``control.StateSpace``: inputs u and F (N), outputs displacement (m)
        and velocity (m/s) as the computer reads them, and the relative displacement (m)."""
        import control

        return control.ss(
            self.state_matrix,
            np.column_stack([self.command_input, self.excitation_input]),
            np.vstack([self.displacement, self.velocity, self.relative_displacement]),
            np.zeros((3, 2)),
            inputs=["u", "F"],
            outputs=["displacement", "velocity", "relative_displacement"],
        )

    def _arrays(self) -> tuple[np.ndarray, ...]:
        return (
            self.state_matrix,
            self.command_input,
            self.excitation_input,
            self.displacement,
            self.velocity,
            self.relative_displacement,
            self.initial_state,
            self.displacement_lift,
            self.velocity_lift,
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Plant):
            return NotImplemented
        return all(np.array_equal(one, another) for one, another in zip(self._arrays(), other._arrays()))

    def __hash__(self) -> int:
        return hash(tuple(array.tobytes() for array in self._arrays()))

    def __copy__(self) -> Plant:
        return self

    def __deepcopy__(self, memo: Any) -> Plant:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        *others, of_displacement, of_velocity = self._arrays()
        return Plant, (*others, (of_displacement, of_velocity))

    def __repr__(self) -> str:
        return f"<holdfast.Plant of order {self.order}>"


def plant(
    system: Any,
    *,
    command: int = 0,
    excitation: Optional[int] = None,
    displacement: int = 0,
    velocity: Optional[int] = None,
    relative: Port = None,
    initial_state: Any = None,
    lifts: Any = None,
) -> Plant:
    """A plant from a linear system, of any order.

    :param system: a continuous and strictly proper ``scipy.signal`` StateSpace, TransferFunction or
        ZerosPolesGain, a ``control`` StateSpace or TransferFunction, or arrays (A, B, C), SI units
    :param command: which input is the computer's command u, N
    :param excitation: which input is the force F, N; None: the second one, or with one input that one,
        F entering where u does
    :param displacement: which output the computer reads as displacement, m
    :param velocity: which output it reads as velocity, m/s; None: the rate of the displacement. Margins and
        designs need that one
    :param relative: what the drive's gap sees, m: which output, or a row of the state; None: the
        displacement itself, as of a drive that pushes against the ground
    :param initial_state: (N,); None: at rest
    :param lifts: a pair of states (N,) that change the gap by 1 m and by 1 m/s; None: those that move its
        far side alone
    :raises ValueError: shapes that do not fit, numbers that are not finite, a system in discrete time or
        with a direct transmission, a drive that does not move its gap

    >>> import control
    >>> case = holdfast.plant(control.ss(A, B, C, 0)).case(control={"differential_gain": -20})
    >>> case.margins()
    """
    a, b, c = _matrices(system)
    inputs, outputs = b.shape[1], c.shape[0]
    u = _which(command, inputs, "command", "input")
    f = _which((1 if inputs > 1 else 0) if excitation is None else excitation, inputs, "excitation", "input")
    z = _which(displacement, outputs, "displacement", "output")
    v = None if velocity is None else c[_which(velocity, outputs, "velocity", "output")]
    if relative is None:
        r = None
    elif isinstance(relative, (int, np.integer)):
        r = c[_which(int(relative), outputs, "relative", "output")]
    else:
        r = relative
    return Plant(a, b[:, u], b[:, f], c[z], v, r, initial_state, lifts)


def _which(index: Any, count: int, name: str, kind: str) -> int:
    if not isinstance(index, (int, np.integer)) or isinstance(index, bool) or not 0 <= index < count:
        raise ValueError(f"{name} = {index!r}: admissible is the number of an {kind}, 0 … {count - 1}")
    return int(index)


def _array(values: Any, dimensions: int, name: str) -> np.ndarray:
    try:
        array = np.asarray(values)
        if np.iscomplexobj(array):
            raise ValueError
        array = np.array(array, dtype=float, order="C")  # its own: the plant never changes
    except (TypeError, ValueError):
        raise ValueError(f"{name}: admissible are real numbers") from None
    if array.ndim != dimensions or array.size == 0:
        raise ValueError(f"{name} has the shape {array.shape}; admissible: {dimensions} dimension(s), not empty")
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} has entries that are not finite")
    array.flags.writeable = False
    return array


def _matrices(system: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    if isinstance(system, tuple) and len(system) == 3:
        a, b, c = system
        direct = 0.0
    else:
        a, b, c, direct = _of_state_space(system)
    a, b, c = np.asarray(a), np.asarray(b), np.asarray(c)
    a = _array(a, 2, "A")
    b = _array(b[:, None] if b.ndim == 1 else b, 2, "B")
    c = _array(c[None, :] if c.ndim == 1 else c, 2, "C")
    n = a.shape[0]
    if a.shape != (n, n) or b.shape[0] != n or c.shape[1] != n:
        raise ValueError(f"A, B, C have the shapes {a.shape}, {b.shape}, {c.shape}; admissible: (N, N), (N, M), (K, N)")
    if np.any(np.asarray(direct) != 0.0):
        raise ValueError("the system has a direct transmission D: no displacement answers to a force at once")
    return a, b, c


def _of_state_space(system: Any) -> tuple[Any, Any, Any, Any]:
    if not hasattr(system, "dt"):
        raise TypeError(
            f"{type(system).__name__} is no linear system: admissible are those of scipy.signal and control, and arrays (A, B, C)"
        )
    if system.dt not in (None, 0, 0.0):
        raise ValueError(
            "the system is in discrete time; admissible is a continuous one, which holdfast samples itself"
        )
    if not hasattr(system, "A"):
        if hasattr(system, "to_ss"):  # scipy.signal
            system = system.to_ss()
        else:
            import control

            system = control.ss(system)
    return system.A, system.B, system.C, system.D

"""The compiled part of holdfast: its names may change, those of holdfast do not."""

from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

version: str

class NoAnswer(RuntimeError):
    """The question is fair and the computation has no answer to it; the message says why."""

def run_program(arguments: Sequence[str]) -> int: ...

class PlantArrays:
    def __init__(
        self,
        state_matrix: NDArray[np.float64],
        command_input: NDArray[np.float64],
        excitation_input: NDArray[np.float64],
        displacement: NDArray[np.float64],
        velocity: NDArray[np.float64],
        relative_displacement: NDArray[np.float64],
        relative_velocity: NDArray[np.float64],
        displacement_lift: NDArray[np.float64],
        velocity_lift: NDArray[np.float64],
        initial_state: NDArray[np.float64],
    ) -> None: ...

class OwnPlant:
    def __init__(self, arrays: PlantArrays) -> None: ...

class Case:
    def __init__(
        self, text: Optional[str], name: str, overrides: Sequence[str], plant: Optional[OwnPlant] = None
    ) -> None: ...
    def with_overrides(self, overrides: Sequence[str]) -> Case: ...
    def toml(self) -> str: ...
    def json(self) -> str: ...
    def origin(self, job: str, options: Sequence[tuple[str, str]], instructions: str) -> str: ...
    def has_own_plant(self) -> bool: ...
    def source(self) -> tuple[Optional[str], str, list[str]]: ...
    def plant_matrices(self) -> dict[str, Any]: ...

def run_job(
    case: Case,
    arguments: Sequence[str],
    watch: Optional[Callable[[int, int], Any]] = None,
    controller: Optional[Callable[[int, float, float, float], float] | tuple[int, Optional[int]]] = None,
    force: Optional[tuple[NDArray[np.float64], NDArray[np.float64], bool]] = None,
) -> tuple[list[dict[str, Any]], list[str]]: ...
def chart(
    case: Case,
    proportional: tuple[float, float, int],
    differential: tuple[float, float, int],
    radius: bool,
    threads: int,
    instructions: str,
    watch: Optional[Callable[[int, int], Any]] = None,
) -> tuple[
    NDArray[np.bool_],
    Optional[NDArray[np.float64]],
    list[str],
    tuple[NDArray[np.float64], NDArray[np.float64]],
]: ...

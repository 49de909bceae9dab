"""Made of _case.py by python/stub.py."""

from typing_extensions import Unpack, overload

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Optional, Union
from ._store import Store
from ._table import Table
from ._typing import How, Interval, Path, Range, Switching

class PlausibilityWarning(UserWarning):
    pass

class Case:

    def __init__(self, source: Optional[Union[Path, Mapping[str, Any], Case]]=None, /, **tables: Any) -> None:
        ...

    @classmethod
    def from_toml(cls, text: str, /, **tables: Any) -> Case:
        ...

    def with_(self, values: Optional[Mapping[str, Any]]=None, /, **tables: Any) -> Case:
        ...

    def to_dict(self) -> dict[str, Any]:
        ...

    def to_toml(self) -> str:
        ...

    def __getitem__(self, key: str) -> Any:
        ...

    def __contains__(self, key: object) -> bool:
        ...

    def __iter__(self) -> Iterator[str]:
        ...

    def __len__(self) -> int:
        ...

    def __eq__(self, other: object) -> bool:
        ...

    def __hash__(self) -> int:
        ...

    @overload
    def explain(self, **how: Unpack[How]) -> Table:
        ...

    @overload
    def explain(self, *, output: Path, **how: Unpack[How]) -> None:
        ...

    @overload
    def reduce(self, **how: Unpack[How]) -> Table:
        ...

    @overload
    def reduce(self, *, output: Path, **how: Unpack[How]) -> None:
        ...

    @overload
    def statics(self, force: Range=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def statics(self, force: Range=None, *, output: Path, **how: Unpack[How]) -> None:
        ...

    @overload
    def sag_tension(self, temperature: Range=None, *, initial: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def sag_tension(self, temperature: Range=None, *, output: Path, initial: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def modes(self, count: Optional[int]=None, *, elements: Optional[int]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def modes(self, count: Optional[int]=None, *, output: Path, elements: Optional[int]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def decay(self, force: Optional[float]=None, *, duration: Optional[float]=None, absorber: Optional[Literal['weight', 'rigid', 'spring']]=None, equal_displacement: bool=False, elements: Optional[int]=None, interval: Optional[float]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def decay(self, force: Optional[float]=None, *, output: Path, duration: Optional[float]=None, absorber: Optional[Literal['weight', 'rigid', 'spring']]=None, equal_displacement: bool=False, elements: Optional[int]=None, interval: Optional[float]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def peaks(self, force: Range=None, *, duration: Optional[float]=None, absorber: Optional[Literal['weight', 'rigid', 'spring']]=None, equal_displacement: bool=False, elements: Optional[int]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def peaks(self, force: Range=None, *, output: Path, duration: Optional[float]=None, absorber: Optional[Literal['weight', 'rigid', 'spring']]=None, equal_displacement: bool=False, elements: Optional[int]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def fit(self, data: Optional[Path]=None, *, parameters: Optional[str]=None, target: Optional[Literal['history', 'peak', 'measures']]=None, plain: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def fit(self, data: Optional[Path]=None, *, output: Path, parameters: Optional[str]=None, target: Optional[Literal['history', 'peak', 'measures']]=None, plain: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def chart(self, p: Range=(-1000.0, 200.0, 121), d: Range=(-40.0, 20.0, 121), *, store: None=None, radius: bool=False, continuous: bool=False, axes: Optional[Mapping[str, Range]]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def chart(self, p: Range=(-1000.0, 200.0, 121), d: Range=(-40.0, 20.0, 121), *, store: Path, radius: bool=False, continuous: bool=False, axes: Optional[Mapping[str, Range]]=None, **how: Unpack[How]) -> Store:
        ...

    @overload
    def chart(self, p: Range=(-1000.0, 200.0, 121), d: Range=(-40.0, 20.0, 121), *, output: Path, store: None=None, radius: bool=False, continuous: bool=False, axes: Optional[Mapping[str, Range]]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def proved_chart(self, p: Range=(-1000.0, 200.0, 121), d: Range=(-40.0, 20.0, 121), *, continuous: bool=False, undecided: float=0.001, **how: Unpack[How]) -> Table:
        ...

    @overload
    def proved_chart(self, p: Range=(-1000.0, 200.0, 121), d: Range=(-40.0, 20.0, 121), *, output: Path, continuous: bool=False, undecided: float=0.001, **how: Unpack[How]) -> None:
        ...

    @overload
    def proved_family(self, **how: Unpack[How]) -> Table:
        ...

    @overload
    def proved_family(self, *, output: Path, **how: Unpack[How]) -> None:
        ...

    @overload
    def boundary(self, p: Interval=None, *, continuous: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def boundary(self, p: Interval=None, *, output: Path, continuous: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def stable_intervals(self, p: Any=None, d: Any=None, *, continuous: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def stable_intervals(self, p: Any=None, d: Any=None, *, output: Path, continuous: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def gain_regions(self, p: Interval=None, d: Interval=None, *, continuous: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def gain_regions(self, p: Interval=None, d: Interval=None, *, output: Path, continuous: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def response(self, p: Range=(-1000.0, 200.0, 61), d: Range=(-40.0, 20.0, 61), *, store: None=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def response(self, p: Range=(-1000.0, 200.0, 61), d: Range=(-40.0, 20.0, 61), *, store: Path, **how: Unpack[How]) -> Store:
        ...

    @overload
    def response(self, p: Range=(-1000.0, 200.0, 61), d: Range=(-40.0, 20.0, 61), *, output: Path, store: None=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def design(self, frequency: Range=None, *, band: Interval=None, both_gains: bool=False, largest_radius: Optional[float]=None, margin: Optional[float]=None, largest_ratio: Optional[float]=None, schedule: Optional[str]=None, prove: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def design(self, frequency: Range=None, *, output: Path, band: Interval=None, both_gains: bool=False, largest_radius: Optional[float]=None, margin: Optional[float]=None, largest_ratio: Optional[float]=None, schedule: Optional[str]=None, prove: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def margins(self, *, prove: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def margins(self, *, output: Path, prove: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def modal_damping(self, count: Optional[int]=None, *, no_control: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def modal_damping(self, count: Optional[int]=None, *, output: Path, no_control: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def sensitivity(self, **how: Unpack[How]) -> Table:
        ...

    @overload
    def sensitivity(self, *, output: Path, **how: Unpack[How]) -> None:
        ...

    @overload
    def max_delay(self, frequency: Range=None, *, criterion: Optional[Literal['stable', 'attenuates']]=None, prove: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def max_delay(self, frequency: Range=None, *, output: Path, criterion: Optional[Literal['stable', 'attenuates']]=None, prove: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def simulate(self, duration: float=10.0, *, from_: float=0.0, kick: Optional[tuple[float, float]]=None, no_control: bool=False, switching: Switching='sampled', plant: Optional[Literal['case', 'elements']]=None, elements: Optional[int]=None, controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def simulate(self, duration: float=10.0, *, output: Path, from_: float=0.0, kick: Optional[tuple[float, float]]=None, no_control: bool=False, switching: Switching='sampled', plant: Optional[Literal['case', 'elements']]=None, elements: Optional[int]=None, controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def spectrum(self, duration: float=60.0, *, discard: Optional[float]=None, window: Optional[Literal['rectangular', 'hann']]=None, switching: Switching='sampled', controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def spectrum(self, duration: float=60.0, *, output: Path, discard: Optional[float]=None, window: Optional[Literal['rectangular', 'hann']]=None, switching: Switching='sampled', controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def section(self, duration: float=60.0, *, from_: float=30.0, switching: Switching='sampled', controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def section(self, duration: float=60.0, *, output: Path, from_: float=30.0, switching: Switching='sampled', controller: Any=None, excitation: Any=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def deviation(self, duration: Optional[float]=None, *, offset: Optional[float]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def deviation(self, duration: Optional[float]=None, *, output: Path, offset: Optional[float]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def coverage(self, durations: Any=None, *, window: Any=None, cells: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def coverage(self, durations: Any=None, *, output: Path, window: Any=None, cells: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def orbit(self, max_period: Optional[int]=None, *, switching: Optional[Switching]=None, trace: bool=False, certificate: bool=False, prove: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def orbit(self, max_period: Optional[int]=None, *, output: Path, switching: Optional[Switching]=None, trace: bool=False, certificate: bool=False, prove: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def orbit_ends(self, key: str, interval: Interval, *, max_period: Optional[int]=None, prove: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def orbit_ends(self, key: str, interval: Interval, *, output: Path, max_period: Optional[int]=None, prove: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def orbit_borders(self, keys: Mapping[str, Interval], *, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def orbit_borders(self, keys: Mapping[str, Interval], *, output: Path, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def lyapunov(self, duration: Optional[float]=None, *, discard: Optional[float]=None, tangent: Optional[Literal['consistent', 'printed']]=None, largest: bool=False, history: bool=False, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def lyapunov(self, duration: Optional[float]=None, *, output: Path, discard: Optional[float]=None, tangent: Optional[Literal['consistent', 'printed']]=None, largest: bool=False, history: bool=False, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def verdict(self, max_period: Optional[int]=None, *, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def verdict(self, max_period: Optional[int]=None, *, output: Path, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def basins(self, axes: Mapping[str, Range], *, store: None=None, fractions: bool=False, duration: Optional[float]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def basins(self, axes: Mapping[str, Range], *, store: Path, fractions: bool=False, duration: Optional[float]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Store:
        ...

    @overload
    def basins(self, axes: Mapping[str, Range], *, output: Path, store: None=None, fractions: bool=False, duration: Optional[float]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def motions(self, keys: Mapping[str, Range], *, store: None=None, starts: Optional[Mapping[str, Range]]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def motions(self, keys: Mapping[str, Range], *, store: Path, starts: Optional[Mapping[str, Range]]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Store:
        ...

    @overload
    def motions(self, keys: Mapping[str, Range], *, output: Path, store: None=None, starts: Optional[Mapping[str, Range]]=None, max_period: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def diagram(self, key: str, values: Range, *, transient: Optional[float]=None, strobes: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def diagram(self, key: str, values: Range, *, output: Path, transient: Optional[float]=None, strobes: Optional[int]=None, switching: Optional[Switching]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def sweep(self, axes: Mapping[str, Any], metrics: Sequence[str]=(), *, store: None=None, duration: Optional[float]=None, best_gain: bool=False, max_period: Optional[int]=None, switching: Optional[Switching]=None, client: Any=None, resume: bool=False, part: Optional[tuple[int, int]]=None, chunk: Optional[int]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def sweep(self, axes: Mapping[str, Any], metrics: Sequence[str]=(), *, store: Path, duration: Optional[float]=None, best_gain: bool=False, max_period: Optional[int]=None, switching: Optional[Switching]=None, client: Any=None, resume: bool=False, part: Optional[tuple[int, int]]=None, chunk: Optional[int]=None, **how: Unpack[How]) -> Store:
        ...

    @overload
    def sweep(self, axes: Mapping[str, Any], metrics: Sequence[str]=(), *, output: Path, store: None=None, duration: Optional[float]=None, best_gain: bool=False, max_period: Optional[int]=None, switching: Optional[Switching]=None, client: Any=None, resume: bool=False, part: Optional[tuple[int, int]]=None, chunk: Optional[int]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def absorption(self, frequency: Range=None, *, end: Optional[Literal['left', 'right']]=None, no_control: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def absorption(self, frequency: Range=None, *, output: Path, end: Optional[Literal['left', 'right']]=None, no_control: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def aeolian(self, frequency: Range=None, *, no_control: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def aeolian(self, frequency: Range=None, *, output: Path, no_control: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def fatigue(self, frequency: Interval=None, *, no_control: bool=False, by_speed: bool=False, by_temperature: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def fatigue(self, frequency: Interval=None, *, output: Path, no_control: bool=False, by_speed: bool=False, by_temperature: bool=False, **how: Unpack[How]) -> None:
        ...

    @overload
    def place(self, device: Optional[Union[int, str]]=None, *, frequency: Range=None, for_: Optional[Literal['strain', 'damping']]=None, modes: Optional[tuple[int, int]]=None, keep: Optional[Literal['position']]=None, margin: Optional[float]=None, **how: Unpack[How]) -> Table:
        ...

    @overload
    def place(self, device: Optional[Union[int, str]]=None, *, output: Path, frequency: Range=None, for_: Optional[Literal['strain', 'damping']]=None, modes: Optional[tuple[int, int]]=None, keep: Optional[Literal['position']]=None, margin: Optional[float]=None, **how: Unpack[How]) -> None:
        ...

    @overload
    def answers(self, *, details: bool=False, **how: Unpack[How]) -> Table:
        ...

    @overload
    def answers(self, *, output: Path, details: bool=False, **how: Unpack[How]) -> None:
        ...

    def report(self, folder: Path, *, for_: Optional[Literal['control', 'span']]=None, **how: Unpack[How]) -> None:
        ...

    def explore(self, file: Path, **how: Unpack[How]) -> None:
        ...

    def to_control(self, *, closed: bool=False) -> Any:
        ...

    def plant_matrices(self) -> dict[str, Any]:
        ...

def conductors(find: Optional[str]=None) -> Table:
    ...

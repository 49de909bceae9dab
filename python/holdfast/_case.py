"""Cases and the jobs on them."""

from __future__ import annotations

import html
import json
import os
import warnings
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Optional, Union

from . import _core, _options, _toml
from ._drive import controller_of, force_of
from ._errors import speaking_python, suggestion, words_of
from ._progress import watch_of
from ._store import Store, store_name
from ._table import Table
from ._typing import How, Interval, Path, Range, Switching

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._plant import Plant

#: Whose result is cells over axes, which a store can hold.
_JOBS_OF_CELLS = ("stability", "response", "basins", "sweep")
_JOBS_OF_FAMILIES = ("stability", "boundary", "response", "design", "margins", "max-delay", "modal-damping",
                     "aeolian", "sweep")  # fmt: skip
#: Of [excitation], where a force of the user's own takes its place.
_WITHOUT_FORCE = ("amplitude=0.0", "harmonics=[]", "noise_rms=0.0", 'record=""')


class PlausibilityWarning(UserWarning):
    """What is to be known of a case or a result: a value that is not plausible, digits that rounding
    decides, a motion that diverges."""


def _warn(texts: Sequence[str]) -> None:
    for text in texts:
        warnings.warn(words_of(text.removeprefix("warning: ")), PlausibilityWarning, stacklevel=4)


class Case:
    """What a case file says: conductor, absorber, plant, control, backlash, excitation; SI units.

    >>> case = holdfast.Case()                                       # the paper's
    >>> case = holdfast.Case("my.toml")                              # a case file
    >>> case = holdfast.Case({"control": {"sampling_period": 0.002}})
    >>> case = holdfast.Case(control={"differential_gain": -13})     # further values by keyword
    >>> case = case.with_({"control.sampling_period": 0.002}, backlash={"width": 0.001})
    >>> case["control.sampling_period"]
    0.002

    A case never changes; ``with_`` makes another. Every method that answers a question gives a
    :class:`Table` and takes besides its own the keywords ``threads`` (0: all), ``instructions``
    (``"baseline"``, ``"avx2"``, ``"avx512"``), ``progress`` (True: tqdm where it is installed, or a
    callable ``(done, total)``), ``output`` (a file of the program's instead; then nothing is returned)
    and ``yes`` (gigabytes of rows are meant). Chart, boundary, response, design, margins, max_delay and
    modal_damping take ``family`` (True: the worst over ``[uncertain]``) and ``draws``. What holds for the program holds here: ``holdfast JOB --help`` explains
    each option further.

    :param source: a case file, a dict of its tables (nested or with dotted keys), another case; None:
        the built-in case. A file or dict that gives the conductor's name, mass, span, tension or sag,
        or the whole plant, is a cable of its own: nothing of the built-in case stands in for what it
        does not give. Any other varies the built-in case. A number may be a text with a unit,
        ``"28.2 kN"``.
    :param tables: further values, ``control={"processing_delay": 0.001}``; ``device`` is a list of
        dicts, or one, that are added
    :raises ValueError: an unknown key, or a value that is not admissible; the message names key,
        value and range
    """

    __slots__ = ("_core", "_plant")

    def __init__(self, source: Optional[Union[Path, Mapping[str, Any], Case]] = None, /, **tables: Any) -> None:
        if isinstance(source, Case):
            other = source.with_(**tables) if tables else source
            self._core, self._plant = other._core, other._plant
            return
        text, name = None, "case"
        if isinstance(source, Mapping):
            text = _toml.tables_text(source)
        elif source is not None:
            name = os.path.abspath(os.fspath(source))
            text = _file_text(name)
        self._core, self._plant = _made(*_with_devices(text, name, tables), tables), None

    @classmethod
    def from_toml(cls, text: str, /, **tables: Any) -> Case:
        """A case from the text of a case file."""
        if not isinstance(text, str):
            raise TypeError(f"the text of a case file is a str, not {text!r}")
        return cls._of(_made(*_with_devices(text, "case", tables), tables))

    @classmethod
    def _of(cls, core: Any, plant: Optional[Plant] = None) -> Case:
        made = cls.__new__(cls)
        made._core, made._plant = core, plant
        return made

    def with_(self, values: Optional[Mapping[str, Any]] = None, /, **tables: Any) -> Case:
        """The case with other values: a dict, nested or with dotted keys, keywords, or both."""
        if values is not None and not isinstance(values, Mapping):
            raise TypeError(f"values of a case are a dict, not {values!r}")
        given = dict(values or {})
        if "device" in tables or "device" in given:
            if self._core.has_own_plant():
                raise ValueError("device: the plant is one of your own, which has no place for it")
            core = _made(self.to_toml() + _toml.devices_text(given) + _toml.devices_text(tables), "case", {})
        else:
            core = self._core
        _require_tables(given, tables)
        with speaking_python():
            return Case._of(core.with_overrides(_toml.overrides(given) + _toml.overrides(tables)), self._plant)

    # -- what it says ------------------------------------------------------------------------------
    def to_dict(self) -> dict[str, Any]:
        """All tables with all of their keys; on a plant of your own without those of the cable."""
        return json.loads(self._core.json())

    def to_toml(self) -> str:
        """The whole case as a commented case file."""
        return self._core.toml()

    def __getitem__(self, key: str) -> Any:
        """A value, ``case["control.sampling_period"]``, or a table, ``case["control"]``."""
        found: Any = self.to_dict()
        for part in str(key).split("."):
            try:
                found = found[int(part) - 1] if isinstance(found, list) and int(part) > 0 else found[part]
            except (KeyError, IndexError, TypeError, ValueError):
                names = f"the case has {', '.join(found)}" if isinstance(found, dict) else "the case has no such key"
                raise KeyError(f"{key}: {names}") from None
        return found

    def __contains__(self, key: object) -> bool:
        try:
            self[key]  # type: ignore[index]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        """The names of the tables, as those of ``to_dict()``."""
        return iter(self.to_dict())

    def __len__(self) -> int:
        return len(self.to_dict())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        return self._plant == other._plant and self._core.json() == other._core.json()

    def __hash__(self) -> int:
        return hash(self._core.json())

    def __copy__(self) -> Case:
        return self

    def __deepcopy__(self, memo: Any) -> Case:
        return self

    def __repr__(self) -> str:
        control = self.to_dict()["control"]
        plant = "a plant of your own" if self._core.has_own_plant() else self["plant.model"]
        return (
            f"<holdfast.Case {plant}: P = {control['proportional_gain']} N/m, "
            f"D = {control['differential_gain']} N s/m, tau = {control.get('sampling_period', '?')} s>"
        )

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(table)}.{html.escape(key)}</td><td>{html.escape(str(value))}</td></tr>"
            for table, keys in self.to_dict().items()
            if isinstance(keys, dict)
            for key, value in keys.items()
        )
        return f"<details open><summary>{html.escape(repr(self))}</summary><table>{rows}</table></details>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (*self._core.source(), self._plant)

    # -- running a job -----------------------------------------------------------------------------
    def _run(self, job: str, words: Sequence[str], how: dict[str, Any], *own: Any) -> Any:
        """The table of a job, or the store that it has written; its warnings are Python's."""
        how = dict(how)
        store = how.pop("store", None) if job in _JOBS_OF_CELLS else None
        if store is not None:
            if how.get("output") is not None:
                raise TypeError("store and output: admissible is one of them")
            how["output"] = store_name(store)
        tables, texts = self._ask(job, words, how, *own)
        _warn(texts)
        if store is not None:
            return Store(store)
        return Table(job, tables[-1]) if tables else None

    def _ask(
        self,
        job: str,
        words: Sequence[str],
        how: dict[str, Any],
        controller: Any = None,
        excitation: Any = None,
        duration: float = 0.0,
    ) -> tuple[list[dict[str, Any]], list[str]]:
        """The tables of a job and its warnings."""
        how = dict(how)
        progress = how.pop("progress", None)
        common = ("threads", "instructions", "output", "yes")
        common += ("family", "draws") if job in _JOBS_OF_FAMILIES else ()
        given = {name: how.pop(name, None) for name in common}
        _refuse_unknown(how)
        given["threads"] = _options.threads_of(given["threads"])
        if given["output"] is not None:
            given["output"] = os.fspath(given["output"])
        core, force = self._core, None
        if excitation is not None:
            force = force_of(excitation, duration, self["control.sampling_period"])
            core = core.with_overrides([f"excitation.{key}" for key in _WITHOUT_FORCE])
        with watch_of(job, progress) as watch, speaking_python():
            return _core.run_job(
                core, [job, *words, *_options.arguments(given)], watch, controller_of(controller), force
            )

    # -- the case and its cable ---------------------------------------------------------------------

    def explain(self, **how: Unpack[How]) -> Table:
        """Every key of the case with value, unit, origin and meaning, and what follows from them: natural
        frequencies, spectral radius, stable D about the case's. Columns ``key, value, unit, origin,
        meaning``, all words.
        """
        return self._run("case", _options.arguments({}), how)

    def reduce(self, **how: Unpack[How]) -> Table:
        """The six parameters m1, k1, c1, m2, k2, c2 of the two masses from conductor and absorber, and how
        sure each is. Columns ``quantity, symbol, value, unit``; ``table.value("conductor_mass")``.
        """
        return self._run("reduce", _options.arguments({}), how)

    def statics(self, force: Range = None, **how: Unpack[How]) -> Table:
        """Force F (N, downward, beyond the absorber's weight) and displacement (m) of the absorber's place:
        two elastic catenaries, Irvine's Eq. 1, the plant's spring, finite elements. Columns ``force_N,
        exact_m, irvine_m, linear_m, elements_m``.

        :param force: (min, max, count), N
        """
        return self._run("statics", _axis("force", force), how)

    def sag_tension(self, temperature: Range = None, *, initial: bool = False, **how: Unpack[How]) -> Table:
        """Tension and sag of the strung span over temperature, and under its heaviest load. Columns ``state,
        temperature_C, ice_m, wind_pressure_Pa, tension_N, horizontal_tension_N, sag_m, core_share,
        first_frequency_Hz``.

        :param temperature: (min, max, count), °C
        :param initial: of the new span, before creep and the heaviest load
        """
        words = [*_axis("temperature", temperature), *_options.arguments({"initial": initial})]
        return self._run("sag-tension", words, how)

    def modes(self, count: Optional[int] = None, *, elements: Optional[int] = None, **how: Unpack[How]) -> Table:
        """Natural frequencies (Hz) of the bare conductor in its plane: Irvine and Caughey, and finite
        elements. Columns ``mode, family, irvine_Hz, elements_Hz,
        along_share``.
        """
        return self._run("modes", _options.arguments({"count": count, "elements": elements}), how)

    def decay(
        self,
        force: Optional[float] = None,
        *,
        duration: Optional[float] = None,
        absorber: Optional[Literal["weight", "rigid", "spring"]] = None,
        equal_displacement: bool = False,
        elements: Optional[int] = None,
        interval: Optional[float] = None,
        **how: Unpack[How],
    ) -> Table:
        """Vibration after a force (N) is removed: continuous cable beside the two masses. Columns ``time_s,
        elements_m, two_dof_m``.

        :param absorber: how it loads the cable: ``"weight"``, ``"rigid"``, ``"spring"``
        :param equal_displacement: both begin equally displaced, not under the same force
        """
        return self._run(
            "decay",
            _options.arguments(
                {
                    "force": force,
                    "duration": duration,
                    "absorber": absorber,
                    "equal_displacement": equal_displacement,
                    "elements": elements,
                    "interval": interval,
                }
            ),
            how,
        )

    def peaks(
        self,
        force: Range = None,
        *,
        duration: Optional[float] = None,
        absorber: Optional[Literal["weight", "rigid", "spring"]] = None,
        equal_displacement: bool = False,
        elements: Optional[int] = None,
        **how: Unpack[How],
    ) -> Table:
        """First opposite peak (m) after a force is removed, over the force. Columns ``force_N,
        elements_peak_m, two_dof_peak_m, discrepancy``.

        :param force: (min, max, count), N
        """
        words = _axis("force", force) + _options.arguments(
            {"duration": duration, "absorber": absorber, "equal_displacement": equal_displacement, "elements": elements}
        )
        return self._run("peaks", words, how)

    def fit(
        self,
        data: Optional[Path] = None,
        *,
        parameters: Optional[str] = None,
        target: Optional[Literal["history", "peak", "measures"]] = None,
        plain: bool = False,
        **how: Unpack[How],
    ) -> Table:
        """Damping of the absorber (or more) from a decay record by least squares. Columns ``quantity, value,
        standard_error, unit``.

        :param data: CSV file with the columns ``time_s, displacement_m``; None: the continuous cable
        :param parameters: keys of [plant] between commas
        :param target: ``"history"``, ``"peak"`` or ``"measures"``
        :param plain: without the robust loss
        """
        return self._run(
            "fit",
            _options.arguments(
                {
                    "data": None if data is None else os.fspath(data),
                    "parameters": parameters,
                    "target": target,
                    "plain": plain,
                }
            ),
            how,
        )

    # -- gains --------------------------------------------------------------------------------------

    def chart(
        self,
        p: Range = (-1000.0, 200.0, 121),
        d: Range = (-40.0, 20.0, 121),
        *,
        radius: bool = False,
        continuous: bool = False,
        axes: Optional[Mapping[str, Range]] = None,
        store: Optional[Path] = None,
        **how: Unpack[How],
    ) -> Union[Table, Store]:
        """Where the sampled loop without play is stable: all roots of det(lambda I - S(P, D)) = 0 within the
        unit circle. Columns ``stable`` (bool) and, with ``radius``, ``spectral_radius`` (largest modulus of a
        root), of shape (P, D).

        :param p: proportional gains P, N/m; (min, max, count) or an array in equal steps
        :param d: differential gains D, N s/m
        :param radius: the spectral radius too
        :param continuous: of the continuous loop, whose ``radius`` is its spectral abscissa (1/s)
        :param axes: two keys of [control] or [plant] with their ranges in place of P and D
        :param store: a folder ``NAME.zarr``, which the cells are written to as they come, and which is
            returned then; one that is there already is gone on with
        """
        if not (continuous or axes or store or "output" in how or "family" in how):
            return self._chart(p, d, radius, how)
        words = _options.arguments({"continuous": continuous, "radius": radius})
        words += _options.axes_texts(axes, 2) if axes else _axis("p", p) + _axis("d", d)
        return self._run("stability", words, {**how, "store": store})

    def proved_chart(
        self,
        p: Range = (-1000.0, 200.0, 121),
        d: Range = (-40.0, 20.0, 121),
        *,
        continuous: bool = False,
        undecided: float = 1e-3,
        **how: Unpack[How],
    ) -> Table:
        """Boxes of gains of which interval arithmetic proves that every loop is stable, or that every one is
        unstable: the cells between the points of p and d, quartered where that is needed. It is of the decimals of
        the case, and of a string or cable of its modes as they are kept, in doubles. Columns
        ``proportional_gain_from``, ``proportional_gain_to``, ``differential_gain_from``, ``differential_gain_to``,
        ``proved`` (stable, unstable, undecided), ``area_share``.

        :param p: proportional gains P, N/m; (min, max, count) or an array in equal steps
        :param d: differential gains D, N s/m
        :param continuous: of the continuous loop
        :param undecided: the share of the area that may be left undecided, 1e-6 to 0.5
        """
        words = ["--prove", *_options.arguments({"continuous": continuous, "undecided": undecided})]
        return self._run("stability", words + _axis("p", p) + _axis("d", d), how)

    def proved_family(self, **how: Unpack[How]) -> Table:
        """Whether interval arithmetic proves that every member of the family of ``[uncertain]`` is stable at its
        own gains, or that one is not. Columns ``proved`` (stable, unstable, undecided), ``stable_share``,
        ``undecided_share``, ``parts``, ``worst_member``.
        """
        return self._run("stability", ["--family", "--prove"], how)

    def _chart(self, p: Range, d: Range, radius: bool, how: dict[str, Any]) -> Table:
        """A chart over gains, whose cells the kernels write where they stay."""
        how = dict(how)
        progress = how.pop("progress", None)
        threads, instructions = how.pop("threads", None), how.pop("instructions", None)
        _refuse_unknown(how)
        over = (_options.axis_of(p, "p"), _options.axis_of(d, "d"))
        asked = (self._core, *over, bool(radius), _options.threads_of(threads) or 0, instructions or "")
        with watch_of("stability", progress) as watch, speaking_python():
            stable, radii, texts, axes = _core.chart(*asked, watch)
        _warn(texts)
        columns = [("stable", "", "asymptotically stable", stable, None)]
        if radius:
            columns.append(("spectral_radius", "", "largest modulus of a characteristic root", radii, None))
        described = [("proportional_gain", "N/m", "P"), ("differential_gain", "N.s/m", "D")]
        return Table(
            "stability",
            {
                "axes": [(*about, values) for about, values in zip(described, axes)],
                "columns": columns,
                "origin": lambda: self._core.origin("stability", _chart_options(over, radius), instructions or ""),
            },
        )

    def boundary(self, p: Interval = None, *, continuous: bool = False, **how: Unpack[How]) -> Table:
        """The exact curves in the plane of P and D on which a root lies on the unit circle. Columns ``curve``
        (``plus_one``, ``minus_one``, ``complex_pair``), ``angle_rad``, ``proportional_gain`` (N/m),
        ``differential_gain`` (N s/m).

        :param p: (min, max) of P, N/m
        :param continuous: of the continuous loop: ``zero``, ``imaginary_pair``, the angle in rad/s
        """
        words = _interval("p", p) + _options.arguments({"continuous": continuous})
        return self._run("boundary", words, how)

    def stable_intervals(self, p: Any = None, d: Any = None, *, continuous: bool = False, **how: Unpack[How]) -> Table:
        """The open intervals of D that stabilise the loop at each P, and those of P at each D; without either
        at the case's gains. Columns ``gain, other_gain, lower, upper``.

        :param p: one P or several, N/m
        :param d: one D or several, N s/m
        :raises NoAnswer: nothing stabilises the loop there
        """
        words = ["--stable-interval", *_options.arguments({"continuous": continuous})]
        words += [f"--p={_options.list_text(p, 'p')}"] if p is not None else []
        words += [f"--d={_options.list_text(d, 'd')}"] if d is not None else []
        return self._run("boundary", words, how)

    def gain_regions(
        self, p: Interval = None, d: Interval = None, *, continuous: bool = False, **how: Unpack[How]
    ) -> Table:
        """The regions of a window of P and D with equally many unstable roots, the stable ones first: their
        areas, a point inside, their extents.

        :param p: (min, max) of P, N/m
        :param d: (min, max) of D, N s/m
        """
        words = ["--regions", *_interval("p", p), *_interval("d", d), *_options.arguments({"continuous": continuous})]
        return self._run("boundary", words, how)

    def response(
        self,
        p: Range = (-1000.0, 200.0, 61),
        d: Range = (-40.0, 20.0, 61),
        *,
        store: Optional[Path] = None,
        **how: Unpack[How],
    ) -> Union[Table, Store]:
        """Steady amplitude of the conductor over the gains, without play, in closed form. Columns ``stable``,
        ``amplitude_m`` and ``ratio_to_uncontrolled`` (below 1: control helps), of shape (P, D); NaN where
        the loop is not stable.

        :param p: P, N/m; (min, max, count)
        :param d: D, N s/m; (min, max, count)
        :param store: as of :meth:`chart`
        """
        return self._run("response", _axis("p", p) + _axis("d", d), {**how, "store": store})

    def design(
        self,
        frequency: Range = None,
        *,
        band: Interval = None,
        both_gains: bool = False,
        largest_radius: Optional[float] = None,
        margin: Optional[float] = None,
        largest_ratio: Optional[float] = None,
        schedule: Optional[str] = None,
        prove: bool = False,
        **how: Unpack[How],
    ) -> Table:
        """The best D: that of least steady amplitude and that of least spectral radius, at the case's P and
        frequency or at each frequency with P tuned to it, P = k2 - m2 (2 pi f)^2 (Eq. 6). One row a frequency.

        :param frequency: Hz; (min, max, count)
        :param band: (min, max), Hz: instead one D for all frequencies, of least largest amplitude
        :param both_gains: instead the P and D of least amplitude
        :param largest_radius: spectral radius to stay below
        :param margin: what of the way from the boundary of stability D must keep; 0.5 unless given
        :param largest_ratio: with ``family``: what may be left of the vibration without control
        :param schedule: with ``family``: an uncertain key whose range is divided into pieces with gains of their own
        :param prove: with ``family``: prove that every member is stable
        """
        words = _axis("frequency", frequency) + _interval("band", band)
        flags = {"both_gains": both_gains, "largest_radius": largest_radius, "margin": margin, "prove": prove}
        words += _options.arguments({**flags, "largest_ratio": largest_ratio, "schedule": schedule})
        return self._run("design", words, how)

    def margins(self, *, prove: bool = False, **how: Unpack[How]) -> Table:
        """How far the case's D, P, sampling period and delay are from instability, each moved alone, but the
        sampling period with the delay in proportion. Columns ``quantity, unit, value, side, outcome, position,
        distance, curve, frequency_Hz``.

        :param prove: also ``proved_stable_to``, up to which every value from the case's is proved stable,
            ``proved_unstable_at`` beyond, and ``proof``: proved, or why not or in part only
        """
        return self._run("margins", _options.arguments({"prove": prove}), how)

    def modal_damping(self, count: Optional[int] = None, *, no_control: bool = False, **how: Unpack[How]) -> Table:
        """How absorber, controller and devices damp each mode of the conductor. Columns ``mode, frequency_Hz,
        damping_ratio_bare, damping_ratio, damping_ratio_first_order`` and further laws. Needs ``plant.model =
        "string"`` or ``"cable"``.
        """
        return self._run("modal-damping", _options.arguments({"count": count, "no_control": no_control}), how)

    def sensitivity(self, **how: Unpack[How]) -> Table:
        """How stable gains, best gains and the largest sampling period move with each parameter of the plant."""
        return self._run("sensitivity", [], how)

    def max_delay(
        self,
        frequency: Range = None,
        *,
        criterion: Optional[Literal["stable", "attenuates"]] = None,
        prove: bool = False,
        **how: Unpack[How],
    ) -> Table:
        """Largest sampling period (s) at which some D stabilises the loop (``criterion="stable"``) or beats no
        control (``"attenuates"``), P tuned to each frequency. Columns ``frequency_Hz, proportional_gain,
        max_sampling_period_s, differential_gain``.

        :param frequency: Hz; (min, max, count)
        :param prove: with ``criterion="stable"`` also ``proved_from_s, proved_sampling_period_s``, between which every
            period is proved to have a D that stabilises
        """
        words = _axis("frequency", frequency) + _options.arguments({"criterion": criterion, "prove": prove})
        return self._run("max-delay", words, how)

    # -- motions ------------------------------------------------------------------------------------

    def simulate(
        self,
        duration: float = 10.0,
        *,
        from_: float = 0.0,
        kick: Optional[tuple[float, float]] = None,
        no_control: bool = False,
        switching: Switching = "sampled",
        plant: Optional[Literal["case", "elements"]] = None,
        elements: Optional[int] = None,
        controller: Any = None,
        excitation: Any = None,
        **how: Unpack[How],
    ) -> Table:
        """Time history of the loop with play from its initial state, at the samples t = 0, tau, 2 tau, …
        Columns ``time_s, z1_m, v1_m_per_s, z2_m, v2_m_per_s, control_force_N, in_backlash``; with
        ``switching="exact"`` also ``contact``.

        :param duration: s
        :param from_: first instant that is kept, s
        :param kick: (time, displacement) of the conductor, s and m
        :param no_control: without control force
        :param switching: ``"sampled"``, the paper's rule, or ``"exact"``: play is left and entered when it happens
        :param plant: ``"elements"``: the nonlinear cable with as many ``elements``
        :param controller: in place of P and D: a callable ``f(k, t, displacement, velocity) -> force``, called
            at each sample k at t (s) with the readings (m, m/s) and giving N; or, a hundred times faster, a
            compiled one of the signature ``double (int64_t k, double t, double displacement, double
            velocity)`` as a ``ctypes`` function, a ``numba.cfunc`` or a ``scipy.LowLevelCallable`` (whose
            user data come fifth, as ``void *``)
        :param excitation: in place of the case's force: a callable ``f(t) -> N``, taken at every sample and
            linear between them, or a pair of arrays (t, F) in s and N
        """
        words = _options.arguments(
            {
                "duration": duration,
                "from": from_,
                "no_control": no_control,
                "switching": switching,
                "plant": plant,
                "elements": elements,
            }
        )
        if kick is not None:
            words.append(f"--kick={_options.interval_text(kick, 'kick')}")
        return self._run("simulate", words, how, controller, excitation, float(duration))

    def spectrum(
        self,
        duration: float = 60.0,
        *,
        discard: Optional[float] = None,
        window: Optional[Literal["rectangular", "hann"]] = None,
        switching: Switching = "sampled",
        controller: Any = None,
        excitation: Any = None,
        **how: Unpack[How],
    ) -> Table:
        """Amplitude spectrum of z1 over a whole number of forcing periods. Columns ``frequency_Hz,
        amplitude_m``.

        :param duration: of the motion, s
        :param discard: left out at the start, s; None: half
        :param window: ``"rectangular"`` or ``"hann"``
        :param controller: as of :meth:`simulate`
        :param excitation: as of :meth:`simulate`
        """
        words = _options.arguments({"duration": duration, "discard": discard, "window": window, "switching": switching})
        return self._run("spectrum", words, how, controller, excitation, float(duration))

    def section(
        self,
        duration: float = 60.0,
        *,
        from_: float = 30.0,
        switching: Switching = "sampled",
        controller: Any = None,
        excitation: Any = None,
        **how: Unpack[How],
    ) -> Table:
        """Poincaré section: the instants at which z2 - z1 turns. Columns ``time_s, z1_m, v1_m_per_s, z2_m,
        rising, in_backlash``.

        :param duration: s
        :param from_: first instant that is kept, s
        :param controller: as of :meth:`simulate`
        :param excitation: as of :meth:`simulate`
        """
        words = _options.arguments({"duration": duration, "from": from_, "switching": switching})
        return self._run("section", words, how, controller, excitation, float(duration))

    def deviation(
        self,
        duration: Optional[float] = None,
        *,
        offset: Optional[float] = None,
        switching: Optional[Switching] = None,
        **how: Unpack[How],
    ) -> Table:
        """How far two motions part that start close to each other. Columns ``time_s, z1_deviation_m,
        state_deviation``.

        :param offset: of the neighbour's z1, m
        """
        return self._run(
            "deviation", _options.arguments({"offset": offset, "duration": duration, "switching": switching}), how
        )

    def coverage(
        self,
        durations: Any = None,
        *,
        window: Any = None,
        cells: Optional[int] = None,
        switching: Optional[Switching] = None,
        **how: Unpack[How],
    ) -> Table:
        """How much of a window of the phase plane the samples fill as time grows. Columns ``duration_s, cells,
        visited, fraction``.

        :param durations: s
        :param window: (z1 min, z1 max, v1 min, v1 max), m and m/s; None: all that the steady motion sweeps
        :param cells: along each side of the window
        """
        words = _options.arguments({"cells": cells, "switching": switching})
        words += [f"--durations={_options.list_text(durations, 'durations')}"] if durations is not None else []
        words += ["--window=" + _options.list_text(window, "window").replace(",", ":")] if window is not None else []
        return self._run("coverage", words, how)

    # -- attractors ---------------------------------------------------------------------------------

    def orbit(
        self,
        max_period: Optional[int] = None,
        *,
        switching: Optional[Switching] = None,
        trace: bool = False,
        certificate: bool = False,
        prove: bool = False,
        **how: Unpack[How],
    ) -> Table:
        """The exact periodic orbit that the motion comes to, with its certificate. Columns ``period_samples,
        period_s, forcing_periods, largest_multiplier`` (below 1: it attracts), ``closure_error``,
        ``border_distance_m``, ``engaged_fraction``; one row.

        :param max_period: longest that is looked for, samples
        :param trace: its samples over one period instead, as of :meth:`simulate`
        :param certificate: all of its certificate instead: multipliers, distances to the switching surfaces,
            radius of attraction, the same orbit in extended precision
        :param prove: the theorem on it instead, for the decimals of the case: bounds of its multipliers and of the
            errors of its states, the widths of the backlash in which it is the loop's, a ball that it attracts
        :raises NoAnswer: the motion comes to no orbit of such a period
        """
        return self._run(
            "orbit",
            _options.arguments(
                {
                    "max_period": max_period,
                    "switching": switching,
                    "trace": trace,
                    "certificate": certificate,
                    "prove": prove,
                }
            ),
            how,
        )

    def orbit_ends(
        self, key: str, interval: Interval, *, max_period: Optional[int] = None, prove: bool = False, **how: Unpack[How]
    ) -> Table:
        """Where the orbit ends along one key of the case, and why: fold, flip, torus, border collision; or, with
        ``prove``, in which ranges of it the loop is proved to have it, columns ``from, to, outcome, decided_by,
        surface, sample``.

        :param key: ``"excitation.frequency"``
        :param interval: (min, max) of it
        """
        words = [
            f"--follow={key}={_options.interval_text(interval, key)}",
            *_options.arguments({"max_period": max_period, "prove": prove}),
        ]
        return self._run("orbit", words, how)

    def orbit_borders(
        self,
        keys: Mapping[str, Interval],
        *,
        max_period: Optional[int] = None,
        switching: Optional[Switching] = None,
        **how: Unpack[How],
    ) -> Table:
        """The border of the region of two keys in which the orbit is and attracts, in pieces, each named by what
        ends it. Columns ``piece, border, surface, sample``, the two keys, ``largest_multiplier,
        multiplier_angle_rad, meeting``.

        :param keys: two, each with its (min, max): ``{"backlash.width": (0.0003, 0.001), …}``; along
            ``control.sampling_period`` or ``excitation.frequency`` the other goes with it
        :param switching: ``"sampled"`` or ``"exact"``
        """
        words = [f"--map={key}={_options.interval_text(ends, key)}" for key, ends in keys.items()]
        words += _options.arguments({"max_period": max_period, "switching": switching})
        return self._run("orbit", words, how)

    def lyapunov(
        self,
        duration: Optional[float] = None,
        *,
        discard: Optional[float] = None,
        tangent: Optional[Literal["consistent", "printed"]] = None,
        largest: bool = False,
        history: bool = False,
        switching: Optional[Switching] = None,
        **how: Unpack[How],
    ) -> Table:
        """The Lyapunov exponents of the motion. Columns ``exponent, per_sample, per_second, standard_error``;
        with ``history`` ``time_s, lambda1, …``.

        :param duration: s
        :param discard: left out at the start, s
        :param tangent: ``"consistent"`` or ``"printed"`` (as the paper's Table 2)
        :param largest: the largest one alone
        """
        return self._run(
            "lyapunov",
            _options.arguments(
                {
                    "duration": duration,
                    "discard": discard,
                    "tangent": tangent,
                    "largest": largest,
                    "history": history,
                    "switching": switching,
                }
            ),
            how,
        )

    def verdict(
        self, max_period: Optional[int] = None, *, switching: Optional[Switching] = None, **how: Unpack[How]
    ) -> Table:
        """What the motion is: periodic, quasi-periodic, chaotic, …, and what that rests on; one row."""
        return self._run("verdict", _options.arguments({"max_period": max_period, "switching": switching}), how)

    def basins(
        self,
        axes: Mapping[str, Range],
        *,
        fractions: bool = False,
        duration: Optional[float] = None,
        max_period: Optional[int] = None,
        switching: Optional[Switching] = None,
        store: Optional[Path] = None,
        **how: Unpack[How],
    ) -> Union[Table, Store]:
        """Which attractor each initial state of a grid comes to. Columns ``attractor, period_s`` over the two
        axes.

        :param axes: two of ``initial.z1``, ``initial.v1``, ``initial.z2``, ``initial.v2`` with (min, max, count)
        :param fractions: instead a row for each attractor: its share of the states, with its error
        :param store: as of :meth:`chart`
        """
        words = _options.axes_texts(axes, 2) + _options.arguments(
            {"fractions": fractions, "duration": duration, "max_period": max_period, "switching": switching}
        )
        return self._run("basins", words, {**how, "store": store})

    def motions(
        self,
        keys: Mapping[str, Range],
        *,
        starts: Optional[Mapping[str, Range]] = None,
        max_period: Optional[int] = None,
        switching: Optional[Switching] = None,
        store: Optional[Path] = None,
        **how: Unpack[How],
    ) -> Union[Table, Store]:
        """The periodic motions in the cells of a plane of two keys: what the case's initial state comes to, and how
        many coexist. Columns ``outcome, forcing_periods, period_s, amplitude_m, border_share, motions, …`` over the
        two keys.

        :param keys: two, each with (min, max, count)
        :param starts: further initial states of each cell, as the axes of :meth:`basins`
        """
        words = _options.axes_texts(keys, 2, "--map")
        words += _options.axes_texts(starts, 2) if starts else []
        words += _options.arguments({"max_period": max_period, "switching": switching})
        return self._run("basins", words, {**how, "store": store})

    def diagram(
        self,
        key: str,
        values: Range,
        *,
        transient: Optional[float] = None,
        strobes: Optional[int] = None,
        switching: Optional[Switching] = None,
        **how: Unpack[How],
    ) -> Table:
        """Orbit diagram: one state a forcing period against a key of the case, up and back.

        :param key: ``"backlash.width"``
        :param values: (min, max, count)
        :param transient: left out at each value, s
        :param strobes: forcing periods shown at each value
        """
        words = ["--axis", _options.key_axis_text(key, _options.axis_of(values, key))]
        words += _options.arguments({"transient": transient, "strobes": strobes, "switching": switching})
        return self._run("diagram", words, how)

    def sweep(
        self,
        axes: Mapping[str, Any],
        metrics: Sequence[str] = (),
        *,
        duration: Optional[float] = None,
        best_gain: bool = False,
        max_period: Optional[int] = None,
        switching: Optional[Switching] = None,
        store: Optional[Path] = None,
        client: Any = None,
        resume: bool = False,
        part: Optional[tuple[int, int]] = None,
        chunk: Optional[int] = None,
        **how: Unpack[How],
    ) -> Union[Table, Store]:
        """Metrics of the motion over any number of axes, on all cores. A column for each metric, with a
        dimension for each axis.

        :param axes: keys of the case with (min, max, count), ("log", min, max, count) or a list of values, the
            first slowest
        :param metrics: ``"steady_peak"``, ``"attenuates"``, ``"largest_exponent"``, ``"verdict"``, …; none:
            the four usual ones
        :param duration: s; its second half counts as steady
        :param best_gain: D of every cell is that of least steady amplitude
        :param store: as of :meth:`chart`
        :param client: who fills the store, in place of the threads of this process: a
            ``dask.distributed.Client``, whose workers see the store's folder, or a number of processes
            of this machine. A worker that is lost loses the chunk at hand; another one does the rest
            of its part. ``threads`` is then of each process
        :param resume: what the store has already is read, and what is damaged computed anew
        :param part: (K, N), of the store every N-th chunk from number K on alone, for whoever hands
            the work out by other means
        :param chunk: most cells of a chunk; None: chosen
        """
        if isinstance(metrics, str):
            metrics = (metrics,)
        words = _options.axes_texts(axes)
        words += [word for metric in metrics for word in ("--metric", metric)]
        words += _options.arguments(
            {
                "duration": duration,
                "best_gain": best_gain,
                "max_period": max_period,
                "switching": switching,
                "chunk": chunk,
            }
        )
        if client is not None:
            from ._parts import fill_by

            if store is None or part is not None:
                raise ValueError("client: it fills a store by parts; give store, and not part")
            return fill_by(client, self, words, {**how, "output": store_name(store)}, resume)
        words += _options.arguments({"resume": resume})
        words += [] if part is None else [f"--part={_options.part_text(part)}"]
        return self._run("sweep", words, {**how, "store": store})

    # -- span and wind ------------------------------------------------------------------------------

    def absorption(
        self,
        frequency: Range = None,
        *,
        end: Optional[Literal["left", "right"]] = None,
        no_control: bool = False,
        **how: Unpack[How],
    ) -> Table:
        """What the devices at an end of the span do to the waves that come to it. Columns ``frequency_Hz``,
        real and imaginary part of the impedance (N s/m), ``reflection, absorbed_fraction,
        inverse_standing_wave_ratio``.

        :param frequency: Hz; (min, max, count)
        :param end: ``"left"`` or ``"right"``; None: the one that has devices
        """
        return self._run(
            "absorption",
            _axis("frequency", frequency) + _options.arguments({"end": end, "no_control": no_control}),
            how,
        )

    def aeolian(self, frequency: Range = None, *, no_control: bool = False, **how: Unpack[How]) -> Table:
        """How much the conductor vibrates in the wind at each frequency, by each law of the wind and of its own
        damping: amplitudes (m) and strains with and without devices.

        :param frequency: Hz; (min, max, count)
        """
        return self._run("aeolian", _axis("frequency", frequency) + _options.arguments({"no_control": no_control}), how)

    def fatigue(
        self, frequency: Interval = None, *, no_control: bool = False, by_speed: bool = False,
        by_temperature: bool = False, **how: Unpack[How]
    ) -> Table:  # fmt: skip
        """How long the conductor lives at its clamps in the wind of [site]. Columns ``quantity, value, lowest,
        highest, unit``.

        :param frequency: (min, max) of vibrations that count, Hz
        :param by_speed: instead the hours and the damage of each wind speed
        :param by_temperature: instead tension and damage at each of weather.temperatures
        """
        return self._run(
            "fatigue",
            _interval("frequency", frequency)
            + _options.arguments({"no_control": no_control, "by_speed": by_speed, "by_temperature": by_temperature}),
            how,
        )

    def place(
        self,
        device: Optional[Union[int, str]] = None,
        *,
        frequency: Range = None,
        for_: Optional[Literal["strain", "damping"]] = None,
        modes: Optional[tuple[int, int]] = None,
        keep: Optional[Literal["position"]] = None,
        margin: Optional[float] = None,
        **how: Unpack[How],
    ) -> Table:
        """The best position, strength or gains of one device. Columns ``quantity, value, unit``.

        :param device: number of a [[device]], or ``"absorber"``
        :param frequency: Hz; (min, max, count)
        :param for_: ``"strain"`` or ``"damping"``
        :param modes: (first, last) instead
        :param keep: ``"position"``
        :param margin: modulus margin that the absorber's loop keeps
        """
        words = _axis("frequency", frequency) + _options.arguments(
            {"device": device, "for": for_, "keep": keep, "margin": margin}
        )
        words += [f"--modes={_options.interval_text(modes, 'modes')}"] if modes is not None else []
        return self._run("place", words, how)

    # -- all of it ----------------------------------------------------------------------------------

    def answers(self, *, details: bool = False, **how: Unpack[How]) -> Table:
        """Does control help, which D, how slow a computer, how much play, what motion: in words. Columns
        ``question, answer``.
        """
        return self._run("answers", _options.arguments({"details": details}), how)

    def report(self, folder: Path, *, for_: Optional[Literal["control", "span"]] = None, **how: Unpack[How]) -> None:
        """A folder with every table and picture of the case, and one ``report.html`` that shows them.

        :param for_: who reads it: ``"control"`` or ``"span"``
        """
        self._run("report", _options.arguments({"for": for_}), {**how, "output": folder})

    def explore(self, file: Path, **how: Unpack[How]) -> None:
        """One page to be opened in a browser: move gains, delays and play, and see what follows."""
        self._run("explore", [], {**how, "output": file})

    # -- other systems -----------------------------------------------------------------------------
    def to_control(self, *, closed: bool = False) -> Any:
        """The sampled loop as a discrete ``control.StateSpace`` of python-control: the plant under a
        zero-order hold of the case's sampling period, with the commands on their way as states.

        :param closed: the loop closed with the case's P and D, from the force F on the conductor (held
            too) to its displacement and velocity; else the plant from the command u (N) to what the
            computer reads of them
        """
        from ._loops import control_of

        return control_of(self._core.plant_matrices(), closed)

    def plant_matrices(self) -> dict[str, Any]:
        """The linear plant x' = A x + b u + c F of the case, with filter and drive: ``state_matrix`` A
        (N, N), ``command_input`` b and ``excitation_input`` c (N), and the rows (N) of what is read:
        ``displacement``, ``velocity``, ``measured_displacement``, ``measured_velocity``,
        ``relative_displacement``, ``relative_velocity``; gains, sampling period and delay."""
        return dict(self._core.plant_matrices())


def _restored(text: Optional[str], name: str, overrides: list[str], plant: Optional[Plant] = None) -> Case:
    own = None if plant is None else plant._core
    return Case._of(_core.Case(text, name, overrides, own), plant)


def _made(text: Optional[str], name: str, tables: Mapping[str, Any], plant: Optional[Plant] = None) -> Any:
    _require_tables(tables)
    with speaking_python():
        return _core.Case(text, name, _toml.overrides(tables), None if plant is None else plant._core)


#: Of a case, beside those that the built-in one has.
_FURTHER_TABLES = ("device", "site", "stringing", "uncertain", "weather", "wind")


def _require_tables(*given: Mapping[str, Any]) -> None:
    """Throws ValueError for a table that no case has."""
    names = {name.partition(".")[0] for tables in given for name in tables if isinstance(name, str)}
    known = {*json.loads(_core.Case(None, "case", []).json()), *_FURTHER_TABLES} if names else set()
    for name in sorted(names - known):
        raise ValueError(f"{name}: a case has no such table{suggestion(name, known)}")


def _refuse_unknown(how: Mapping[str, Any]) -> None:
    """Throws TypeError for keywords that the method of a case that was called does not have."""
    if not how:
        return
    frame, called = sys._getframe(1), ""
    while frame is not None and not called:
        name = frame.f_code.co_name
        called = name if not name.startswith("_") and name in vars(Case) else ""
        method, frame = frame.f_code, frame.f_back
    if "controller" in how:
        raise TypeError(
            f"{called} takes no controller, simulate, spectrum and section do: it begins the loop again and again from "
            "other states, and what a function of yours remembers cannot be set"
        )
    names = {*method.co_varnames[1 : method.co_argcount + method.co_kwonlyargcount], *How.__annotations__, "output"}
    name = next(iter(how))
    raise TypeError(f"{called} has no option {', '.join(how)}{suggestion(name, names)}")


def _chart_options(over: tuple[Any, Any], radius: bool) -> list[tuple[str, str]]:
    options = [("--p", _options.axis_text(over[0], "p")), ("--d", _options.axis_text(over[1], "d"))]
    return options + ([("--radius", "true")] if radius else [])


def _axis(name: str, value: Range) -> list[str]:
    return [] if value is None else [f"--{name}={_options.axis_text(value, name)}"]


def _interval(name: str, value: Interval) -> list[str]:
    return [] if value is None else [f"--{name}={_options.interval_text(value, name)}"]


def _file_text(name: str) -> str:
    try:
        with open(name, encoding="utf-8") as file:
            return file.read()
    except UnicodeDecodeError:
        raise ValueError(f"{name}: a case file is a text in UTF-8") from None


def _with_devices(text: Optional[str], name: str, tables: Mapping[str, Any]) -> tuple[Optional[str], str]:
    devices = _toml.devices_text(tables)
    return (text if not devices else (text or "") + "\n" + devices), name


def conductors(find: Optional[str] = None) -> Table:
    """The library of conductors, for ``conductor.name`` of a case.

    :param find: only those that have every word of this in name, kind or source
    """
    return Case()._run("conductors", _options.arguments({"find": find}), {})

"""Suspended cables under digital vibration control: conductor data in; control gains, stability charts,
delay and backlash limits, motions and their certificates out.

>>> import holdfast
>>> case = holdfast.Case(control={"sampling_period": 0.002})
>>> case.stable_intervals(p=-557)
>>> case.chart(p=(-1000, 200, 121), d=(-40, 20, 121), radius=True).plot()
"""

from __future__ import annotations

from . import paper
from ._case import Case, PlausibilityWarning, conductors
from ._core import NoAnswer
from ._core import version as __version__
from ._frequency import FrequencyData, frequency_response
from ._plant import Plant, plant
from ._store import Store, convert, open_store
from ._table import Table

__all__ = [
    "Case",
    "FrequencyData",
    "NoAnswer",
    "Plant",
    "PlausibilityWarning",
    "Store",
    "Table",
    "__version__",
    "conductors",
    "convert",
    "frequency_response",
    "open_store",
    "paper",
    "plant",
]

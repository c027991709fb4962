"""Sweeps: named measures of a model over a grid of parameters and times, as a labelled dataset."""

from reactive4d.sweeping.designs import Design, latin_hypercube, random, zipped
from reactive4d.sweeping.pictures import Picture
from reactive4d.sweeping.reports import Report
from reactive4d.sweeping.sheets import contact_sheet
from reactive4d.sweeping.sweeps import SweepWarning, sweep

__all__ = [
    "Design",
    "Picture",
    "Report",
    "SweepWarning",
    "contact_sheet",
    "latin_hypercube",
    "random",
    "sweep",
    "zipped",
]

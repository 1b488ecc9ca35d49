"""Stick and slip over position and time for three phases at Table 1's other parameters.

Run from the project's folder: python studies/maps/slip_map.py
"""

import numpy as np
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.maps import draw_slip_map
from swtstudy.figures.save import save_figure

figure = Figure(figsize=(13.0, 3.8), layout="constrained")
for axes, phase in zip(figure.subplots(1, 3, sharey=True), (0.0, 0.5, 2.0), strict=True):
    states = swtstudy.slip_map(
        np.linspace(0.0, 1.4, 281), time=np.linspace(0.0, 2.0 * np.pi, 361), phase=phase
    )
    handles = draw_slip_map(axes, states)
    axes.label_outer()
    axes.set_title(rf"$\psi$ = {phase:g}", loc="left", fontsize="medium")
figure.legend(handles=handles, loc="outside right upper", frameon=False)
save_figure(figure, "results/slip_map.png")

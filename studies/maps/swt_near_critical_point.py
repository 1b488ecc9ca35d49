"""swt(x, z) and swt(x, y) around the critical point of Table 1's parameters, the dot.

Run from the project's folder: python studies/maps/swt_near_critical_point.py
"""

import numpy as np
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.maps import draw_swt_map
from swtstudy.figures.save import save_figure

point = swtstudy.solve()
x = float(point.critical_x)
near = x + np.linspace(-0.3, 0.3, 121)
depth = 0.03 * np.linspace(0.0, 1.0, 41) ** 2
section = swtstudy.swt_field(x=near, y=0.0, z=depth)
surface = swtstudy.swt_field(x=near, y=np.linspace(-0.5, 0.5, 61), z=0.0)

figure = Figure(figsize=(9.0, 3.6), layout="constrained")
both = figure.subplots(1, 2)
for axes, dataset in zip(both, (section, surface), strict=True):
    mesh = draw_swt_map(axes, dataset, highest=float(point.s))
    dot = {"marker": "o", "markerfacecolor": "white", "markeredgecolor": "black", "clip_on": False}
    axes.plot(x, 0.0, **dot)
figure.colorbar(mesh, ax=both, label=r"swt over $E^* \delta_0/R$")
save_figure(figure, "results/swt_near_critical_point.png")

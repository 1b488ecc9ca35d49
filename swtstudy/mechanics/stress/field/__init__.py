"""The stress field beneath the contact: rigid flat punches superposed over all radii (eqs. 13–18).

punch           – the field of one punch, closed form
primitives      – its integrals over the punch radius, closed form
slope_cells     – the spring slopes as straight pieces on cells
superposition   – the stress history at points of the body
contact_states  – the memory diagram of a cycle as input of the superposition
"""

from swtstudy.mechanics.stress.field.contact_states import ContactStates, contact_states
from swtstudy.mechanics.stress.field.slope_cells import SlopeCells, graded_radii, slope_cells
from swtstudy.mechanics.stress.field.superposition import cell_stress, stress_history

__all__ = [
    "ContactStates",
    "SlopeCells",
    "cell_stress",
    "contact_states",
    "graded_radii",
    "slope_cells",
    "stress_history",
]

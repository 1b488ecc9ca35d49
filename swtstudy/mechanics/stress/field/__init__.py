"""The stress field beneath the contact: flat punches or strips superposed over all radii (eqs. 13–18).

punch           – the field of one punch, closed form
primitives      – its integrals over the punch radius, closed form
strip           – the field of one strip of a plane contact, and its integrals over the half-width
kernels         – which of the two is superposed
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

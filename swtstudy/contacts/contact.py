"""A real contact that can be solved and shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.parameters import PARAMETERS
from swtstudy.units.bodies import LABELS, SWT_ATTRIBUTES
from swtstudy.units.contact import Contact

if TYPE_CHECKING:
    import xarray as xr


class PhysicalContact(Contact):
    __doc__ = Contact.__doc__

    def _repr_html_(self) -> str:
        """A table for a notebook: what is given, the contact at rest, and the parameters without units."""
        from swtstudy.contacts.overview import as_html

        return as_html(self)

    def solve(self, rtol: float = 1e-4) -> xr.Dataset:
        """s and SWT of both bodies.

        Returns
        -------
        xarray.Dataset
            What `swtstudy.solve` gives, over the dimension body (1, 2), and SWT with its SWT_error in the
            unit of stress of the moduli and critical_position in that of the lengths.
        """
        import xarray as xr

        from swtstudy.solving import solve

        bodies = [solve(rtol=rtol, **self.parameters(body)) for body in (0, 1)]
        bodies = [_completed(bodies[0], bodies[1]), _completed(bodies[1], bodies[0])]
        dataset = xr.concat(
            bodies, xr.DataArray(list(LABELS), dims="body", name="body"), coords="different", compat="equals"
        )
        swt, swt_error = self.swt(dataset.s), self.swt(dataset.s_error)
        own = {
            "SWT": (swt, SWT_ATTRIBUTES | {"ancillary_variables": "SWT_error regime"}),
            "SWT_error": (
                swt_error,
                SWT_ATTRIBUTES
                | {"long_name": "estimated absolute error of SWT", "symbol": r"\Delta \mathrm{SWT}"},
            ),
            "critical_position": (
                dataset.critical_x * self.length_scale,
                {"long_name": "position of the critical point", "units": "unit of length", "symbol": "x"},
            ),
        }
        for name, (values, attributes) in own.items():
            values.attrs = attributes  # not those of what they come from
            dataset[name] = values
        return dataset


def _completed(own: xr.Dataset, other: xr.Dataset) -> xr.Dataset:
    """Single values with those that only the other body has: parameters at their default, or none."""
    for name in sorted({*map(str, other.variables)} - {*map(str, own.variables)}):
        fill = PARAMETERS[name].default if name in PARAMETERS else np.nan
        values = other[name].variable.copy(data=np.asarray(fill))
        own = own.assign_coords({name: values}) if name in other.coords else own.assign({name: values})
    return own

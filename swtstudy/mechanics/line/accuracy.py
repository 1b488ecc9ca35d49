"""The resolution that a relative tolerance asks of the search along x."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.line.look import Resolution

#: Digits that a zoom gains at least. 4.0, which saves a zoom at rtol 1e-5: 4e-8, no faster.
DIGITS_PER_ZOOM = 3.2
#: Error left to the search over x, as a share of the tolerance. All of it: 9e-7 at rtol 1e-5, no faster.
SETTLED = 0.3
#: Digits more for points that miss the tolerance: pressure alone may make stresses far above all tension.
MORE_DIGITS = 2.0


@dataclass(frozen=True)
class Accuracy:
    """The resolution that a relative tolerance asks of the climb to a maximum.

    Attributes
    ----------
    search
        Resolution of the climb over x.
    check
        A finer one for the value itself; the difference of the two is the error in time and angle.
    tolerance
        Relative accuracy asked for.
    hasty
        Whether one round may be enough where swt is smooth.
    """

    search: Resolution
    check: Resolution
    tolerance: float
    hasty: bool = True

    @classmethod
    def for_tolerance(cls, rtol: float) -> Accuracy:
        """The least effort that keeps the error below ``rtol``."""
        digits = -np.log10(rtol)
        # Four digits by the first zoom, and so many more by each further one.
        zooms = max(int(np.ceil((digits - 1.0) / DIGITS_PER_ZOOM)), 1)
        return cls(Resolution(4, zooms, digits + 1.0), Resolution(5, zooms + 1, digits + 2.5), rtol)

    def finer(self) -> Accuracy:
        """The same with twice the instants, closer looks at the extremes, more digits and more rounds."""
        search, check = (
            replace(r, nodes=2 * r.nodes, zooms=r.zooms + 1, digits=r.digits + MORE_DIGITS)
            for r in (self.search, self.check)
        )
        return replace(self, search=search, check=check, hasty=False)

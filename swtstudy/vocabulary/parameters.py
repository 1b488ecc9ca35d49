"""The table of the study's non-dimensional parameters (eq. 20, Table 1), which are prescribed, and axes.

Validation, coordinate attributes, axis labels, the command line's help and the documentation all read it;
none of them repeats a name, a symbol, a default or a range. In each direction a displacement or a force is
prescribed: the names of the parameters say which. An axis, everything that a dimension of results may be, is
a parameter, or what only some results range over.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import inf

from swtstudy.vocabulary.choices import CRITERIA, FAMILIES, MOVED, SHIFTS, SWT
from swtstudy.vocabulary.parameter import Parameter, spelled

#: The load of the paper.
HARMONIC = "harmonic"
#: Amplitudes of a loop that are not given: its vertices are the loads themselves.
LOOP_AMPLITUDE = 1.0

#: The parameters that say whether a bulk stress moves the stick zone, and by how much its body strains.
SHIFT, STRAIN_SHARE = "stick_zone_shift", "bulk_strain_share"

#: Largest numerator and denominator of a frequency ratio: the common period grows with them.
LARGEST_FREQUENCY_TERM = 64

PARAMETERS: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter("poisson_ratio", r"\nu", "ν", "Poisson ratio", 0.3, 0.0, 0.5, part="body"),
        Parameter("friction", r"\mu", "μ", "coefficient of friction", 0.3, 0.0, 10.0, part="body"),
        Parameter(
            "normal_amplitude",
            r"\delta_A/\delta_0",
            "δA",
            "amplitude of the normal oscillation",
            0.75,
            upper=10.0,
            scale="δ0",
        ),
        Parameter(
            "normal_force_amplitude",
            r"F_A/F_0",
            "FA",
            "amplitude of the normal force",
            upper=10.0,
            scale="F0",
            instead_of="normal_amplitude",
        ),
        Parameter(
            "frequency_ratio",
            r"\omega_2/\omega_1",
            "ω2",
            "frequency of the tangential over that of the normal oscillation",
            1.0,
            upper=LARGEST_FREQUENCY_TERM,
            open_lower=True,
            kind="ratio",
        ),
        Parameter(
            "tangential_amplitude",
            r"G^* u_A/(\mu E^* \delta_0)",
            "uA",
            "amplitude of the tangential oscillation",
            5 / 6,
            upper=100.0,
            scale="μ E* δ0/G*",
            note="along an axis of friction it stays, so that uA itself moves with μ",
        ),
        Parameter(
            "tangential_force_amplitude",
            r"Q_A/(\mu F_0)",
            "QA",
            "amplitude of the tangential force",
            upper=100.0,
            scale="μ F0",
            instead_of="tangential_amplitude",
            note="along an axis of friction it stays, so that QA itself moves with μ",
        ),
        Parameter(
            "phase", r"\psi", "ψ", "phase of the normal oscillation", 0.0, -1000.0, 1000.0, units="rad"
        ),
        Parameter(
            "load",
            r"\mathrm{load}",
            "load",
            "course of the load: two harmonic oscillations, or the name of a loop",
            HARMONIC,
            names=(HARMONIC,),
            optional=True,
        ),
        Parameter(
            "profile", "f", "f", "profile of the indenter", "paraboloid", names=tuple(FAMILIES), part="shape"
        ),
        Parameter(
            "flat_radius", r"b/a_H", "b", "radius of the punch face", upper=100.0, part="shape", scale="a_H"
        ),
        Parameter(
            "flat_half_width",
            r"b/a_H",
            "b",
            "half-width of the flat face",
            upper=100.0,
            part="shape",
            scale="a_H",
        ),
        Parameter(
            "waviness_amplitude",
            r"h/\delta_0",
            "h",
            "amplitude of the waviness",
            upper=10.0,
            part="shape",
            scale="δ0",
        ),
        Parameter(
            "wavelength",
            r"\lambda/\sqrt{hR}",
            "λ",
            "wavelength of the waviness",
            upper=1000.0,
            open_lower=True,
            part="shape",
            scale="√(hR)",
        ),
        Parameter(
            "exponent", "n", "n", "exponent of the power law", None, 1.0, 20.0, open_lower=True, part="shape"
        ),
        Parameter(
            "bulk_stress_amplitude",
            r"\sigma_{B,A}/(E^* \delta_0/a_H)",
            "BA",
            "amplitude of the bulk stress, with the tangential frequency",
            0.0,
            upper=10.0,
            part="bulk",
            optional=True,
            scale="E* δ0/a_H",
        ),
        Parameter(
            "bulk_stress_mean",
            r"\sigma_{B,m}/(E^* \delta_0/a_H)",
            "Bm",
            "mean of the bulk stress",
            0.0,
            -10.0,
            10.0,
            part="bulk",
            optional=True,
            scale="E* δ0/a_H",
        ),
        Parameter(
            "bulk_stress_phase",
            r"\psi_B",
            "ψB",
            "phase of the bulk stress against the tangential oscillation",
            0.0,
            -1000.0,
            1000.0,
            part="bulk",
            optional=True,
            units="rad",
        ),
        Parameter(
            STRAIN_SHARE,
            r"2\epsilon_1/(\epsilon_1+\epsilon_2)",
            "κB",
            "strain of the body with the bulk stress over the mean of both bodies, under equal tractions",
            1.0,
            lower=-2.0,
            upper=2.0,
            part="bulk",
            optional=True,
            note="real contacts have it from their moduli; negative in the other body, which the bulk stress "
            "reaches by the stick zone alone",
        ),
        Parameter(
            SHIFT,
            r"\mathrm{shift}",
            "shift",
            "whether the bulk stress moves the stick zone where that is known, or not",
            MOVED,
            names=SHIFTS,
            part="bulk",
            optional=True,
        ),
        Parameter(
            "criterion",
            r"\mathrm{criterion}",
            "criterion",
            "criterion of which s is the largest value",
            SWT,
            names=tuple(CRITERIA),
            part="criterion",
            optional=True,
        ),
        Parameter(
            "walker_exponent",
            r"\gamma",
            "γ",
            "Walker exponent",
            0.5,
            upper=0.9,
            open_lower=True,
            part="criterion",
            optional=True,
        ),
        Parameter(
            "normal_sensitivity",
            r"k",
            "k",
            "sensitivity of a criterion of shear to the normal stress",
            0.0,
            upper=100.0,
            part="criterion",
            optional=True,
            note="of fatemi_socie in a_H/(E* δ0), k E* δ0/(a_H σ_y); of findley a number",
        ),
    )
}

#: Names by letter; if names share a letter, the first of them.
LETTERS: dict[str, str] = {parameter.letter: name for name, parameter in reversed(PARAMETERS.items())}


#: Parameters of which one of two is given, by the one that takes the other's place.
PAIRS: dict[str, str] = {
    name: parameter.instead_of for name, parameter in PARAMETERS.items() if parameter.instead_of
}
#: The one of two that is a force, by the one whose place it takes.
FORCE_OF = {other: force for force, other in PAIRS.items()}
#: The two of the normal load.
NORMAL_AMPLITUDES = frozenset({"normal_amplitude", "normal_force_amplitude"})


def replaced_by(names: Iterable[str]) -> set[str]:
    """The parameters whose places are taken by some of these."""
    return {PAIRS[name] for name in names if name in PAIRS}


@dataclass(frozen=True)
class Control:
    """The quantities prescribed in the two directions, each a displacement or a force.

    A normal force is in units of that at the depth δ0, a tangential one in μ times that.

    Attributes
    ----------
    normal_force, tangential_force
        Whether it is a force.
    """

    normal_force: bool = False
    tangential_force: bool = False

    @classmethod
    def given(cls, names: Iterable[str]) -> Control:
        """From the names of the parameters that are given."""
        found = set(names)
        return cls("normal_force_amplitude" in found, "tangential_force_amplitude" in found)

    @property
    def mixed(self) -> bool:
        """True if one direction has a force and the other a displacement."""
        return self.normal_force != self.tangential_force

    @property
    def name(self) -> str:
        """Value of the coordinate ``control``."""
        return CONTROLS[self]

    def given_for(self, name: str) -> str:
        """The force that is given instead of a displacement; the displacement itself where no force is."""
        forces = {"normal_amplitude": self.normal_force, "tangential_amplitude": self.tangential_force}
        return FORCE_OF[name] if forces.get(name) else name


#: The control of the paper: both displacements are prescribed.
DISPLACEMENTS = Control()

#: The names of what is prescribed.
CONTROLS: dict[Control, str] = {
    DISPLACEMENTS: "displacements",
    Control(True, True): "forces",
    Control(True, False): "normal_force+tangential_displacement",
    Control(False, True): "normal_displacement+tangential_force",
}


#: Into the body from the critical point: straight down, or along the critical plane.
DIRECTIONS = ("depth", "critical_plane")

#: Dimensions of quantities beside s that the points do not have.
QUANTITY_AXES: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter(
            "critical_distance",
            r"\ell/a_H",
            "ℓ",
            "critical distance of the nonlocal values",
            upper=10.0,
            open_lower=True,
            part="quantity",
            scale="a_H",
        ),
        Parameter(
            "direction", "", "", "direction from the critical point", names=DIRECTIONS, part="quantity"
        ),
    )
}

#: Parameters of real contacts alone. The study names their units: see `swtstudy.units.rows`.
CONTACT_AXES: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter(name, symbol, letter, meaning, upper=inf, open_lower=True, part="contact")
        for name, symbol, letter, meaning in (
            ("young_modulus", "E", "E", "Young modulus"),
            ("radius", "R", "R", "radius of the relative curvature, 1/R = 1/R1 + 1/R2"),
            ("depth", r"\delta_0", "δ0", "mean indentation depth"),
            ("normal_force", "F_0", "F0", "normal force at the mean depth"),
            ("contact_length", "L", "L", "length of a plane contact, across its section"),
            ("bulk_stress_ratio", r"R_\sigma", "Rσ", "minimum divided by maximum bulk stress"),
            ("body", r"\mathrm{body}", "body", "body, 1 or 2"),
        )
    )
}

AXES: Mapping[str, Parameter] = ChainMap(PARAMETERS, QUANTITY_AXES, CONTACT_AXES)

#: Name and letter of a parameter by what may be typed for it: its letter, its symbol, the numerator of that.
SYMBOLS: dict[str, tuple[str, str]] = {
    spelled(symbol): (row.name, row.letter)
    for row in (*CONTACT_AXES.values(), *reversed(PARAMETERS.values()))
    for symbol in (row.letter, row.symbol, row.symbol.split("/")[0])
}

"""A sphere of aluminium 2024-T351 on a flat of the same, in N, mm and MPa: the worst and the best phase.

Run from the project's folder: python studies/physical.py > results/physical.txt

Elastic and strain–life constants: N. E. Dowling, Mechanical Behavior of Materials, 4th ed., Pearson 2013,
Table 14.1 (2024-T351: E = 73.1 GPa, σf′ = 927 MPa, b = −0.113, εf′ = 0.409, c = −0.713); ν = 0.33.
The radius of 50 µm over which swt is averaged is not a constant of the material: it shows how much averaging
matters.
"""

import numpy as np

import swtstudy
from swtstudy.faces.contacts import PhysicalContact

MATERIAL = swtstudy.FatigueConstants(
    young_modulus=73.1e3, strength=927.0, strength_exponent=-0.113, ductility=0.409, ductility_exponent=-0.713
)


def sphere_on_flat(phase: float) -> PhysicalContact:
    """R = 50 mm pressed with 200 N; the depth oscillates by ±4 µm about 6.4 µm, the sphere slides ±2.5 µm."""
    return swtstudy.physical(
        young_modulus=73.1e3,
        poisson_ratio=0.33,
        radius=50.0,
        normal_force=200.0,
        friction=0.5,
        normal_amplitude=4e-3,
        tangential_amplitude=2.5e-3,
        phase=phase,
    )


def main() -> None:
    contact = sphere_on_flat(0.0)
    print(f"a = {contact.contact_radius:.3f} mm, δ0 = {1e3 * contact.depth:.2f} µm")
    print(f"p0 = {contact.peak_pressure:.0f} MPa, E* = {contact.moduli.normal / 1e3:.1f} GPa")
    for name, value in contact.parameters().items():
        print(f"  {name} = {value if isinstance(value, str) else f'{float(value):.4g}'}")
    print("phase  SWT/MPa  cycles to a crack, at the worst point  and averaged over a radius of 50 µm")
    for degrees in (0, 60, 105, 150):
        contact = sphere_on_flat(np.radians(degrees))
        s = swtstudy.solve(critical_distance=0.05 / contact.length_scale, **contact.parameters())
        local, mean = (contact.cycles(MATERIAL, values) for values in (s.s, s.s_volume))
        print(f"{degrees:4}°  {float(contact.swt(s.s)):8.3f}  {float(local):9.1e}  {float(mean):9.1e}")


if __name__ == "__main__":
    main()

"""One parameter point, from its load to s, as compiled loops in the order of the paper's section 3.

`load` and `profile` hold what is given, as data. `contact` solves one load cycle in the memory diagram,
`growth` lays the diagram on the radius of the profile, `surface` and `history` give the stress cycle at a
position of the surface line, `planes` the critical plane there, `line` the largest value along the line.
`point` puts the steps together. What the steps write are records of fixed size, bundled in `records`.
"""

#: No tabulated position is nearer to the centre, or to the edge of a face, as a share of the contact.
INNERMOST = 1e-5
#: A place this near to the singular edge of a face, as a share of it, is at the edge.
NEAREST = 1e-9

"""The audit: random points of a study solved without the surface line's assumptions.

The solver looks for s on the line y = 0 of the surface, on planes through y. The audit searches the whole
body and all planes, by another route from the contact to the stress, and reports where the two differ.
"""

#: An audit's files have this before the name of the study.
AUDIT_PREFIX = "audit_"

"""The audit: random points of a study solved without the surface line's assumptions.

The solver looks for s on the line y = 0 of the surface, on planes through y. The audit looks everywhere in
the body and at all planes, by another way from the contact to the stress, and says where the two differ.
"""

#: Names of an audit's files: this, and the study's name.
AUDIT_PREFIX = "audit_"

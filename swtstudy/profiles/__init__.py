"""Profiles of indenters: what each family is, tables of a user's own, and contacts at rest."""

"""Faces beside the command line: real contacts in Python, methods of Datasets, histories, reports."""

"""The error of files that are not archives."""


class ArchiveError(ValueError):
    """A file that is not an archive of a study, or a damaged one."""

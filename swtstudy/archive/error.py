"""What is said of files that are no archives."""


class ArchiveError(ValueError):
    """A file that is not an archive of a study, or a damaged one."""

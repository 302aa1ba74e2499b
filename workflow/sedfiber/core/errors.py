"""The errors a user can meet; the command prints each as one line and exits non-zero."""


class SedfiberError(Exception):
    """Anything this package refuses or fails at, with a one-line message."""


class InputError(SedfiberError):
    """A value the user gave is not allowed: names the key, the value and what is allowed."""


class NumericalError(SedfiberError):
    """A computation failed: names what failed, where, and what to try."""

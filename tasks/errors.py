"""Define the errors of the judge: each says what was given, what is allowed and the cure."""


class TaskError(ValueError):
    """Report a caller's mistake in one line."""


class UnknownName(TaskError):
    """Report a name that is not in the folder it is looked up in."""


class BadValue(TaskError):
    """Report a number or quaternion that no episode can begin with."""


class BadArm(TaskError):
    """Report a file of tasks/arms that is no arm."""

"""Errors raised for a user's input or a failing run: each names place, value given, values allowed and remedy."""


class ParameterError(ValueError):
    """A parameter of a law, of the material or of the numerics is not usable.

    The message names class and parameter, the value given, the values allowed with their unit, and a remedy.
    """


class InputError(ValueError):
    """A field of the grid or an argument of a call is not usable; nothing was changed.

    The message names field or argument, the value given, the node, the values allowed with their unit, and a remedy.
    """


class OutputError(InputError):
    """A file cannot be written where it is wanted; a file that was there before is whole.

    The message names the file, the reason, and a remedy.
    """


class SimulationError(RuntimeError):
    """The state stopped being finite, or steps became too short to advance.

    Parameters
    ----------
    variable, particle, time
        As the attributes.
    value : float
        Value of the variable then, nan or inf, in its unit.

    Attributes
    ----------
    time : float
        Elapsed time of the event when the failure was noticed [s].
    particle : int or None
        Number of a particle concerned, in order of release; None if the failure concerns all.
    variable : str
        Name of the variable that is not finite.
    """

    def __init__(self, variable: str, particle: int | None, time: float, value: float):
        self.variable, self.particle, self.time, self._value = variable, particle, time, value
        owner = "" if particle is None else f" of particle {particle}"
        super().__init__(
            f"{variable}{owner} became {value} at {time:.6g} s; the grid is as it "
            "was before the call. Look at the terrain and the parameters there, or use more particles."
        )

    def __reduce__(self):
        # pickles rebuild an exception from its message alone; a worker process must return the other attributes, too
        return type(self), (self.variable, self.particle, self.time, self._value), vars(self)

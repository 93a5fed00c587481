"""What can be run: the base of scenes, systems, and first- and second-order problems."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable

from ._memory import Owner

if TYPE_CHECKING:
    from .results import Result


class Problem(Owner):
    """A problem that `hooke.run` takes."""

    _what: str  #: what it is, for messages
    #: hooke.run, which is above all problems and so sets this itself.
    _run_by: Callable[..., Result]

    def run(self, **options: Any) -> Result:
        """Runs it; see `hooke.run`."""
        return Problem._run_by(self, **options)

"""Parts of a scene: pieces that are generated rather than listed, one method a kind."""

from __future__ import annotations

from typing import Any, TypeVar

from ._types import Numbers, Path, Pins, Springs, Transform

S = TypeVar("S", bound="Parts")


class Parts:
    """The methods of a scene that add parts.

    Every part takes a `name` (the default is its kind and its number among the parts) and either `mass`, its total
    [kg], or `density`; an overdamped scene without gravity needs neither. `pinned` pins particles: numbers within the
    part, or words. A family of springs is a dict, ``dict(stiffness=50, damping=0.01)``, see `Springs`; a family that
    is not given has no springs. With `rigid` True the part moves as one rigid body. Springs follow the strain law, so
    that a finer part of the same material stretches equally. Each method returns the scene, for the
    next call.
    """

    def rope(
        self: S,
        name: str | None = None,
        *,
        from_: Numbers,
        to: Numbers,
        segments: int,
        mass: float | None = None,
        density: float | None = None,
        pinned: Pins | None = None,
        rigid: bool | None = None,
        stretch: Springs | None = None,
        bend: Springs | None = None,
        bending: float | None = None,
    ) -> S:
        """Adds a rope of ``segments + 1`` particles `from_` one end (3,) [m] `to` the other (3,) [m].

        `mass` [kg] or `density` [kg/m]; `pinned` also by "start" and "end"; springs between neighbours (`stretch`) and
        between particles two apart (`bend`); `bending` is the stiffness of the rope as a beam [N m^2]. `rigid` True makes
        it one rigid body.
        """
        return self._part("rope", locals())

    def cloth(
        self: S,
        name: str | None = None,
        *,
        edges: Numbers,
        size: Numbers,
        origin: Numbers | None = None,
        mass: float | None = None,
        density: float | None = None,
        pinned: Pins | None = None,
        rigid: bool | None = None,
        structural: Springs | None = None,
        shear: Springs | None = None,
        bend: Springs | None = None,
        bending: float | None = None,
    ) -> S:
        """Adds a cloth of `size` (nu, nv) particles over two `edges` (2, 3) [m] from its `origin` (3,) [m], zero if None.

        Particle (r, c) has the number ``r*nu + c`` within the cloth. `mass` [kg] or `density` [kg/m^2]; `pinned` also
        by "corners", "top" (the row at the origin) and "top-corners"; springs between neighbours (`structural`), along
        both diagonals of each cell (`shear`) and two apart (`bend`); `bending` is the stiffness of a strip as a beam
        over its width [N m]. `rigid` True makes
        it one rigid body.
        """
        return self._part("cloth", locals())

    def lattice(
        self: S,
        name: str | None = None,
        *,
        edges: Numbers,
        size: Numbers,
        origin: Numbers | None = None,
        mass: float | None = None,
        density: float | None = None,
        pinned: Pins | None = None,
        rigid: bool | None = None,
        structural: Springs | None = None,
        shear: Springs | None = None,
        bend: Springs | None = None,
    ) -> S:
        """Adds a block of `size` (nx, ny, nz) particles over three `edges` (3, 3) [m] from its `origin` (3,) [m], zero if
        None.

        Numbers within it run along x first, then y, then z. `mass` [kg] or `density` [kg/m^3]; `pinned` also by
        "bottom" (the layer at the origin) and "top"; springs between neighbours (`structural`), along all diagonals of
        the faces and of the body of each cell (`shear`), and two apart (`bend`). `rigid` True makes
        it one rigid body.
        """
        return self._part("lattice", locals())

    def mesh(
        self: S,
        name: str | None = None,
        *,
        file: Path | None = None,
        vertices: Numbers | None = None,
        triangles: Numbers | None = None,
        transform: Transform | None = None,
        weld: float | None = None,
        mass: float | None = None,
        density: float | None = None,
        pinned: Pins | None = None,
        rigid: bool | None = None,
        structural: Springs | None = None,
        bend: Springs | None = None,
    ) -> S:
        """Adds the surface of an OBJ `file`, or of `vertices` (n, 3) [m] and `triangles` (m, 3), three vertices each.

        `transform` is ``dict(scale=1, translate=(0, 0, 0))``: a factor on the coordinates and then a vector [m] to
        add; vertices up to `weld` [m] apart are one particle. `mass` [kg] is shared by area, or `density` [kg/m^2];
        `pinned` are numbers; springs along each edge (`structural`) and between the two vertices opposite to each
        other across each inner edge (`bend`). The scene keeps the vertices of a file, not its name. `rigid` True makes
        it one rigid body.
        """
        return self._part("mesh", locals())

    def strand(
        self: S,
        name: str | None = None,
        *,
        from_: Numbers,
        to: Numbers,
        segments: int,
        offset: float | None = None,
        curl: float | None = None,
        turns: float | None = None,
        mass: float | None = None,
        density: float | None = None,
        pinned: Pins | None = None,
        rigid: bool | None = None,
        stretch: Springs | None = None,
        bend: Springs | None = None,
        twist: Springs | None = None,
        altitude: Springs | None = None,
    ) -> S:
        """Adds a strand of hair along an axis `from_` one end (3,) [m] `to` the other (3,) [m] in so many `segments`,
        after Selle, Lentine and Fedkiw (2008).

        A straight one has an extra particle in each segment, `offset` segments away from the axis (0.5 if None); with
        `curl`, the radius [m] of a helix, and `turns` about the axis its particles lie on that helix. `mass` [kg] or
        `density` [kg/m]; `pinned` also by "start" and "end"; springs between neighbours (`stretch`), two apart
        (`bend`) and three apart (`twist`), and `altitude` springs of every four consecutive particles. `rigid` True makes
        it one rigid body.
        """
        return self._part("strand", locals())

    def _part(self: S, kind: str, given: dict[str, Any]) -> S:
        raise NotImplementedError

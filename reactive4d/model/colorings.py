"""Colourings: changes of how a surface looks."""

from typing import Any

from reactive4d.model.changes import Coloring
from reactive4d.model.settings import Float, Paint, Text

__all__ = ["Color", "Opacity", "Shade", "Texture"]


class Color(Coloring):
    """Another colour, from here on in the list.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(color="red")
    >>> _ = ball.apply(r4.Color("blue", enabled=r4.keys({0: 0, 2: 1}, interpolation="step")))
    >>> ball.paint.at(1.0), ball.paint.at(2.0)
    (array([1., 0., 0., 1.]), array([0., 0., 1., 1.]))
    """

    __slots__ = ()

    value = Paint(doc="a CSS name, a hexadecimal code, or three or four numbers")

    @staticmethod
    def paint(value: Any) -> dict[str, Any]:
        """The colour."""
        return {"color": value}


class Opacity(Coloring):
    """Another opacity, from here on in the list.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere(color="red")
    >>> _ = ball.apply(r4.Opacity(0.25))
    >>> ball.paint.at(0.0)
    array([1.  , 0.  , 0.  , 0.25])
    """

    __slots__ = ()

    value = Float(low=0.0, high=1.0, doc="0 lets all light through")

    @staticmethod
    def paint(value: float) -> dict[str, Any]:
        """The opacity."""
        return {"opacity": value}


class Shade(Coloring):
    """How the surface reflects light; what is not given stays as it was.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.apply(r4.Shade(specular=0.5))
    >>> ball.look.at(0.0)["specular"]
    0.5
    """

    __slots__ = ()

    script = "shade_val"
    positional = 0
    ambient = Float(low=0.0, doc="share of the light that comes from everywhere")
    diffuse = Float(low=0.0, doc="share of the light that is scattered")
    specular = Float(low=0.0, doc="share of the light that is mirrored")
    shininess = Float(low=0.0, doc="how sharp the highlights are (Phong's exponent)")
    metalness = Float(low=0.0, high=1.0, doc="0 for plastic, 1 for metal")
    roughness = Float(low=0.0, high=1.0, doc="0 for a mirror, 1 for chalk")
    bumpiness = Float(low=0.0, doc="how much the texture raises the surface")
    surface_color = Paint(doc="the colour of the surface")

    @staticmethod
    def paint(
        ambient: Any,
        diffuse: Any,
        specular: Any,
        shininess: Any,
        metalness: Any,
        roughness: Any,
        bumpiness: Any,
        surface_color: Any,
    ) -> dict[str, Any]:
        """What was given."""
        given = {
            "ambient": ambient,
            "diffuse": diffuse,
            "specular": specular,
            "shininess": shininess,
            "metalness": metalness,
            "roughness": roughness,
            "bumpiness": bumpiness,
            "color": surface_color,
        }
        return {name: value for name, value in given.items() if value is not None}


class Texture(Coloring):
    """A picture on the surface, by its texture coordinates.

    >>> import reactive4d as r4
    >>> ball = r4.Sphere()
    >>> _ = ball.apply(r4.Texture("wood.png"))
    >>> ball.look.at(0.0)["texture"]
    'wood.png'
    """

    __slots__ = ()

    picture = Text(longest=4096, doc="the path of a picture")

    @staticmethod
    def paint(picture: str) -> dict[str, Any]:
        """The picture."""
        return {"texture": picture}

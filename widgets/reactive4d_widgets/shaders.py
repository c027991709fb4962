"""Shaders: the text of what a graphics card does for each pixel of a lit surface.

The formulas are those of the browser's viewer (three.js, MeshPhongMaterial): light is added up in linear numbers,
scattered by Lambert's law and mirrored by Blinn's and Phong's with Schlick's Fresnel term; a rim darkens where one
looks along the surface; the sum is written as sRGB without any mapping of tones.
"""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from reactive4d_widgets.lamps import Lamp, Sky

__all__ = ["shading"]

Array = NDArray[np.float64]

SPECULAR = 0.0080  # of #161616, linear
SHININESS = 24.0
PENUMBRA = 0.15

_START = """//VTK::Light::Impl
  vec3 r4Srgb = clamp(vertexColorVSOutput.rgb, 0.0, 1.0);
  vec3 r4Color = mix(pow((r4Srgb + 0.055) / 1.055, vec3(2.4)), r4Srgb / 12.92,
                     vec3(lessThanEqual(r4Srgb, vec3(0.04045))));
  vec3 r4Normal = normalize(normalVCVSOutput);
  vec3 r4Back = normalize(-vertexVC.xyz);
"""
_SKY = """  vec3 r4Light = r4Color * mix({below}, {above}, 0.5 + 0.5 * dot(r4Normal, {up}));
"""
_LAMP = """  {{
    {way}
    float r4Cosine = clamp(dot(r4Normal, r4Way), 0.0, 1.0);
    vec3 r4Half = normalize(r4Way + r4Back);
    float r4Grazing = clamp(dot(r4Back, r4Half), 0.0, 1.0);
    float r4Fresnel = exp2((-5.55473 * r4Grazing - 6.98316) * r4Grazing);
    float r4Mirrored = mix({specular}, 1.0, r4Fresnel) * 0.25 * ({shininess} * 0.5 + 1.0)
                     * pow(clamp(dot(r4Normal, r4Half), 0.0, 1.0), {shininess});
    r4Light += r4Strength * {color} * r4Cosine * (r4Color + r4Mirrored);
  }}
"""
_FAR = """vec3 r4Way = {way};
    float r4Strength = 1.0;"""
_NEAR = """vec3 r4Way = {position} - vertexVC.xyz;
    float r4Distance = length(r4Way);
    r4Way /= max(r4Distance, 1e-9);
    float r4Strength = 1.0;"""
_REACH = """
    r4Strength *= pow(clamp(1.0 - pow(r4Distance / {reach}, 4.0), 0.0, 1.0), 2.0);"""
_CONE = """
    r4Strength *= smoothstep({outer}, {inner}, dot(r4Way, {way}));"""
_STOP = """  float r4Edge = 1.0 - clamp(abs(dot(r4Normal, r4Back)), 0.0, 1.0);
  r4Light = clamp(mix(r4Light, vec3({rim}), {strength} * r4Edge * r4Edge * r4Edge), 0.0, 1.0);
  gl_FragData[0] = vec4(mix(1.055 * pow(max(r4Light, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, 12.92 * r4Light,
                            vec3(lessThanEqual(r4Light, vec3(0.0031308)))), opacity);
"""


def shading(sky: Sky, lamps: Iterable[Lamp], to_eye: Array, *, rim: tuple[float, float] = (0.0, 0.3)) -> str:
    """The text that takes the place of VTK's own `//VTK::Light::Impl`.

    Args:
        sky: the light from everywhere.
        lamps: the lights of one place or direction.
        to_eye: (4, 4), from world space to the eye's axes, in which the card reckons.
        rim: the light (0 to 1) to which a surface tends where one looks along it, and how much.

    >>> import numpy as np
    >>> sky = Sky(np.ones(3), np.zeros(3), np.array([0.0, 0.0, 1.0]))
    >>> shading(sky, [], np.eye(4)).count("vec3(0.000000, 0.000000, 1.000000)")  # up is up
    1
    """
    linear, offset = to_eye[:3, :3], to_eye[:3, 3]
    mirror = {"specular": _float(SPECULAR), "shininess": _float(SHININESS)}
    parts = [_START, _SKY.format(below=_vec(sky.below), above=_vec(sky.above), up=_vec(linear @ sky.up))]
    for lamp in lamps:
        way = _vec(linear @ -lamp.towards)
        if lamp.position is None:
            found = _FAR.format(way=way)
        else:
            found = _NEAR.format(position=_vec(linear @ lamp.position + offset))
            if lamp.reach is not None:
                found += _REACH.format(reach=_float(lamp.reach))
            if lamp.angle is not None:
                outer, inner = math.cos(lamp.angle), math.cos(lamp.angle * (1.0 - PENUMBRA))
                found += _CONE.format(outer=_float(outer), inner=_float(max(inner, outer + 1e-6)), way=way)
        parts.append(_LAMP.format(way=found, color=_vec(lamp.color), **mirror))
    return "".join([*parts, _STOP.format(rim=_float(rim[0]), strength=_float(rim[1]))])


def _vec(vector: Array) -> str:
    return f"vec3({', '.join(map(_float, vector.tolist()))})"


def _float(number: float) -> str:
    """A number as the language of shaders writes it: always with a point, never as 1e-05."""
    return f"{number:.6f}"

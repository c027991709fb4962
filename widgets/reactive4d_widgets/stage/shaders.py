"""Shaders: the text of what a graphics card does for each pixel of a lit surface.

The formulas are those of the browser's viewer (three.js, MeshPhongMaterial): light is added up in linear numbers,
scattered by Lambert's law and mirrored by Blinn's and Phong's with Schlick's Fresnel term; a rim darkens where one
looks along the surface; the sum is written as sRGB without any mapping of tones. The text holds no numbers of a scene:
these are uniforms, so that a lamp may move and the card has nothing to compile.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from reactive4d_widgets.lamps import Lamp

__all__ = ["COLOR", "MAP", "NEARER", "PAINTS", "Sort", "shading", "sort_of"]

MAP = "r4Map"  # the distances that lamps see, one square above the other
SPECULAR = 0.0080  # of #161616, linear
SHININESS = 24.0  # a power that takes five products
SOFT = 3  # pixels of a lamp's picture over which the edge of a shadow fades
BIAS = 2.5  # pixels of it by which places are lifted off their surface
_TAPS = [(a, b) for a in range(-SOFT, SOFT + 1) for b in range(-SOFT, SOFT + 1) if a * a + b * b <= SOFT * SOFT + 1]
_PROBES = [(0, 0), (-SOFT, 0), (SOFT, 0), (0, -SOFT), (0, SOFT)]

# Edges are drawn a little towards the eye, so that surfaces do not hide their own.
NEARER = """//VTK::PositionVC::Impl
  gl_Position.z += r4Nearer;
"""
_START = """//VTK::Light::Impl
  vec3 r4Color = {color};
  vec3 r4Normal = normalize(normalVCVSOutput);
  vec3 r4Back = normalize(-vertexVC.xyz);
  vec3 r4Light = r4Color * mix(r4Below, r4Above, 0.5 + 0.5 * dot(r4Normal, r4Up));
"""
# A surface's one colour is told as linear light. Paints are bytes, of which VTK makes others, as if it were to light
# them: they are taken as they come, and are sRGB.
COLOR = "diffuseColor"
PAINTS = """mix(pow((vertexColorVSOutput.rgb + 0.055) / 1.055, vec3(2.4)), vertexColorVSOutput.rgb / 12.92,
                     vec3(lessThanEqual(vertexColorVSOutput.rgb, vec3(0.04045))))"""
_FLAT = """  vec3 r4Flat = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));
  r4Flat = dot(r4Flat, r4Back) < 0.0 ? -r4Flat : r4Flat;
"""
_DIGITS = "  const vec3 r4Digits = vec3(1.0, 256.0, 65536.0) * 255.0 / 16777215.0;\n"  # of a distance in the map
_LAMP = """  {{
    {way}
    float r4Cosine = clamp(dot(r4Normal, r4Way), 0.0, 1.0);
    {shadow}
    vec3 r4Half = normalize(r4Way + r4Back);
    float r4Grazing = clamp(dot(r4Back, r4Half), 0.0, 1.0);
    float r4Fresnel = exp2((-5.55473 * r4Grazing - 6.98316) * r4Grazing);
    float r4Power = clamp(dot(r4Normal, r4Half), 0.0, 1.0);
    r4Power *= r4Power;
    r4Power *= r4Power;
    r4Power *= r4Power;
    r4Power *= r4Power * r4Power;
    float r4Mirrored = mix({specular:.6f}, 1.0, r4Fresnel) * 0.25 * ({shininess:.6f} * 0.5 + 1.0)
                     * r4Power;
    r4Light += r4Strength * r4Color{i} * r4Cosine * (r4Color + r4Mirrored);
  }}
"""
_FAR = """vec3 r4Way = r4Way{i};
    float r4Strength = 1.0;"""
_NEAR = """vec3 r4Way = r4Place{i} - vertexVC.xyz;
    float r4Distance = length(r4Way);
    r4Way /= max(r4Distance, 1e-9);
    float r4Strength = 1.0;"""
_REACH = """
    r4Strength *= pow(clamp(1.0 - pow(r4Distance / r4Reach{i}, 4.0), 0.0, 1.0), 2.0);"""
_CONE = """
    r4Strength *= smoothstep(r4Cone{i}.x, r4Cone{i}.y, dot(r4Way, r4Way{i}));"""
# r4Eye: metres to the edge of the lamp's picture (where rays are parallel; else per metre ahead, negative), near, far.
_SHADOW = """if (r4Strength * r4Cosine > 0.0)
    {{
      float r4Ahead = -dot(r4Z{i}, vec4(vertexVC.xyz, 1.0));
      float r4Edge = r4Eye{i}.x > 0.0 ? r4Eye{i}.x : -r4Eye{i}.x * abs(r4Ahead);
      float r4Pixel = 2.0 * r4Edge / {size:.1f};
      vec4 r4Lifted = vec4(vertexVC.xyz + {bias:.3f} * r4Pixel * r4Flat, 1.0);
      vec2 r4At = {size:.1f} / 2.0 * (1.0 + vec2(dot(r4X{i}, r4Lifted), dot(r4Y{i}, r4Lifted)) / r4Edge) - 0.5;
      float r4Limit = -dot(r4Z{i}, r4Lifted);
      if (r4Limit > 0.0 && all(lessThan(abs(r4At - {size:.1f} / 2.0), vec2({size:.1f} / 2.0 - {soft}.0 - 2.0))))
      {{
        r4Limit -= 0.5 * r4Pixel;
        float r4Share = (r4Limit - r4Eye{i}.y) / (r4Eye{i}.z - r4Eye{i}.y);
        r4Share *= r4Eye{i}.x > 0.0 ? 1.0 : r4Eye{i}.z / r4Limit;
        ivec2 r4Texel = ivec2(round(r4At)) + ivec2(0, {first});
        float r4Lit = 0.0;
        for (int k = 0; k < {probes}; k++)
          r4Lit += dot(texelFetch({map}, r4Texel + r4Probes[k], 0).rgb, r4Digits) >= r4Share ? 1.0 : 0.0;
        if (r4Lit > 0.5 && r4Lit < {probes}.0 - 0.5)
        {{
          r4Lit = 0.0;
          for (int k = 0; k < {taps}; k++)
            r4Lit += dot(texelFetch({map}, r4Texel + r4Taps[k], 0).rgb, r4Digits) >= r4Share ? 1.0 : 0.0;
          r4Lit *= {probes}.0 / {taps}.0;
        }}
        r4Strength *= r4Lit / {probes}.0;
      }}
    }}"""
# sRGB of three roots: off by less than a tenth of a step of a byte, and quicker than a power.
_STOP = """  float r4Rim = 1.0 - clamp(abs(dot(r4Normal, r4Back)), 0.0, 1.0);
  r4Light = clamp(mix(r4Light, vec3(r4Tending.x), r4Tending.y * r4Rim * r4Rim * r4Rim), 0.0, 1.0);
  vec3 r4Root = sqrt(r4Light);
  vec3 r4Root4 = sqrt(r4Root);
  vec3 r4Srgb = 0.64456067 * r4Root + 0.70994555 * r4Root4 - 0.33605156 * sqrt(r4Root4) - 0.01848596 * r4Light;
  gl_FragData[0] = vec4(mix(r4Srgb, 12.92 * r4Light, vec3(lessThanEqual(r4Light, vec3(0.0031308)))), opacity);
"""


@dataclass(frozen=True, slots=True)
class Sort:
    """What the text has to know of a lamp.

    Attributes:
        stands: whether it is at a place; else it shines from afar.
        ends: whether its light does not go on for ever.
        narrow: whether it has a cone.
        row: of the map of distances, which is its first one; None where it throws no shadows.
    """

    stands: bool
    ends: bool
    narrow: bool
    row: int | None


def sort_of(lamp: Lamp, row: int | None) -> Sort:
    """Of what sort a lamp is.

    Args:
        lamp: of the scene.
        row: of the map of distances, which is its first one.
    """
    stands = lamp.position is not None
    return Sort(stands, stands and lamp.reach is not None, stands and lamp.angle is not None, row)


def shading(sorts: Sequence[Sort], *, color: str, size: int) -> str:
    """The text that takes the place of VTK's own `//VTK::Light::Impl`.

    Args:
        sorts: of the lamps, in their order.
        color: what surfaces have, `COLOR` or `PAINTS`.
        size: of the picture of distances of each, pixels.

    >>> shading([Sort(False, False, False, None)], color=COLOR, size=1024).count("r4Way0")
    1
    >>> "texelFetch" in shading([Sort(False, False, False, 0)], color=COLOR, size=1024)
    True
    """
    parts = [_START.format(color=color)]
    if any(sort.row is not None for sort in sorts):
        parts += [_FLAT, _DIGITS, _offsets("r4Taps", _TAPS), _offsets("r4Probes", _PROBES)]
    numbers = {"bias": BIAS, "soft": SOFT, "size": float(size), "probes": len(_PROBES), "taps": len(_TAPS), "map": MAP}
    for i, sort in enumerate(sorts):
        way = (_NEAR if sort.stands else _FAR) + (_REACH if sort.ends else "") + (_CONE if sort.narrow else "")
        shadow = "" if sort.row is None else _SHADOW.format(i=i, first=sort.row, **numbers)
        parts.append(
            _LAMP.format(i=i, way=way.format(i=i), shadow=shadow, specular=SPECULAR, shininess=SHININESS),
        )
    return "".join([*parts, _STOP])


def _offsets(name: str, offsets: Sequence[tuple[int, int]]) -> str:
    listed = ", ".join([f"ivec2({a}, {b})" for a, b in offsets])
    return f"  const ivec2 {name}[{len(offsets)}] = ivec2[{len(offsets)}]({listed});\n"

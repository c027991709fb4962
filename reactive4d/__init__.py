"""Models that can be asked for any instant: signals, and a memo that knows how long an answer holds."""

import sys

from reactive4d import process as _process
from reactive4d.engine.events import Event
from reactive4d.engine.graphs import Graph
from reactive4d.errors import (
    CycleError,
    DepthError,
    EvaluationError,
    PageTooLargeError,
    ParameterError,
    Reactive4dError,
    ScriptError,
    ShapeError,
    TimeError,
    UnknownNameError,
)
from reactive4d.geometry.meshes import Mesh
from reactive4d.geometry.rays import Hits
from reactive4d.illustrations import Bookmark, Figure, Illustration, Page
from reactive4d.intervals import FOREVER, Interval, IntervalSet
from reactive4d.model.changes import Become, Change, Coloring, Deformation, Mapping, Note, Reshape, Transform
from reactive4d.model.colorings import Color, Opacity, Shade, Texture
from reactive4d.model.deformations import Bend, FreeForm, Ripple, Skew, Taper, Twist, Wave, XForm
from reactive4d.model.drawings import Lines, Points
from reactive4d.model.frames import Frame
from reactive4d.model.guests import from_pyvista
from reactive4d.model.kinds.aggregates import Combination, Group, Hull
from reactive4d.model.kinds.arrows import Arrow
from reactive4d.model.kinds.blobs import Blob
from reactive4d.model.kinds.boxes import Box
from reactive4d.model.kinds.cylinders import Cone, Cylinder, Quadric, Tube
from reactive4d.model.kinds.models import Model, Wire
from reactive4d.model.kinds.patches import Patch
from reactive4d.model.kinds.planes import Plane
from reactive4d.model.kinds.polyhedra import Polyhedron, Teapot
from reactive4d.model.kinds.shapes import Circle, Helix, Line, Ngon, Path, Rectangle, Star
from reactive4d.model.kinds.spheres import Sphere
from reactive4d.model.kinds.superquadrics import Superquadric
from reactive4d.model.kinds.sweeps import Duct, Prism, Revolution
from reactive4d.model.kinds.texts import Lettering
from reactive4d.model.kinds.tori import Torus
from reactive4d.model.kinds.views import Camera, Label, Light, Point
from reactive4d.model.mappings import MapTexture
from reactive4d.model.nodes import Node
from reactive4d.model.notes import Sent, Store
from reactive4d.model.objects import Object
from reactive4d.model.outlines import Outline, Outlines
from reactive4d.model.reshapings import Extrude, Lathe
from reactive4d.model.scenes import Scene
from reactive4d.model.selections import Select, Selecting
from reactive4d.model.settings import Choice, Flag, Float, Held, Integer, Paint, Places, Reference, Text, Vector
from reactive4d.model.tables import Table
from reactive4d.model.transforms import LinkedXForm, LookAt, Matrix, Mirror, Orient, Rotate, Scale, Shear, Translate
from reactive4d.model.trimeshes import from_trimesh
from reactive4d.process import explain, graph, log, stats, transaction
from reactive4d.scefo.binding import dumps, loads
from reactive4d.scefo.unparsing import NotWritableError
from reactive4d.signals.algebra import equal, lift, vec
from reactive4d.signals.choices import where
from reactive4d.signals.colors import color
from reactive4d.signals.curves import Key
from reactive4d.signals.facade import Signal
from reactive4d.signals.functions import signal
from reactive4d.signals.keys import Keys, keys
from reactive4d.signals.rotations import Rotation
from reactive4d.signals.sources import Parameter, Variable, time
from reactive4d.sweeping import contact_sheet, sweep

__all__ = [
    "FOREVER",
    "Arrow",
    "Become",
    "Bend",
    "Blob",
    "Bookmark",
    "Box",
    "Camera",
    "Change",
    "Choice",
    "Circle",
    "Color",
    "Coloring",
    "Combination",
    "Cone",
    "CycleError",
    "Cylinder",
    "Deformation",
    "DepthError",
    "Duct",
    "EvaluationError",
    "Event",
    "Extrude",
    "Figure",
    "Flag",
    "Float",
    "Frame",
    "FreeForm",
    "Graph",
    "Group",
    "Held",
    "Helix",
    "Hits",
    "Hull",
    "Illustration",
    "Integer",
    "Interval",
    "IntervalSet",
    "Key",
    "Keys",
    "Label",
    "Lathe",
    "Lettering",
    "Light",
    "Line",
    "Lines",
    "LinkedXForm",
    "LookAt",
    "MapTexture",
    "Mapping",
    "Matrix",
    "Mesh",
    "Mirror",
    "Model",
    "Ngon",
    "Node",
    "NotWritableError",
    "Note",
    "Object",
    "Opacity",
    "Orient",
    "Outline",
    "Outlines",
    "Page",
    "PageTooLargeError",
    "Paint",
    "Parameter",
    "ParameterError",
    "Patch",
    "Path",
    "Places",
    "Plane",
    "Point",
    "Points",
    "Polyhedron",
    "Prism",
    "Quadric",
    "Reactive4dError",
    "Rectangle",
    "Reference",
    "Reshape",
    "Revolution",
    "Ripple",
    "Rotate",
    "Rotation",
    "Scale",
    "Scene",
    "ScriptError",
    "Select",
    "Selecting",
    "Sent",
    "Shade",
    "ShapeError",
    "Shear",
    "Signal",
    "Skew",
    "Sphere",
    "Star",
    "Store",
    "Superquadric",
    "Table",
    "Taper",
    "Teapot",
    "Text",
    "Texture",
    "TimeError",
    "Torus",
    "Transform",
    "Translate",
    "Tube",
    "Twist",
    "UnknownNameError",
    "Variable",
    "Vector",
    "Wave",
    "Wire",
    "XForm",
    "color",
    "contact_sheet",
    "dumps",
    "equal",
    "explain",
    "from_pyvista",
    "from_trimesh",
    "graph",
    "keys",
    "lift",
    "loads",
    "log",
    "signal",
    "stats",
    "sweep",
    "time",
    "transaction",
    "vec",
    "where",
]

budget: int
sys.modules[__name__].__class__ = _process.Budgeted

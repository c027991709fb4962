"""Displays: on what is drawn here: a screen, or what VTK can draw on without one.

It is found out first, for VTK ends the process where there is nothing.
"""

import ctypes
import os
import sys
import threading
from collections.abc import Generator
from contextlib import contextmanager
from functools import cache
from typing import Any

from reactive4d.errors import EvaluationError, hint

__all__ = ["can_draw", "drawable", "has_screen"]

CHOICE = "VTK_DEFAULT_OPENGL_WINDOW"
EGL_PLATFORM_DEVICE = 0x313F


@contextmanager
def drawable() -> Generator[None]:
    """While the block runs, VTK makes its windows where it can draw without being seen.

    On Linux that is the X server where there is one, else EGL, else OSMesa. VTK would look for them in this order
    itself, but complain about each that is missing. Elsewhere, or where the environment names VTK's window, it is left
    alone.

    Raises:
        EvaluationError: there is none of them.

    >>> with drawable():
    ...     import pyvista
    """
    _choice.enter()
    try:
        yield
    finally:
        _choice.leave()


class _Choice:
    """What the environment says of VTK's window, which all threads share: as long as one of them draws."""

    def __init__(self) -> None:
        self._guard = threading.Lock()
        self._inside = 0
        self._is_ours = False

    def enter(self) -> None:
        with self._guard:
            if not self._inside and sys.platform.startswith("linux") and CHOICE not in os.environ:
                os.environ[CHOICE] = _window()
                self._is_ours = True
            self._inside += 1

    def leave(self) -> None:
        with self._guard:
            self._inside -= 1
            if not self._inside and self._is_ours:
                self._is_ours = False
                os.environ.pop(CHOICE, None)


_choice = _Choice()


def can_draw() -> bool:
    """Whether pictures can be drawn here.

    >>> can_draw() or "no OpenGL here"
    True
    """
    try:
        with drawable():
            return True
    except EvaluationError:
        return False


def has_screen() -> bool:
    """Whether a browser could show something: on Linux without a display those that are found draw letters only."""
    names = ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY")
    return not sys.platform.startswith("linux") or any(os.environ.get(name) for name in names)


def _window() -> str:
    if os.environ.get("DISPLAY") and _has_x(os.environ["DISPLAY"]):
        return "vtkXOpenGLRenderWindow"
    if _has_egl():
        return "vtkEGLRenderWindow"
    if any(_library(f"libOSMesa.so.{n}") for n in (8, 7, 6)):
        return "vtkOSOpenGLRenderWindow"
    raise hint(
        EvaluationError("pictures are drawn with OpenGL, and there is none here"),
        "on Debian and its relatives: apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri",
    )


def _library(name: str) -> Any:
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None


@cache
def _has_x(display: str) -> bool:
    """Whether there is an X server of that name."""
    library = _library("libX11.so.6")
    if library is None:
        return False
    library.XOpenDisplay.restype = ctypes.c_void_p
    opened = library.XOpenDisplay(display.encode())
    if opened:
        library.XCloseDisplay(ctypes.c_void_p(opened))
    return bool(opened)


@cache
def _has_egl() -> bool:
    """Whether EGL can be had on some device, as VTK asks for it.

    What this opens stays open: if VTK had opened it before, to close it here would take it away from it.
    """
    library = _library("libEGL.so.1")
    if library is None:
        return False
    library.eglGetProcAddress.restype = ctypes.c_void_p
    places = [library.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglGetPlatformDisplayEXT")]
    if not all(places):
        return False
    devices, count = (ctypes.c_void_p * 16)(), ctypes.c_int(0)
    pointer: Any = ctypes.c_void_p
    query = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, pointer, pointer)(places[0])
    if not query(len(devices), ctypes.byref(devices), ctypes.byref(count)):
        return False
    display_of = ctypes.CFUNCTYPE(pointer, ctypes.c_uint, pointer, pointer)(places[1])
    for device in devices[: count.value]:
        display = display_of(EGL_PLATFORM_DEVICE, device, None)
        if display and library.eglInitialize(pointer(display), None, None):
            return True
    return False

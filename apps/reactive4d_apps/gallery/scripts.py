"""Figures of scripts: the first script of the paper on BAGS (1990), as printed and set in motion."""

from importlib.resources import as_file, files

import reactive4d as r4

__all__ = ["Printed", "moving", "scene"]


def scene(name: str) -> r4.Scene:
    """A scene that comes with the package.

    Args:
        name: of the script's file.

    >>> list(scene("figure1.scefo"))
    ['sphere', 'cube', 'light', 'camera', 'egg']
    """
    with as_file(files("reactive4d.scefo") / "scenes") as folder:
        return r4.Scene.load(folder / name)


class Printed(r4.Illustration):
    """The script of figure 1: objects that are read from files, one made from another, and changes of them."""

    def build(self) -> r4.Scene:
        """The scene, as the script says."""
        return scene("figure1.scefo")


def moving() -> r4.Scene:
    """The same with more keys: the egg rises, the camera goes a quarter round, the light turns.

    >>> moving().signals["height"].at(1.0)
    1.75
    """
    made = scene("figure1_moving.scefo")
    made.signals["height"] = made["egg"].position[2]
    return made

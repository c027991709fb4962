# ---
# jupyter:
#   jupytext:
#     formats: ipynb,py:percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # A sweep
#
# How far does the bob rise? Ask for every length and angle.

# %%
import numpy as np
import param

import reactive4d as r4


class Pendulum(r4.Illustration):
    """A pendulum of adjustable length."""

    length = param.Number(1.0, bounds=(0.2, 2.0), doc="length of the rod [m]")
    angle = param.Number(20.0, bounds=(-90, 90), doc="starting angle [deg]")

    def build(self) -> r4.Scene:
        """Describe the model once; the signals carry every later change."""
        p = self.signals
        swing = p.angle * np.cos(np.sqrt(9.81 / p.length) * r4.time)

        rod = r4.Cylinder(radius=0.02, height=p.length)
        bob = r4.Sphere(radius=0.1, color="crimson")
        rod.translate(r4.vec(0, 0, -p.length / 2))
        bob.translate(r4.vec(0, 0, -p.length))
        for part in (rod, bob):
            part.rotate(swing, axis="y")
        return r4.Scene(rod=rod, bob=bob)


# %%
result = r4.sweep(
    Pendulum,
    over={"length": np.linspace(0.5, 2, 16), "angle": (10, 45), "time": np.linspace(0, 10, 501)},
    measure={"height": lambda scene: scene["bob"].position[2]},
)  # xarray.Dataset: height (length, angle, time)

print(result.height.max("time") - result.height.min("time"))

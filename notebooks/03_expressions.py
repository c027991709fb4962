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
# # Expressions
#
# Arithmetic on signals is arithmetic on their values: a bouncing ball, and a shadow that knows how high it is.

# %%
import math

import numpy as np

import reactive4d as r4

ball = r4.Sphere(radius=0.25)
ball.translate(r4.vec(0, 0, 2 * np.abs(np.sin(np.pi * r4.time))))

shadow = r4.Cylinder(radius=0.25, height=0.01, color="gray")
shadow.scale(1 - ball.position[2] / 4)

# %% [markdown]
# Any Python function of time is a signal, too.


# %%
@r4.signal
def sway(t: float) -> float:
    """Any Python function of time is a signal too; what it reads through `at` is tracked."""
    return 10 * math.sin(t) if t < 5 else 0.0


ball.rotate(sway, axis="x")

# %%
scene = r4.Scene(ball=ball, shadow=shadow)
scene.show()

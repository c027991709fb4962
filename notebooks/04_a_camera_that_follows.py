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
# # A camera that follows
#
# It looks at the bee, and turns to the fly between the second and the third second.
# The eye never looks away from the fly.

# %%
import numpy as np

import reactive4d as r4

t = r4.time
bee, fly = r4.Sphere(radius=0.1), r4.Sphere(radius=0.05)
bee.translate(r4.vec(2 * np.cos(t), 2 * np.sin(t), 1))
fly.translate(r4.vec(np.sin(3 * t), 3, 1 + np.cos(2 * t)))

# %%
camera = r4.Camera(position=(6, -6, 3), target=r4.keys({2: bee.position, 3: fly.position}))
eye = r4.Sphere(radius=0.2)
eye.apply(r4.LookAt(fly.position))

scene = r4.Scene(bee=bee, fly=fly, eye=eye, camera=camera)

# %%
scene.show()

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
# # Solids
#
# They combine like sets: a drill moves through a block.

# %%
import reactive4d as r4

block = r4.Box(size=(3, 2, 1))
drill = r4.Cylinder(radius=0.4, height=3)
drill.translate(r4.keys({0: (-1, 0, 3), 2: (-1, 0, 0), 4: (1, 0, 0)}))

part = block - drill
print(part.volume.at(0.0), part.volume.at(4.0))

# %%
scene = r4.Scene(part=part)
scene.show()

# %% [markdown]
# The part follows what its drill becomes.

# %%
drill.radius = 0.2  # the part follows
print(part.volume.at(4.0))

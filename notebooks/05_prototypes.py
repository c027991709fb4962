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
# # Prototypes
#
# One rivet, and eight that extend it.

# %%
import reactive4d as r4

rivet = r4.Cylinder(radius=0.1, height=0.1)
rivets = [rivet.extend() for _ in range(8)]
for i, copy in enumerate(rivets):
    copy.rotate(45 * i, axis="x")
    copy.translate((i, 0, 0))

scene = r4.Scene({f"rivet{i}": copy for i, copy in enumerate(rivets)})
scene.show()

# %% [markdown]
# What is done to the first one now, is done to all. A change that is appended acts after their own changes:

# %%
rivet.translate((0, 0, 1))  # applied after each copy's own changes: every rivet rises, whichever way it points

# %% [markdown]
# One that is placed first acts before them:

# %%
rivet.changes.insert(0, r4.Scale((1, 1, 2)))  # placed before them: every rivet grows along its own axis

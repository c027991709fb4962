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
# # A list of changes
#
# An object is a list of changes, and the list can be edited.

# %%
import reactive4d as r4

column = r4.Box(size=(1, 1, 6), segments=(4, 4, 24))
bend = column.apply(r4.Bend(60, axis="x"))
twist = column.apply(r4.Twist(r4.keys({0: 0, 4: 180})))

scene = r4.Scene(column=column)
scene.show()

# %% [markdown]
# In another order it is another shape:

# %%
column.changes.move(twist, before=bend)  # twist first, then bend
bend.angle = 30  # the twisted mesh below the bend stays cached

# %% [markdown]
# A change may be off for a while, and may be taken out again.

# %%
bend.enabled = r4.keys({0: 0, 2: 1}, interpolation="step")  # even "is it on" may vary in time
column.changes.remove(twist)

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
# # Keys
#
# Values at times, in seconds, and an easing between them.

# %%
import reactive4d as r4

ball = r4.Sphere(radius=0.25)
slide = ball.translate(r4.keys({0: (0, 0, 0), 1: (2, 0, 0), 3: (2, 2, 0)}, ease="in_out"))
ball.color = r4.keys({0: "crimson", 3: "gold"})

# %%
scene = r4.Scene(ball=ball)
scene.show()

# %% [markdown]
# Any instant can be asked for, in any order. An answer says for how long it holds.

# %%
print(ball.position.at(0.5))  # any instant, in any order
print(ball.position.valid(7.0))

# %% [markdown]
# An edit makes stale only what it touches. Run this cell, and the figure above goes up instead.

# %%
slide.offset = r4.keys({0: (0, 0, 0), 2: (0, 0, 5)})  # an edit invalidates only what it touches

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
# # A first scene
#
# A ball on a table. Objects are made, moved by changes, and named in a scene.

# %%
import reactive4d as r4

table = r4.Box(size=(2, 1, 0.1), color="tan")
ball = r4.Sphere(radius=0.25, color="crimson")
ball.translate((0, 0, 0.3))

scene = r4.Scene(table=table, ball=ball)

# %% [markdown]
# A scene is a figure. Drag in the picture to look at it from elsewhere.

# %%
scene.show()

# %% [markdown]
# It can be asked, too: where is the ball, and in which box does it lie?

# %%
print(ball.position.at(0.0))
print(ball.bounds.at(0.0))

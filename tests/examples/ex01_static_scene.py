"""A ball on a table."""

import reactive4d as r4

table = r4.Box(size=(2, 1, 0.1), color="tan")
ball = r4.Sphere(radius=0.25, color="crimson")
ball.translate((0, 0, 0.3))

scene = r4.Scene(table=table, ball=ball)

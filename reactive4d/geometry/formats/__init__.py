"""File formats of meshes: each module reads bytes into a mesh, and writes a mesh into bytes."""

"""The programs of the book's figures: one module for each chapter, classes of illustrations in it."""

"""Objects as ordered, editable lists of changes, and everything that one can ask about them."""

"""What asking costs: ours and its Python peers at the same work, in one process, by turns."""

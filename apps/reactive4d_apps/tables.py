"""Tables in plain text, for a terminal of any width."""

from collections.abc import Sequence

__all__ = ["stacked", "table"]

GAP = "  "


def table(head: Sequence[str], rows: Sequence[Sequence[str]], *, left: int = 1) -> list[str]:
    r"""Lay rows out in columns as wide as their widest cell, below a head and a rule.

    Args:
        head: the name of each column.
        rows: the cells of each row, as many as there are names; a cell may have several lines.
        left: how many columns, counted from the first, stand flush left; the others stand flush right.

    Returns:
        The lines, without trailing blanks.

    >>> print(*table(["edit", "runs"], [["none", "0"], ["a key", "12"]]), sep="\n")
    edit   runs
    ───────────
    none      0
    a key    12
    """
    blocks = [[cell.split("\n") for cell in row] for row in [head, *rows]]
    widths = [max(len(line) for row in blocks for line in row[column]) for column in range(len(head))]
    lines: list[str] = []
    for block in blocks:
        for depth in range(max(map(len, block))):
            cells = [cell[depth] if depth < len(cell) else "" for cell in block]
            padded = [
                text.ljust(width) if column < left else text.rjust(width)
                for column, (text, width) in enumerate(zip(cells, widths, strict=True))
            ]
            lines.append(GAP.join(padded).rstrip())
        if block is blocks[0]:
            lines.append("─" * (sum(widths) + len(GAP) * (len(widths) - 1)))
    return lines


def stacked(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    r"""Lay the same cells out one column after the other, for where they do not fit side by side.

    Args:
        head: the name of each column; the first column names the rows.
        rows: the cells of each row.

    Returns:
        The lines, without trailing blanks; each column is a paragraph under its name, without its empty cells.

    >>> print(*stacked(["t", "height", "lamp"], [["0", "3\n[0, 1)", "off"], ["10", "1", "on"]]), sep="\n")
    height
       0  3  [0, 1)
      10  1
    <BLANKLINE>
    lamp
       0  off
      10  on
    """
    labels = [row[0] for row in rows]
    indent = max(map(len, labels))
    lines: list[str] = []
    for column in range(1, len(head)):
        cells = [row[column].split("\n") for row in rows]
        width = max(len(cell[0]) for cell in cells)
        lines += ["", head[column]] if lines else [head[column]]
        for label, cell in zip(labels, cells, strict=True):
            if not cell[0]:
                continue
            lines.append(f"  {label.rjust(indent)}  {cell[0].ljust(width)}  {' '.join(cell[1:])}".rstrip())
    return lines
